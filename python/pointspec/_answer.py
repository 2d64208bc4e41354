"""Answers: named fields as NumPy arrays that share memory with the library."""

from __future__ import annotations

import ctypes
import html
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _context, _library
from ._library import library

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas

# Rows that are shown of a table.
_MOST_ROWS = 10
_DTYPES = {_library.F64: "<f8", _library.I64: "<i8", _library.C128: "<c16"}


class _Memory:
    """Numbers of an answer as NumPy's array interface; keeps the answer as long as any array of them lives."""

    def __init__(self, answer: "Answer", field: Any) -> None:
        self.answer = answer
        self.__array_interface__ = {
            "version": 3,
            "typestr": _DTYPES[field.type],
            "shape": tuple(field.shape[i] for i in range(field.rank)) or (field.num,),
            "data": (field.data, True),
        }


class Answer:
    """What the program prints for a question: columns, arrays, and entries of the header.

    ``answer["power"]``, or ``answer.power``, is a column or an array of NumPy, read-only, in the memory of the
    library; of an entry it is a number or a text, or a list of these where its key comes several times.
    ``"power" in answer`` and iteration go over the names.
    """

    def __init__(self, handle: int) -> None:
        self._handle = handle
        # Views of the library's; no arrays, which would keep the answer that keeps them: the collector of cycles does not
        # look into arrays.
        self._fields: dict[str, list[Any]] | None = None
        self.plan: Answer | None = None  # what `pointspec.plan` answers, where plan=True was asked for

    def __del__(self) -> None:
        if library is not None:  # the interpreter ends
            library.answer_destroy(self._handle)

    def _all(self) -> dict[str, list[Any]]:
        if self._fields is None:
            self._fields = {}
            for i in range(library.answer_num_fields(self._handle)):
                field = library.answer_field(self._handle, i).contents
                self._fields.setdefault(field.name.decode(), []).append(field)
        return self._fields

    def _read(self, field: Any) -> Any:
        if field.type != _library.TEXT:
            values = np.asarray(_Memory(self, field)) if field.num > 0 else np.empty(0, _DTYPES[field.type])
        else:
            texts = ctypes.cast(field.data, ctypes.POINTER(ctypes.c_char_p))
            values = np.array([texts[i].decode() for i in range(field.num)], dtype=object)
        return values if field.group != _library.ENTRY else values.tolist()[0]

    def __getitem__(self, name: str) -> Any:
        same = self._all()[name]
        read = [self._read(field) for field in same if field.group == same[0].group]
        return read[0] if len(read) == 1 else read

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._all():
            raise AttributeError(f"the answer has no field {name!r}")
        return self[name]

    def __contains__(self, name: object) -> bool:
        return name in self._all()

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        """Rows of the table."""
        columns = self.columns
        return len(self[columns[0]]) if columns else 0

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in self if name.isidentifier())]

    def _names(self, group: int) -> list[str]:
        return [name for name, same in self._all().items() if same[0].group == group]

    @property
    def columns(self) -> list[str]:
        """Names of the columns, in their order."""
        return self._names(_library.COLUMN)

    @property
    def arrays(self) -> list[str]:
        """Names of the arrays."""
        return self._names(_library.ARRAY)

    @property
    def header(self) -> dict[str, Any]:
        """The entries: what was asked, by which engine it was answered, how exactly."""
        return {
            name: [self._read(field) for field in entries] if len(entries) > 1 else self._read(entries[0])
            for name, same in self._all().items()
            if (entries := [field for field in same if field.group == _library.ENTRY])
        }

    @property
    def units(self) -> dict[str, str]:
        """Units of the fields that have one."""
        return {name: same[0].unit.decode() for name, same in self._all().items() if same[0].unit}

    @property
    def verdict(self) -> str:
        """"", or the sentence with which the program would end in exit status 3."""
        return str(library.answer_verdict(self._handle).decode())

    def to_pandas(self) -> "pandas.DataFrame":
        """The columns as a data frame of pandas, which must be there; the header is its attrs."""
        import pandas

        frame = pandas.DataFrame({name: self[name] for name in self.columns})
        frame.attrs = self.header
        return frame

    def plot(self, ax: "matplotlib.axes.Axes | None" = None) -> Any:
        """The picture of the answer by Matplotlib, which must be there, into ax or new axes, which it returns."""
        from . import _plot

        return _plot.plot(self, ax=ax)

    def save(self, path: str | os.PathLike[str], format: str | None = None) -> None:
        """Writes the file that the program writes: csv, json, jsonl, npy, npz or text, by the ending of path."""
        context = _context.get()
        name = None if format is None else format.encode()
        context.check(library.answer_write(self._handle, context.handle, os.fsencode(path), name))

    def _rows(self) -> Iterator[list[str]]:
        columns = [self[name] for name in self.columns]
        for i in range(min(len(self), _MOST_ROWS)):
            yield [str(v[i]) if isinstance(v[i], str) else f"{v[i]:.6g}" for v in columns]

    def _title(self) -> str:
        return f"{len(self)} rows; " + "; ".join(
            f"{key} {self[key]}" for key in ("engine", "predicted_error", "realizations") if key in self
        )

    def __repr__(self) -> str:
        rows = [self.columns, *self._rows()]
        widths = [max(len(row[i]) for row in rows) for i in range(len(self.columns))]
        lines = ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in rows]
        more = ["..."] if len(self) > _MOST_ROWS else []
        return "\n".join([*lines, *more, self._title()])

    def _repr_html_(self) -> str:
        def line(row: list[str], tag: str) -> str:
            return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in row) + "</tr>"

        body = "".join(line(row, "td") for row in self._rows())
        return f"<table>{line(self.columns, 'th')}{body}</table><p>{html.escape(self._title())}</p>"


def _owned(context: _context.Context, status: int, out: ctypes.c_void_p) -> Answer:
    """The answer that a call has made, or its error."""
    answer = Answer(out.value) if out.value is not None else None
    context.check(status)
    assert answer is not None
    return answer


def load(path: str | os.PathLike[str]) -> Answer:
    """An answer that was written as NPZ, by this module or by the program."""
    context = _context.get()
    out = ctypes.c_void_p()
    return _owned(context, library.answer_load(ctypes.byref(out), context.handle, os.fsencode(path)), out)


def merge(*answers: Answer) -> Answer:
    """One answer of the realizations of several, as of seeds that differ; they were asked with state=True."""
    context = _context.get()
    out = ctypes.c_void_p()
    parts = (ctypes.c_void_p * len(answers))(*(answer._handle for answer in answers))
    return _owned(context, library.answer_merge(ctypes.byref(out), context.handle, parts, len(answers)), out)


def table(kind: str, what: str) -> Answer:
    """The table of options, fields or pictures of a kind of answer or a command."""
    context = _context.get()
    out = ctypes.c_void_p()
    call = getattr(library, what + "_table")
    return _owned(context, call(ctypes.byref(out), context.handle, kind.encode()), out)


def rows(kind: str, what: str) -> list[dict[str, Any]]:
    """The same as a dict for each row; what is missing is "", also where a whole column is."""
    found = table(kind, what)
    columns = {name: found[name].tolist() for name in found.columns}
    return [
        {name: value if isinstance(value, (str, int)) else "" for name, value in zip(columns, row)}
        for row in zip(*columns.values())
    ]

"""Questions: options and patterns of Python's on their way into the library."""

from __future__ import annotations

import ctypes
import functools
import json
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _answer, _context, _library
from ._library import library

# Bytes of a generator's points that are kept for a second plan, as the program keeps those of standard input.
_MOST_KEPT = 64 << 20

Sampler = Callable[[int, int, int], Any]
PathLike = Union[str, "os.PathLike[str]"]
Patterns = Union[
    npt.ArrayLike,
    PathLike,
    Sequence[npt.ArrayLike],
    Sequence[PathLike],
    Iterable[npt.ArrayLike],
    Sampler,
    Mapping[str, Any],
]


class Integrand:
    """A function of the caller's whose variance is measured.

    values: from points (n, d) to n values, alike whenever it is asked for the same points.
    integral: over the torus, the sphere (of area 4 pi) or the hemisphere (2 pi).
    """

    def __init__(self, values: Callable[[npt.NDArray[np.float64]], npt.ArrayLike], integral: float, name: str = "f"):
        self.values, self.integral, self.name = values, float(integral), name


def _numbers(array: npt.ArrayLike, what: str) -> npt.NDArray[np.float64]:
    """The array as doubles in C order, itself where it is that."""
    found = np.asarray(array)
    if found.dtype.kind not in "fiu":
        raise TypeError(f"{what}: an array of {found.dtype} is none of real numbers")
    return np.ascontiguousarray(found, dtype=np.float64)


def _points(array: npt.ArrayLike, what: str) -> npt.NDArray[np.float64]:
    """Patterns (M, N, d) of an array (N, d) or (M, N, d)."""
    found = _numbers(array, what)
    if found.ndim not in (2, 3) or found.size == 0:
        raise ValueError(
            f"{what}: an array of shape {found.shape} has no points; it is (N, d), or (M, N, d) of M realizations"
        )
    return found if found.ndim == 3 else found[np.newaxis]


def _weights(array: npt.ArrayLike, points: npt.NDArray[np.float64], what: str) -> npt.NDArray[np.float64]:
    """Weights (M, N), of all realizations or of one that all have."""
    found = _numbers(array, what)
    if found.shape not in (points.shape[:2], points.shape[1:2]):
        raise ValueError(
            f"{what}: an array of shape {found.shape} does not fit patterns of shape {points.shape}; "
            "it is (M, N), or (N,) of all of them"
        )
    return np.ascontiguousarray(np.broadcast_to(found, points.shape[:2]))


def _is_path(value: object) -> bool:
    return isinstance(value, (str, os.PathLike))


def _is_array(value: object) -> bool:
    """Is it one array, rather than a list of arrays?"""
    if hasattr(value, "__array__"):
        return True
    if not isinstance(value, (list, tuple)) or len(value) == 0:
        return False
    first = value[0]
    return isinstance(first, (list, tuple)) and len(first) > 0 and np.ndim(first[0]) == 0


def _has_weights(patterns: object) -> bool:
    """May weights stand beside such patterns, as an array or arrays?"""
    return _is_path(patterns) or _is_array(patterns) or isinstance(patterns, (list, tuple))


class Question:
    """A question of the library; what its functions raise is kept by the context."""

    def __init__(self, context: _context.Context, kind: str) -> None:
        self.context, self.kind = context, kind
        self.key: Any = None  # of questions that the next call may go on with
        self.alive: list[Any] = []  # what the library points to
        self.files: list[Path] = []  # that answers and scenes were written to
        self.handle = ctypes.c_void_p()
        self.sampler: dict[str, Any] = {"points": 1024, "seed": 1, "realizations": 1}  # of the caller's functions
        context.check(library.question_create(ctypes.byref(self.handle), context.handle, kind.encode()))

    def close(self) -> None:
        """Gives everything back."""
        library.question_destroy(self.handle)
        for path in self.files:
            path.unlink(missing_ok=True)

    # ---- options ----

    def set_all(self, options: Mapping[str, Any], patterns: Any) -> None:
        """All options; those of samplers are for functions among the patterns, too, and for these alone where no
        sampler of the library is named."""
        is_made = callable(patterns) or (isinstance(patterns, Mapping) and any(map(callable, patterns.values())))
        for name, value in options.items():
            is_own = is_made and name in self.sampler and value is not None
            if is_own:
                self.sampler[name] = value
            if not is_own or "sampler" in options or (name == "points" and len(self._counts()) > 1):
                self.set(name, value)

    def set(self, name: str, value: Any) -> None:
        """An option by its name, with _ for -: text, number, flag, array, or several of these."""
        option = name.replace("_", "-").encode()
        check = self.context.check
        if value is None:
            return
        if isinstance(value, Integrand):
            self._set_integrand(value)
        elif isinstance(value, _answer.Answer):
            self._set_text(option, self._save(value))
        elif isinstance(value, (bool, np.bool_)):
            if value:  # of flags, and of what an answer can have without a file
                check(library.question_set(self.handle, option, None))
        elif isinstance(value, (int, np.integer)):
            self._set_text(option, str(int(value)))
        elif isinstance(value, (float, np.floating)):
            check(library.question_set_number(self.handle, option, float(value)))
        elif _is_path(value):
            self._set_text(option, os.fspath(value))
        elif isinstance(value, np.ndarray):
            self._set_array(option, name, name, value)
        elif isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], np.ndarray):
            self._set_array(option, name, *value)
        elif isinstance(value, (list, tuple, range)):
            self._set_several(name, option, value)
        else:
            raise TypeError(f"{name}: {type(value).__name__} is neither text, number, flag, array nor list of them")

    def _set_text(self, option: bytes, value: str) -> None:
        self.context.check(library.question_set(self.handle, option, os.fsencode(value)))

    def _set_several(self, name: str, option: bytes, values: Sequence[Any]) -> None:
        """Numbers are one value with commas; others are given one after the other."""
        if all(isinstance(value, (int, float, np.number)) and not isinstance(value, bool) for value in values):
            self._set_text(option, ",".join(repr(np.asarray(value).item()) for value in values))
        else:
            for value in values:
                self.set(name, value)

    def _set_array(self, option: bytes, name: str, kind: str, array: npt.NDArray[Any]) -> None:
        types = {"f": (_library.F64, "<f8"), "i": (_library.I64, "<i8"), "u": (_library.I64, "<i8"), "c": (_library.C128, "<c16")}
        if array.dtype.kind not in types:
            raise TypeError(f"{name}: an array of {array.dtype} is none of numbers")
        number, dtype = types[array.dtype.kind]
        data = np.ascontiguousarray(array, dtype=dtype)
        shape = (ctypes.c_size_t * data.ndim)(*data.shape)
        field = _library.Field(
            ctypes.sizeof(_library.Field), kind.encode(), b"", _library.ARRAY, number, data.ndim, shape, data.size,
            data.ctypes.data,
        )
        self.context.check(library.question_set_array(self.handle, option, ctypes.byref(field)))

    def _save(self, answer: _answer.Answer) -> str:
        """A file of an answer that is compared with, while the question lives."""
        descriptor, path = tempfile.mkstemp(suffix=".npz", prefix="pointspec-")
        os.close(descriptor)
        self.files.append(Path(path))
        answer.save(path)
        return path

    def _write_scene(self, scene: Mapping[str, Any]) -> str:
        """A scene of dicts and lists as a file, where the files that it names are looked for: YAML reads JSON."""
        descriptor, path = tempfile.mkstemp(suffix=".yaml", prefix="pointspec-", dir=os.getcwd())
        self.files.append(Path(path))
        with open(descriptor, "w") as file:
            json.dump(scene, file)
        return path

    def _keep(self, function: Any) -> Any:
        self.alive.append(function)
        return function

    def _set_integrand(self, integrand: Integrand) -> None:
        def fill(num: int, dimension: int, points: Any, values: Any, _payload: Any) -> int:
            try:
                at = np.ctypeslib.as_array(points, (num, dimension))
                found = _numbers(integrand.values(at), f"integrand {integrand.name}")
                if found.shape != (num,):
                    raise ValueError(f"integrand {integrand.name}: {num} points have values of shape {found.shape}")
                np.ctypeslib.as_array(values, (num,))[:] = found
            except BaseException as error:
                self.context.raised = error
                return 1
            return 0

        called = self._keep(_library.Values(fill))
        name = integrand.name.encode()
        self.context.check(library.question_integrand(self.handle, name, integrand.integral, called, None))

    # ---- patterns ----

    def take(self, patterns: Any, weights: Any = None) -> None:
        """Patterns of any form: arrays, lists of them, files, a generator, a sampler, or sets of these by names."""
        if patterns is None:
            if weights is not None:
                self.set("weights", weights)
        elif self.kind == "run" and isinstance(patterns, Mapping):
            self._set_text(b"files", self._write_scene(patterns))
        elif weights is not None and not _is_path(weights) and not _has_weights(patterns):
            raise ValueError("weights: functions and generators give tuples of points and weights, curves by names none")
        elif isinstance(patterns, Mapping):
            for name, own in patterns.items():
                self._begin(str(name), own)
        elif isinstance(weights, str) or (_is_path(patterns) and weights is not None):
            self.set("weights", weights)
            self.take(patterns)
        elif _is_path(patterns):
            self._set_text(b"files", os.fspath(patterns))
        elif callable(patterns):
            self._take_sampler(patterns)
        elif _is_array(patterns):
            self._add(patterns, weights, "points")
        elif isinstance(patterns, (list, tuple)):
            self._take_list(patterns, weights)
        elif isinstance(patterns, Iterable):
            self._give(self._kept(iter(patterns)), 0)
        else:
            raise TypeError(f"points: {type(patterns).__name__} is no array, list, file, generator or sampler")

    def _begin(self, name: str, patterns: Any) -> None:
        """A curve of that name: files, or patterns of one number of points, or of each of several."""
        if _is_path(patterns):
            self._set_text(b"set", f"{name}={os.fspath(patterns)}")
        elif isinstance(patterns, Mapping):
            for own in patterns.values():
                self._begin(name, own)
        elif callable(patterns):
            for num in self._counts():
                self._begin_set(name)
                self._give_samples(patterns, num)
        else:
            self._begin_set(name)
            self.take(patterns)

    def _begin_set(self, name: str) -> None:
        self.context.check(library.question_begin_set(self.handle, name.encode()))

    def _counts(self) -> list[int]:
        counts = self.sampler["points"]
        return [int(count) for count in np.atleast_1d(counts)]

    def _take_sampler(self, sampler: Sampler) -> None:
        counts = self._counts()
        if len(counts) > 1:
            self._begin(getattr(sampler, "__name__", "own"), sampler)
        else:
            self._give_samples(sampler, counts[0])

    def _take_list(self, patterns: Sequence[Any], weights: Any) -> None:
        if len(patterns) == 0:
            raise ValueError("points: an empty list has no realizations")
        if all(_is_path(one) for one in patterns):
            for one in patterns:
                self.take(one)
            return
        if weights is not None and len(weights) != len(patterns):
            raise ValueError(f"weights: {len(weights)} arrays do not fit {len(patterns)} patterns")
        for i, one in enumerate(patterns):
            self._add(one, None if weights is None else weights[i], f"points[{i}]")

    def _add(self, array: npt.ArrayLike, weights: Any, what: str) -> None:
        points = self._keep(_points(array, what))
        own = None if weights is None else self._keep(_weights(weights, points, what.replace("points", "weights")))
        num, num_points, dimension = points.shape
        address = None if own is None else own.ctypes.data
        self.context.check(
            library.question_borrow(self.handle, num, num_points, dimension, points.ctypes.data, address)
        )

    def _give_samples(self, sampler: Sampler, num: int) -> None:
        seed = self.sampler["seed"]
        self._give(lambda realization: sampler(num, seed, realization), self.sampler["realizations"])

    def _kept(self, sets: Iterator[Any]) -> Callable[[int], Any]:
        """A generator comes once. Its sets are kept for a second plan as long as they are few."""
        read: list[Any] = []
        num, num_bytes = 0, 0

        def get(realization: int) -> Any:
            nonlocal num, num_bytes
            if realization < num:
                if num_bytes > _MOST_KEPT:
                    raise ValueError(
                        "points: a generator comes once, and this question reads its sets again, of which no more than "
                        f"{_MOST_KEPT} bytes are kept; a list, or a function f(n, seed, realization), can be read again"
                    )
                return read[realization]
            made = next(sets, None)
            if made is not None:
                num, num_bytes = num + 1, num_bytes + np.asarray(made[0] if isinstance(made, tuple) else made).nbytes
                read.append(made)
                if num_bytes > _MOST_KEPT:
                    read.clear()
            return made

        return get

    def _give(self, get: Callable[[int], Any], num: int) -> None:
        """Realizations that a function makes, one at a time: points, or a tuple of points and weights."""
        shown: list[Any] = [None]

        def give(realization: int, out: Any, _payload: Any) -> int:
            try:
                made = get(realization)
                if made is None:
                    return 0
                what = f"points of realization {realization}"
                array, weights = made if isinstance(made, tuple) else (made, None)
                points = _points(array, what)
                if len(points) != 1:
                    raise ValueError(f"{what}: an array of shape {points.shape} is several")
                own = None if weights is None else _weights(weights, points, what.replace("points", "weights"))
                shown[0] = points, own  # until the next is asked for
                view = out.contents
                view.dimension, view.num_points, view.points = points.shape[2], points.shape[1], points.ctypes.data
                view.weights = None if own is None else own.ctypes.data
            except BaseException as error:
                self.context.raised = error
                return -1
            return 1

        called = self._keep(_library.Give(give))
        self.context.check(library.question_give(self.handle, num, called, None))

    def answer(self, is_planned: bool = False) -> _answer.Answer:
        """The answer, or what it would take."""
        out = ctypes.c_void_p()
        call = library.question_plan if is_planned else library.question_answer
        return _answer._owned(self.context, call(ctypes.byref(out), self.handle), out)


@functools.cache
def _files(kind: str) -> frozenset[str]:
    """Options whose values may name files, which change."""
    return frozenset(row["option"].replace("-", "_") for row in _answer.rows(kind, "options") if row["file"])


def _key(kind: str, options: Mapping[str, Any], patterns: Any) -> Any:
    """What questions have alike that differ in their patterns alone; None where an option is an object or names a file."""
    if not isinstance(patterns, np.ndarray) or not _files(kind).isdisjoint(options):
        return None
    key: list[Any] = [kind]
    for name, value in options.items():
        several = value if isinstance(value, (list, tuple)) else [value]
        if not all(isinstance(one, (str, int, float, type(None))) for one in several):
            return None
        key += [name, *((type(one), one) for one in several)]
    return key


def _begin(context: _context.Context, kind: str, options: Mapping[str, Any], patterns: Any) -> Question:
    """A question with its options: that of the last call, whose plan and buffers stay, where it is the same."""
    key = _key(kind, options, patterns)
    kept, context.kept = context.kept, None
    if isinstance(kept, Question):
        if key is not None and kept.key == key:
            library.question_reset(kept.handle)
            return kept
        kept.close()
    question = Question(context, kind)
    question.key = key
    try:
        question.set_all(options, patterns)
    except BaseException:
        question.close()
        raise
    return question


def ask(
    kind: str,
    patterns: Any,
    options: dict[str, Any],
    *,
    weights: Any = None,
    device: str | None = None,
    progress: Any = None,
    plan: bool | None = False,
    is_planned: bool = False,
) -> _answer.Answer:
    """Asks one question, whose patterns are borrowed for the call. plan: the answer has its plan, too."""
    context = _context.get(device)
    question = _begin(context, kind, options, patterns)
    try:
        question.take(patterns, weights)
        with _context.listening(context, progress):
            planned = question.answer(True) if plan else None
            answer = question.answer(is_planned)
    except BaseException:
        question.close()
        raise
    answer.plan = planned
    question.alive.clear()
    if question.key is not None and weights is None and not is_planned:
        context.kept = question
    else:
        question.close()
    return answer

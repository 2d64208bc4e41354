"""pointspec: power spectra of sampling patterns, and what they say about integration.

Every kind of answer and command of the program is a function here, with the program's options as keywords, _ for -:

>>> import numpy, pointspec
>>> points = numpy.random.default_rng(1).random((100, 256, 2))  # 100 realizations of 256 points of the torus
>>> answer = pointspec.power(points, max_frequency=8)
>>> answer.power.shape, answer["bin"].tolist()
((8,), [1, 2, 3, 4, 5, 6, 7, 8])
>>> bool(abs(answer.power.mean() - 1) < 0.1)  # white noise
True

Points are an array (N, d), or (M, N, d) of M realizations, or a list of arrays of different N, a generator of arrays, a
function f(n, seed, realization) that makes them, files, or a dict of these, whose names are curves beside those of
``sampler=``. On the sphere they are unit vectors.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

from . import _answer, _library, _question
from ._answer import Answer, load, merge
from ._errors import (
    BuildError,
    CancelledError,
    CheckError,
    DeviceError,
    FileError,
    InputError,
    InvalidArgumentError,
    NoDeviceError,
    NoMemoryError,
    PointspecError,
    PointspecWarning,
    ToleranceError,
)
from ._library import library as _c
from ._plot import plot
from ._question import Integrand, Patterns

__version__: str = _c.version().decode()

_OWN = ("weights", "device", "progress", "plan")  # keywords beside the library's options
_COMMANDS = ["sample", "convert", "run", "devices", "doctor"]


def _kinds() -> list[str]:
    names: list[str] = []
    while (name := _c.answer_kind(len(names))) is not None:
        names.append(name.decode())
    return names


def _describe(function: Any, kind: str) -> None:
    """Signature and docstring of the function of a kind, made of the library's tables."""
    options = [row for row in _answer.rows(kind, "options") if row["option"] not in ("files", "weights")]
    parameters = [inspect.Parameter("patterns", inspect.Parameter.POSITIONAL_ONLY, default=None)]
    parameters += [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None) for name in _OWN]
    lines = [f"What ``pointspec {kind}`` answers, as an :class:`Answer`.", "", "Options:", ""]
    for row in options:
        name = row["option"].replace("-", "_")
        parameters.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None))
        lines += [f"{name}: {row['values'] or 'flag'}", f"    {row['help']}"]
    if kind not in _COMMANDS or kind == "devices":
        lines += ["", "Fields:", ""]
        lines += [f"{row['field']} ({row['group']}): {row['meaning']}" for row in _answer.rows(kind, "fields")]
    function.__signature__ = inspect.Signature(parameters, return_annotation=Answer)
    function.__doc__ = "\n".join(lines)


def _ask(kind: str, patterns: Any, options: dict[str, Any], is_planned: bool = False) -> Answer:
    own = {name: options.pop(name, None) for name in _OWN}
    return _question.ask(kind, patterns, options, is_planned=is_planned, **own)


def _make(kind: str) -> Callable[..., Answer]:
    def function(patterns: Any = None, /, **options: Any) -> Answer:
        return _ask(kind, patterns, options)

    function.__name__ = function.__qualname__ = kind
    function.__module__ = __name__
    _describe(function, kind)
    return function


for _kind in [*_kinds(), *_COMMANDS]:
    globals()[_kind] = _make(_kind)


def plan(kind: str, patterns: Any = None, /, **options: Any) -> Answer:
    """What answering a question would take: engines with seconds, bytes and errors, phases, what is skipped."""
    return _ask(kind, patterns, options, is_planned=True)


__all__ = [
    *_kinds(),
    *_COMMANDS,
    "plan", "load", "merge", "plot", "Answer", "Integrand", "Patterns",
    "PointspecError", "InvalidArgumentError", "InputError", "FileError", "NoMemoryError", "NoDeviceError", "DeviceError",
    "BuildError", "ToleranceError", "CancelledError", "CheckError", "PointspecWarning",
]  # fmt: skip

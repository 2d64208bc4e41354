"""What a call of the Python module costs beside the calls of the library that it makes, and what arrays take.

    ./dev build && POINTSPEC_LIBRARY=build/dev/libpointspec.so PYTHONPATH=python python3 bench/python/overhead.py
"""

from __future__ import annotations

import ctypes
import resource
import statistics
import time
from collections.abc import Callable

import numpy as np

import pointspec
from pointspec import _context
from pointspec._library import library

CALLS = 1000
CONTEXT = _context.get()


QUESTION = ctypes.c_void_p()


def in_c(points: np.ndarray) -> None:
    """The calls that pointspec.power makes of a question that is asked again, and nothing else of it."""
    answer = ctypes.c_void_p()
    library.question_reset(QUESTION)
    library.question_borrow(QUESTION, *points.shape, points.ctypes.data, None)
    library.question_answer(ctypes.byref(answer), QUESTION)
    library.answer_destroy(answer)


def in_python(points: np.ndarray) -> None:
    pointspec.power(points, max_frequency=4)


def median(call: Callable[[np.ndarray], None], points: np.ndarray, calls: int) -> float:
    seconds = []
    for _ in range(calls):
        begin = time.perf_counter()
        call(points)
        seconds.append(time.perf_counter() - begin)
    return statistics.median(seconds) * 1e6


def main() -> None:
    random = np.random.default_rng(1)
    library.question_create(ctypes.byref(QUESTION), CONTEXT.handle, b"power")
    library.question_set(QUESTION, b"max-frequency", b"4")
    print("| N | M | C, us | Python, us | overhead, us |\n|---:|---:|---:|---:|---:|")
    for num, sets in ((64, 1), (64, 1000), (1024, 100)):
        points = random.random((sets, num, 2))
        median(in_python, points, 20)
        pairs = [(median(in_c, points, CALLS // 20), median(in_python, points, CALLS // 20)) for _ in range(20)]
        c, python = (statistics.median(column) for column in zip(*pairs))
        print(f"| {num} | {sets} | {c:.0f} | {python:.0f} | {python - c:.1f} |")
    points = random.random((64, 1000000, 2))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    in_python(points)
    more = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    print(f"\nan array of {points.nbytes / 1e6:.0f} MB: {more / 1024:.0f} MB more in memory at most")


main()

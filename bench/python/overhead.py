"""What a call of the Python module costs beside the library's answer, medians of 1000, and what arrays take.

    ./dev build && POINTSPEC_LIBRARY=build/dev/libpointspec.so PYTHONPATH=python python3 bench/python/overhead.py
"""

from __future__ import annotations

import resource
import statistics
import time

import numpy as np

import pointspec
from pointspec._library import library

CALLS = 1000
inside = 0.0  # seconds of the last call in the library
answer = library.question_answer


def timed(*arguments: object) -> int:
    global inside
    begin = time.perf_counter()
    status = answer(*arguments)
    inside = time.perf_counter() - begin
    return status


library.question_answer = timed


def ask(points: np.ndarray) -> tuple[float, float]:
    """Microseconds of a call, and of those what is outside of pspec_question_answer."""
    begin = time.perf_counter()
    pointspec.power(points, max_frequency=4)
    whole = time.perf_counter() - begin
    return whole * 1e6, (whole - inside) * 1e6


def main() -> None:
    random = np.random.default_rng(1)
    print("| N | M | a call, us | of it Python, us |\n|---:|---:|---:|---:|")
    for num, sets in ((64, 1), (64, 1000), (1024, 100)):
        points = random.random((sets, num, 2))
        whole, own = zip(*(ask(points) for _ in range(CALLS)))
        print(f"| {num} | {sets} | {statistics.median(whole):.0f} | {statistics.median(own):.1f} |")
    points = random.random((64, 1000000, 2))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    ask(points)
    more = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    print(f"\nan array of {points.nbytes / 1e6:.0f} MB: {more / 1024:.0f} MB more in memory at most")


main()

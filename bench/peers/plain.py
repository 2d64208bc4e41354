"""What one writes first for the sphere: for every point and order the recurrence over the degrees, in double
precision in C, the points of a set divided between two threads. Of long sums only a piece is run, and the
time extrapolated."""

import threading
import time

import numpy as np

from loops_sphere import num_coefficients, plain_coefficients, plain_recurrence, sum_orders

PIECE_PAIRS = 10**8  # of points and coefficients; more is extrapolated
THREADS = 2


class PlainRunner:
    def __init__(self, points):
        degree = points.case.degree
        self.degree, self.rows = degree, points.rows
        self.recurrence = plain_recurrence(degree)
        self.parts = np.zeros((THREADS, num_coefficients(degree)), np.complex128)
        self.sums = np.zeros(degree + 1)
        self.num_points = min(points.case.points, max(THREADS, PIECE_PAIRS // num_coefficients(degree)))
        self.scale = points.case.points / self.num_points

    @property
    def is_whole(self):
        return self.scale == 1

    def _add(self, part, realization):
        first, last = (self.num_points * i // THREADS for i in (part, part + 1))
        self.parts[part] = 0
        plain_coefficients(self.rows[realization, first:last], self.degree, self.recurrence, self.parts[part])

    def modes(self, realization):
        threads = [threading.Thread(target=self._add, args=(i, realization)) for i in range(THREADS)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        return self.parts.sum(axis=0)

    def run(self, count):
        begin = time.perf_counter()
        for realization in range(count):
            sum_orders(self.modes(realization), self.sums, "double")
        return self.scale * (time.perf_counter() - begin), float("nan")

    def close(self):
        pass

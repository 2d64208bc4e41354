"""Legendre sums over all pairs as one writes them with numpy: the Gram matrix by BLAS, rows at a time so that
everything stays in the cache, and the recurrence of P_l over it; half of the pairs where blocks allow it."""

import numpy as np

import loops
from runner import Runner

BLOCK_BYTES = 1 << 19  # of the matrices of a block: the second cache
MATRICES = 4


class NumpyPairs:
    name = "numpy"
    precisions = ("single", "double")
    knob = "eps"
    how = "wheel, with its OpenBLAS; one thread for each of two calls"

    def __init__(self, folder):
        self.version = np.__version__

    def accuracies(self, points, precision):
        return [{}]

    def ladder(self, precision):
        return [float(np.finfo(loops.PRECISION[precision]).eps)]

    def guess(self, precision, tolerance):
        return 0

    def variants(self, points, precision):
        return [{"plans": min(2, points.count)}]

    def open(self, points, precision, eps, plans):
        return Runner([Plan(points, precision) for _ in range(plans)])

    def describe(self, setting):
        return f"{setting['plans']}x1"


class Plan:
    def __init__(self, points, precision):
        self.rows = points.layout("rows " + precision)
        self.degree, self.count = points.case.degree, points.case.points
        self.real = loops.PRECISION[precision]
        size = MATRICES * self.count * np.dtype(self.real).itemsize
        self.block = max(1, min(self.count, BLOCK_BYTES // size))

    def _add(self, x, first, last, sums):
        """Pairs of the rows first .. last - 1 with all from first on: those behind the block count twice."""
        cosines = x[first:last] @ x[first:].T
        num = last - first
        before, now = np.ones_like(cosines), cosines.copy()
        after = np.empty_like(cosines)
        for l in range(1, self.degree + 1):
            sums[l] += 2 * now.sum(dtype=np.float64) - now[:, :num].sum(dtype=np.float64)
            np.multiply(cosines, now, out=after)
            after *= self.real((2 * l + 1) / (l + 1))
            before *= self.real(l / (l + 1))
            after -= before
            before, now, after = now, after, before

    def modes(self, realization):
        """Q(l), l = 0 .. L, weights 1/N."""
        x = self.rows[realization]
        sums = np.zeros(self.degree + 1)
        for first in range(0, self.count, self.block):
            self._add(x, first, min(first + self.block, self.count), sums)
        sums[0] = self.count**2
        return sums / self.count**2

    def run(self, first, count):
        for r in range(first, first + count):
            self.modes(r)
        return 0.0

    def close(self):
        pass

"""ducc0.sht.adjoint_synthesis_general, spin 0: no plan across point sets. Options: eps, threads; it chooses
oversampling by a cost model itself, and coordinates are doubles in either precision."""

import time

import numpy as np

import loops
from loops_sphere import num_coefficients, sum_orders
from libraries.ducc0_torus import eps_ladder
from runner import Runner, thread_choices

SHARED_MODES = 1 << 14  # from here on two threads in one call are worth a trial


class Ducc0Sphere:
    name = "ducc0"
    precisions = ("single", "double")
    knob = "eps"

    def __init__(self, folder):
        import ducc0

        self.transform = ducc0.sht.adjoint_synthesis_general
        self.version = ducc0.__version__
        self.how = (folder / "ducc0.how").read_text().strip()

    def accuracies(self, points, precision):
        return [{}]

    def ladder(self, precision):
        return eps_ladder(precision)

    def guess(self, precision, tolerance):
        return sum(eps > tolerance for eps in self.ladder(precision))

    def variants(self, points, precision):
        return [{"plans": plans, "threads": threads} for plans, threads in thread_choices(points, SHARED_MODES)]

    def open(self, points, precision, eps, plans, threads):
        return Runner([Plan(self, points, precision, eps, threads) for _ in range(plans)])

    def describe(self, setting):
        return f"{setting['plans']}x{setting['threads']}"


class Plan:
    def __init__(self, peer, points, precision, eps, threads):
        degree = points.case.degree
        self.peer, self.precision = peer, precision
        self.angles = points.layout("angles double")
        real = loops.PRECISION[precision]
        self.raw = np.zeros((1, num_coefficients(degree)), np.result_type(real, np.complex64))
        self.sums = np.zeros(degree + 1, real)
        self.arguments = dict(
            map=np.ones((1, points.case.points), real), spin=0, lmax=degree, epsilon=eps,
            nthreads=threads, alm=self.raw)
        self.peer.transform(loc=self.angles[0], **self.arguments)

    def run(self, first, count):
        accumulating = 0.0
        for r in range(first, first + count):
            self.peer.transform(loc=self.angles[r], **self.arguments)
            begin = time.perf_counter()
            sum_orders(self.raw, self.sums, self.precision)
            accumulating += time.perf_counter() - begin
        return accumulating

    def modes(self, realization):
        self.run(realization, 1)
        return self.raw[0]

    def close(self):
        pass

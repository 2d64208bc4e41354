"""ducc0.nufft.nu2u: no plan across point sets, but a cache of its own. Options: the precision of
coordinates in single precision, threads; it chooses oversampling by a cost model itself."""

import time

import numpy as np

import loops
from runner import Runner, thread_choices


def eps_ladder(precision):
    """Three a decade."""
    return [10 ** (-j / 3) for j in range(3, 21 if precision == "single" else 44)]


class Ducc0:
    name = "ducc0"
    precisions = ("single", "double")
    knob = "eps"

    def __init__(self, folder):
        import ducc0

        self.nu2u = ducc0.nufft.nu2u
        self.version = ducc0.__version__
        self.how = (folder / "ducc0.how").read_text().strip()

    def accuracies(self, points, precision):
        kinds = ["single", "double"] if precision == "single" else ["double"]
        return [{"coordinates": kind} for kind in kinds]

    def ladder(self, precision):
        return eps_ladder(precision)

    def guess(self, precision, tolerance):
        return sum(eps > tolerance for eps in self.ladder(precision))

    def variants(self, points, precision):
        return [{"plans": plans, "threads": threads} for plans, threads in thread_choices(points)]

    def open(self, points, precision, eps, coordinates, plans, threads):
        return Runner(
            [Plan(self, points, precision, eps, coordinates, threads) for _ in range(plans)])

    def describe(self, setting):
        return f"{setting['coordinates']} coordinates {setting['plans']}x{setting['threads']}"


class Plan:
    def __init__(self, peer, points, precision, eps, coordinates, threads):
        case = points.case
        self.peer, self.precision = peer, precision
        self.points = points.layout("rows " + coordinates)
        real = loops.PRECISION[precision]
        self.weights = np.ones(case.points, np.result_type(real, np.complex64))
        self.raw = np.zeros([case.width] * case.dimension, self.weights.dtype)
        self.sums = np.zeros(case.num_modes, real)
        self.arguments = dict(
            points=self.weights, forward=True, epsilon=eps, nthreads=threads, out=self.raw,
            periodicity=1.0, fft_order=False)
        self.peer.nu2u(coord=self.points[0], **self.arguments)

    def run(self, first, count):
        accumulating = 0.0
        for r in range(first, first + count):
            self.peer.nu2u(coord=self.points[r], **self.arguments)
            begin = time.perf_counter()
            loops.accumulate(self.raw, self.sums, self.precision)
            accumulating += time.perf_counter() - begin
        return accumulating

    def modes(self, realization):
        self.run(realization, 1)
        return self.raw.ravel()

    def close(self):
        pass

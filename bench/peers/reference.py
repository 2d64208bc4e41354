"""The exact modes of the first realization, and errors against them: sqrt(sum |dS|^2 / (modes * N)), DC
left out, which is what pointspec's --tol bounds."""

import time

import numpy as np

import loops

SMALLEST = [1e-14, 2e-14, 4e-14, 1e-13, 2e-13]  # what is offered depends on the dimension
MOST_PAIRS = 3 * 10**7  # of a direct sum that checks the reference


class TorusReference:
    """From a double precision NUFFT at the smallest eps of ducc0, else of finufft; self.error is its own
    error against direct sums for some random frequencies."""

    def __init__(self, points, peers, folder):
        self.case = points.case
        self.modes = self._compute(points, peers)
        self.centre = (self.case.num_modes - 1) // 2
        self.error = self._check(points)

    def _compute(self, points, peers):
        by_name = {peer.name: peer for peer in peers}
        if "ducc0" in by_name:
            peer, arguments = by_name["ducc0"], {"coordinates": "double"}
        elif "finufft" in by_name:
            peer, arguments = by_name["finufft"], {"sigma": 2.0}
        else:
            raise RuntimeError("neither ducc0 nor finufft is there to compute a reference")
        variant = peer.variants(points, "double")[0]
        for eps in SMALLEST:
            try:
                runner = peer.open(points, "double", eps, **arguments, **variant)
                break
            except RuntimeError:
                if eps == SMALLEST[-1]:
                    raise
        modes = runner.modes(0).copy()
        runner.close()
        return modes

    def _check(self, points):
        case = self.case
        generator = np.random.default_rng(1)
        num = int(min(256, max(3, MOST_PAIRS // case.points)))
        k = generator.integers(-case.max_frequency, case.max_frequency + 1, (num, case.dimension))
        k = np.ascontiguousarray(k, np.int32)
        begin = time.perf_counter()
        sums = loops.direct_sums(points.rows[0], k)
        self.seconds_per_pair = (time.perf_counter() - begin) / (num * case.points)
        at = np.ravel_multi_index((k + case.max_frequency).T, [case.width] * case.dimension)
        return self._norm(sums - self.modes[at], num)

    def _norm(self, differences, num):
        squares = np.sum(differences.real**2) + np.sum(differences.imag**2)
        return float(np.sqrt(squares / (num * self.case.points)))

    def note(self):
        pairs = self.case.points * (self.case.num_modes // 2)
        return (f"reference wrong by {self.error:.0e}; direct sum, two threads, extrapolated: "
                f"{1e6 * self.seconds_per_pair * pairs / 2:.3g} us/R")

    def error_of_modes(self, modes):
        differences = modes - self.modes
        differences[self.centre] = 0
        return self._norm(differences, self.case.num_modes - 1)

    def errors_of_magnitudes(self, magnitudes):
        """(error, what it is at least). The half lattice after DC in C order. A magnitude shows one of the two
        components of an error: that one alone is the least, and sqrt(2) of it what it is when neither is
        special."""
        shown = self._norm(magnitudes - np.abs(self.modes[self.centre + 1 :]), magnitudes.size)
        return float(np.sqrt(2)) * shown, shown

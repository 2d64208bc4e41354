"""Q(l) of the first realization, weights 1/N, from the exact coefficients, and errors against it: the largest
|dQ(l)| of the degrees 1 .. L, which is what pointspec's --tol bounds."""

import numpy as np

from reference_sphere import SphereReference


class PairsReference(SphereReference):
    def __init__(self, points, peers, folder):
        super().__init__(points, peers, folder)
        self.sums = self._sums(self.modes)

    def _sums(self, modes):
        """Of coefficients; what has no imaginary part are sums already."""
        if not np.iscomplexobj(modes):
            return np.asarray(modes)[1:]
        orders = 2 * np.arange(1, self.case.degree + 1) + 1
        return 4 * np.pi / orders * self._norms(modes) ** 2 / self.case.points**2

    def note(self):
        return super().note().replace("differs by", "differs in coefficients by")

    def error_of_sums(self, sums):
        return float(np.max(np.abs(sums - self.sums)))

    def error_of_modes(self, modes):
        return super().error_of_modes(modes) if not hasattr(self, "sums") else self.error_of_sums(self._sums(modes))

    def errors_of_magnitudes(self, magnitudes):
        """(error, what it is at least): the same. Magnitudes are sqrt(N Q(l))."""
        error = self.error_of_sums(magnitudes**2 / self.case.points)
        return error, error

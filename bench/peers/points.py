"""White points of the torus, the same for every peer, in the layout each peer likes best. Layouts are made
outside of the clock; realizations that would take more than MOST_BYTES are not made, and the table says how
many were used."""

import numpy as np

MOST_BYTES = 256 << 20


class Points:
    """rows: [realization][point][coordinate]. Kinds of points say make_rows() and make_layout()."""

    def __init__(self, case):
        self.case = case
        set_bytes = 8 * case.points * case.dimension
        self.count = max(1, min(case.realizations, MOST_BYTES // set_bytes))
        self.rows = self.make_rows(np.random.default_rng(case.numbers))
        self._layouts = {"rows double": self.rows}

    def layout(self, name):
        """ "KIND PRECISION" """
        if name not in self._layouts:
            kind, precision = name.split()
            dtype = np.float32 if precision == "single" else np.float64
            self._layouts[name] = self.make_layout(kind, dtype)
        return self._layouts[name]


class TorusPoints(Points):
    def make_rows(self, generator):
        return generator.random((self.count, self.case.points, self.case.dimension))

    def make_layout(self, kind, dtype):
        if kind == "rows":
            return self.rows.astype(dtype)
        centred = self.rows - (self.rows >= 0.5)  # exact
        if kind == "centred":
            return centred
        assert kind == "radians"  # [realization][coordinate][point]
        centred *= 2 * np.pi
        return np.ascontiguousarray(centred.transpose(0, 2, 1), dtype=dtype)

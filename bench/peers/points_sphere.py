"""White points of the sphere: unit vectors, and their angles for those who want angles."""

import numpy as np

from points import Points


class SpherePoints(Points):
    def make_rows(self, generator):
        rows = generator.standard_normal((self.count, self.case.points, 3))
        rows /= np.sqrt(np.einsum("rjk,rjk->rj", rows, rows))[..., np.newaxis]
        return rows

    def make_layout(self, kind, dtype):
        if kind == "rows":
            return self.rows.astype(dtype)
        x, y, z = np.moveaxis(self.rows, 2, 0)
        angles = np.empty((*x.shape, 2))
        if kind == "angles":  # theta of 0 .. pi, phi of 0 .. 2 pi
            angles[..., 0] = np.arctan2(np.hypot(x, y), z)
            angles[..., 1] = np.arctan2(y, x) % (2 * np.pi)
        else:
            assert kind == "turns"  # phi of -1/2 .. 1/2, theta of 0 .. 1/2
            angles[..., 0] = np.arctan2(y, x) / (2 * np.pi)
            angles[..., 1] = np.arctan2(np.hypot(x, y), z) / (2 * np.pi)
        return angles.astype(dtype, copy=False)

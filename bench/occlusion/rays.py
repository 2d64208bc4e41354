"""Million rays a second of one thread that NumPy tries with the 32 triangles of a room, as bench_occlusion.c has them: which
of 1024 directions about each of as many places are hidden. Where NumPy is: python3 bench/occlusion/rays.py"""

import os
import time

os.environ["OPENBLAS_NUM_THREADS"] = "1"
import numpy as np  # noqa: E402

NUM, REPEATS = 1024, 9
BLOCKS = 1, 2, 4, 8, 16, 32  # places at a time


def read(path):
    """Triangles, as [triangle][corner][axis], of faces as fans."""
    corners, out = [], []
    for line in open(path):
        word, *rest = line.split() or ["#"]
        if word == "v":
            corners.append([float(x) for x in rest])
        elif word == "f":
            face = [corners[int(x) - 1] for x in rest]
            out += [(face[0], face[k], face[k + 1]) for k in range(1, len(face) - 1)]
    return np.array(out)


def planes(triangles, origins):
    """Of every place three vectors for each triangle, which a ray to it has on one side, as [place][vector][triangle][axis]."""
    from_place = triangles[None] - origins[:, None, None]
    a, b, c = (from_place[:, :, k] for k in range(3))
    out = np.stack([np.cross(a, b), np.cross(b, c), np.cross(c, a)], axis=1)
    return out * np.sign((a * np.cross(b, c)).sum(-1))[:, None, :, None]


def see(triangles, random):
    """Places that the camera sees, a little off the surface, and normals that face it."""
    rays = np.column_stack([(random.random((NUM, 2)) - 0.5) * 0.72, np.ones(NUM)])
    eye = np.array([2.75, 2.75, -7.5])
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    is_met = (planes(triangles, eye[None])[0] @ rays.T > 0).all(0)
    far = np.where(is_met, ((triangles[:, 0] - eye) * normals).sum(1)[:, None] / (normals @ rays.T), np.inf)
    nearest = far.argmin(0)
    own = normals[nearest] * -np.sign((normals[nearest] * rays).sum(1))[:, None]
    return eye + rays * far.min(0)[:, None] + 1e-5 * own, own


def turns(random, num):
    """Random rotations, of quaternions."""
    w, x, y, z = (q := random.normal(size=(num, 4))).T / np.linalg.norm(q, axis=1)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]).transpose(2, 0, 1)


def count(triangles, origins, normals, rotations, directions, block):
    """Rays above the horizon of every place that meet nothing. What is turned are the planes: products with all directions
    are then one of matrices."""
    free = np.empty(len(origins), int)
    room = np.empty((block * 3 * len(triangles), directions.shape[1]), directions.dtype)
    for first in range(0, len(origins), block):
        part = slice(first, first + block)
        turned = planes(triangles, origins[part]) @ rotations[part, None]
        sides = np.matmul(turned.reshape(-1, 3), directions, out=room[: turned.size // 3])
        sides = sides.reshape(turned.shape[:3] + (-1,))
        inside = np.minimum(sides[:, 0], sides[:, 1], out=sides[:, 0])
        np.minimum(inside, sides[:, 2], out=inside)
        is_above = (normals[part, None] @ rotations[part])[:, 0] @ directions > 0
        free[part] = (is_above & (inside.max(axis=1) <= 0)).sum(axis=1)
    return free


def main():
    random = np.random.default_rng(1)
    triangles = read("docs/scenes/p15/box.obj")
    origins, normals = see(triangles, random)
    directions = random.normal(size=(3, NUM))
    directions /= np.linalg.norm(directions, axis=0)
    for number in (np.float32, np.float64):
        own = [x.astype(number) for x in (triangles, origins, normals, turns(random, len(origins)), directions)]
        rates = {}
        for block in BLOCKS:
            seconds = []
            for _ in range(REPEATS):
                start = time.process_time()
                free = count(*own, block)
                seconds.append(time.process_time() - start)
            rates[block] = 1e-6 * NUM * len(origins) / np.median(seconds)
        best = max(rates, key=rates.get)
        print(f"{number.__name__}: {rates[best]:.1f}, {best} places at a time; visibility {2 * free.mean() / NUM:.4f}")


main()

"""cli_healpy.py PROGRAM: centres, coefficients and powers of HEALPix points against healpy and ducc0, where installed.

healpy's a_lm = sum f conj(Y_lm) 4 pi / npix of a map f, without iterations, is the plain sum over the centres, so
c_lm = npix / (4 pi) conj(a_lm). ducc0 sums over any points: c_lm = conj of its adjoint synthesis.
"""

import importlib.util
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77  # exit status that CTest counts as skipped
NSIDE, MAX_DEGREE = 8, 20
ALLOWED = 1e-11  # of coefficients, relative to sqrt(sum w^2); both sides work to about 1e-13


def is_there(module):
    return importlib.util.find_spec(module) is not None


if not is_there("numpy") or not (is_there("healpy") or is_there("ducc0")):
    print("cli_healpy: skipped, python3 has neither healpy nor ducc0")
    sys.exit(SKIPPED)
import numpy as np

bad = 0


def check(what, error, allowed):
    global bad
    print(f"cli_healpy: {what}: {error:.2g}, allowed {allowed:g}")
    if not error <= allowed:
        print(f"cli_healpy: {what} differ", file=sys.stderr)
        bad = 1


def run(*words):
    done = subprocess.run([program, *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, check=True)
    return done.stdout.decode()


def estimate(folder, points, weights):
    """Coefficients of all engines that reach the tolerance by themselves, and the powers of their tables."""
    np.savetxt(folder / "points.txt", np.column_stack([points, weights]), fmt="%.17g")
    for engine in ("host_direct", "sphere_direct", "sphere_nufft"):
        table = run("angular", "--engine", engine, "--columns", "xyzw", "--tol", 1e-12, "-l", MAX_DEGREE,
                    "--normalize", "effective", "--coefficients", folder / "c.npy", folder / "points.txt")
        rows = [line.split(",") for line in table.splitlines() if line[:1].isdigit()]
        yield engine, np.load(folder / "c.npy"), np.array([float(row[2]) for row in rows])


def compare_healpy(engine, c, powers, weights):
    import healpy

    size = np.sqrt(np.sum(weights**2))
    a = healpy.map2alm(weights, lmax=MAX_DEGREE, iter=0, pol=False, use_weights=False)
    check(f"{engine}, coefficients of healpy", np.max(np.abs(c - np.conj(a) * len(weights) / (4 * np.pi))) / size,
          ALLOWED)
    orders = healpy.Alm.getlm(MAX_DEGREE)[1]
    check(f"{engine}, imaginary part of m = 0", np.max(np.abs(c[orders == 0].imag)) / size, ALLOWED)
    of_healpy = 4 * np.pi * healpy.alm2cl(np.conj(c))[1:] / size**2
    check(f"{engine}, powers of healpy", np.max(np.abs(powers / of_healpy - 1)), ALLOWED)


def compare_ducc0(engine, c, points, weights):
    import ducc0

    x, y, z = points.T
    angles = np.column_stack([np.arctan2(np.hypot(x, y), z), np.arctan2(y, x) % (2 * np.pi)])
    a = ducc0.sht.adjoint_synthesis_general(map=weights[None, :], spin=0, lmax=MAX_DEGREE, loc=angles, epsilon=1e-12)
    check(f"{engine}, coefficients of ducc0", np.max(np.abs(c - np.conj(a[0]))) / np.sqrt(np.sum(weights**2)), ALLOWED)


def main(folder):
    run("sample", "--sampler", f"healpix:nside={NSIDE}", "-o", folder / "centres.npy")
    points = np.load(folder / "centres.npy").reshape(-1, 3)
    weights = np.random.default_rng(1).normal(size=len(points))
    if is_there("healpy"):
        import healpy

        pixels = healpy.vec2pix(NSIDE, *points.T)
        check("centres of pixels",
              np.max(np.abs(points - np.column_stack(healpy.pix2vec(NSIDE, pixels)))), 1e-14)
        check("pixels without a point", 1 - len(np.unique(pixels)) / healpy.nside2npix(NSIDE), 0)
        points = np.column_stack(healpy.pix2vec(NSIDE, np.arange(len(points))))
    for engine, c, powers in estimate(folder, points, weights):
        if is_there("healpy"):
            compare_healpy(engine, c, powers, weights)
        if is_there("ducc0"):
            compare_ducc0(engine, c, points, weights)


program = sys.argv[1]
with tempfile.TemporaryDirectory() as name:
    main(Path(name))
sys.exit(bad)

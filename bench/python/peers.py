"""Averaged spectra of arrays by this module, finufft's Python, sums of NumPy and healpy, in one run: seconds and errors.

    pip install finufft healpy
    ./dev build && POINTSPEC_LIBRARY=build/dev/libpointspec.so PYTHONPATH=python python3 bench/python/peers.py

Seconds are by the clock, of the fastest of five; two processors unless OMP_NUM_THREADS says otherwise. The error is that of
the coefficients S(k), or c_lm, of the first set against the referee's: root mean square over sqrt(N).
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import pointspec

try:
    import finufft
    import healpy
except ImportError as error:
    raise SystemExit(f"not measured, for want of {error.name}") from error

THREADS = int(os.environ.get("OMP_NUM_THREADS", os.cpu_count() or 1))


def fastest(call: Callable[[], Any], times: int = 5) -> float:
    seconds = []
    for _ in range(times + 1):  # the first one makes kernels and plans
        begin = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - begin)
    return min(seconds[1:])


def rings(power: np.ndarray, most: int) -> np.ndarray:
    """Means over rings as the program has them: b^2 - b + 1 <= |k|^2 <= b^2 + b."""
    k = np.arange(-most, most + 1)
    ring = np.rint(np.sqrt(k[:, None] ** 2 + k[None, :] ** 2)).astype(int).ravel()
    sums = np.bincount(ring, power.ravel())
    return (sums / np.bincount(ring))[1 : most + 1]


def torus(num: int, sets: int, most: int, tolerance: float) -> None:
    points = np.random.default_rng(1).random((sets, num, 2))
    size = 2 * most + 1
    own = {"max_frequency": most, "tol": tolerance, "no_self_check": True}  # no peer checks itself
    # The referee takes N (2K+1)^2 steps; beyond a billion finufft at 1e-14 is one.
    plans = [finufft.Plan(1, (size, size), eps=tolerance / 10, isign=-1, nthreads=n) for n in (THREADS, 1)]
    exact = finufft.Plan(1, (size, size), eps=1e-14, isign=-1)

    def transform(x: np.ndarray, plan: Any = plans[1]) -> np.ndarray:
        plan.setpts(2 * np.pi * (x[:, 0] - 0.5), 2 * np.pi * (x[:, 1] - 0.5))
        return plan.execute(np.ones(num, dtype=complex))

    if num * size**2 < 1e9:
        reference = pointspec.power(points[:1], coefficients=True, max_frequency=most, engine="host_direct").coefficients
    else:
        reference = transform(points[0], exact)

    def of_finufft(plan: Any) -> np.ndarray:
        return rings(np.mean([np.abs(transform(x, plan)) ** 2 for x in points], axis=0) / num, most)

    def sums(x: np.ndarray) -> np.ndarray:
        k = np.arange(-most, most + 1)
        first, second = (np.exp(-2j * np.pi * np.outer(k, x[:, i])) for i in range(2))
        return first @ second.T

    def of_numpy() -> np.ndarray:
        return rings(np.mean([np.abs(sums(x)) ** 2 for x in points], axis=0) / num, most)

    def error(found: np.ndarray) -> float:
        return float(np.sqrt(np.mean(np.abs(np.abs(found) - np.abs(reference)) ** 2) / num))

    coefficients = pointspec.power(points[:1], coefficients=True, **own).coefficients
    rows = [
        ("pointspec", lambda: pointspec.power(points, **own), error(coefficients)),
        ("pointspec, checked", lambda: pointspec.power(points, **own | {"no_self_check": None}), error(coefficients)),
        (f"finufft, {THREADS} threads", lambda: of_finufft(plans[0]), error(transform(points[0]))),
        ("finufft, one thread", lambda: of_finufft(plans[1]), error(transform(points[0]))),
    ]
    if num * sets < 1e6:
        rows.append(("NumPy", of_numpy, error(sums(points[0]))))
    show(f"torus, N = {num}, K = {most}, M = {sets}", rows)


def sphere(num: int, sets: int, most: int) -> None:
    points = np.random.default_rng(1).normal(size=(sets, num, 3))
    points /= np.linalg.norm(points, axis=2)[:, :, None]
    nside = 1 << int(np.ceil(np.log2(most)))
    reference = pointspec.angular(points[:1], coefficients=True, max_degree=most, engine="host_direct").coefficients

    def alm(x: np.ndarray) -> np.ndarray:
        counts = np.bincount(healpy.vec2pix(nside, *x.T), minlength=12 * nside**2)
        return healpy.map2alm(counts * (12 * nside**2 / (4 * np.pi)), lmax=most, iter=0)

    def of_healpy() -> np.ndarray:
        return np.mean([healpy.alm2cl(alm(x)) for x in points], axis=0)

    def error(found: np.ndarray) -> float:
        return float(np.sqrt(np.mean(np.abs(found - reference) ** 2) / num * 4 * np.pi))

    own = pointspec.angular(points[:1], coefficients=True, max_degree=most).coefficients
    rows = [
        ("pointspec", lambda: pointspec.angular(points, max_degree=most, no_self_check=True), error(own)),
        ("pointspec, checked", lambda: pointspec.angular(points, max_degree=most), error(own)),
        ("healpy, binned", of_healpy, error(np.conj(alm(points[0])))),
    ]
    show(f"sphere, N = {num}, L = {most}, M = {sets}", rows)


def show(case: str, rows: list[tuple[str, Callable[[], Any], float]]) -> None:
    seconds = [fastest(call) for _, call, _ in rows]
    for (name, _, error), own in zip(rows, seconds):
        print(f"| {case} | {name} | {own / seconds[0]:.2g} | {own * 1e3:.3g} | {error:.1e} |")


print("| case | by | ratio | ms | error |\n|---|---|---:|---:|---:|")
torus(1024, 100, 64, 1e-6)
torus(16384, 8, 256, 1e-6)
torus(1000000, 1, 512, 1e-6)
sphere(1024, 100, 64)
sphere(16384, 8, 256)

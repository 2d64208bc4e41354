#!/usr/bin/env python3
"""Computes anew the numbers that the pages of this folder call "recomputed", each from the
definition on one side and the formula on the other; exit code 1 when one is not what they say.

    python3 docs/mathematics/recompute.py        some seconds; needs mpmath (python3-mpmath)
"""
import json
import math
import pathlib
import random
import sys

from mpmath import (acos, besseli, besselj, cos, diff, exp, factorial, findroot, gamma, hyp2f1, inf,
                    legendre, linspace, mp, mpf, nsum, pi, psi, quad, sin, sinh, sqrt)

REFERENCE = pathlib.Path(__file__).resolve().parents[2] / "tests" / "reference"
SMOOTHNESS = [mpf(11) / 10, mpf(3) / 2, mpf(19) / 10]
ZERO = 1e-30  # what is less is 0 and rounding
failures = []


def claim(page, what, value, stated, tolerance):
    """value is stated within the tolerance, relative but for what is 0."""
    error = abs(value - stated) / (abs(stated) if abs(stated) > ZERO else 1)
    verdict = "" if error <= tolerance else "   NOT WHAT IS STATED"
    print(f"{page:11} {what:58} {mp.nstr(mpf(value), 8):>14} {mp.nstr(mpf(stated), 8):>14}{verdict}")
    if verdict:
        failures.append(what)


# ---- the torus --------------------------------------------------------------------------------


def lens(q, r):
    """Area that two disks of radius r at the distance q share."""
    if q >= 2 * r:
        return 0
    return 2 * r * r * math.acos(q / (2 * r)) - q / 2 * math.sqrt(4 * r * r - q * q)


def disk_autocorrelation(dx, dy, r):
    return sum(lens(math.hypot(dx + i, dy + j), r) for i in range(-2, 3) for j in range(-2, 3))


def variance_from_pairs(points, weights, r):
    """(V2) of a disk."""
    total = sum(w * v * disk_autocorrelation(p[0] - q[0], p[1] - q[1], r)
                for p, w in zip(points, weights) for q, v in zip(points, weights))
    return total / sum(weights) ** 2 - (math.pi * r * r) ** 2


def disk_powers(r, last):
    """[(k, |f_k|^2)] for 0 < |k| <= last, and what is left beyond."""
    powers, of_norm = [], {}
    for kx in range(-last, last + 1):
        for ky in range(-last, last + 1):
            n = kx * kx + ky * ky
            if 0 < n <= last * last:
                if n not in of_norm:
                    of_norm[n] = r * r * float(besselj(1, 2 * math.pi * r * math.sqrt(n))) ** 2 / n
                powers.append(((kx, ky), of_norm[n]))
    area = math.pi * r * r
    return powers, area - area * area - sum(power for _, power in powers)


def jittered_power(nu):
    """(J) in units of the cells."""
    return 1 - math.prod(1 if x == 0 else (math.sin(math.pi * x) / (math.pi * x)) ** 2 for x in nu)


def jittered_points(cells):
    return [((i + random.random()) / cells, (j + random.random()) / cells)
            for i in range(cells) for j in range(cells)]


def simulated_variance(num_sets, is_shifted):
    """Of the share of 4 jittered points in a disk of radius 1/4 in the middle."""
    total = squares = 0
    for _ in range(num_sets):
        a, b = (random.random(), random.random()) if is_shifted else (0, 0)
        share = sum(((x + a) % 1 - .5) ** 2 + ((y + b) % 1 - .5) ** 2 < .0625
                    for x, y in jittered_points(2)) / 4
        total += share
        squares += share * share
    return squares / num_sets - (total / num_sets) ** 2


def simulated_power(num_sets):
    """Of 64 jittered points at k = (1,0)."""
    total = 0
    for _ in range(num_sets):
        phases = [2 * math.pi * x for x, _ in jittered_points(8)]
        total += (sum(map(math.cos, phases)) ** 2 + sum(map(math.sin, phases)) ** 2) / 64
    return total / num_sets


def torus():
    for s in json.loads((REFERENCE / "torus.json").read_text())["sets"]:
        points = [[float(x) for x in point] for point in s["x"]]
        weights = [float(w) for w in s["w"]] if s.get("w") else [1.0] * len(points)
        for row in s.get("variance", []):
            if row["integrand"] == "disk":
                value = variance_from_pairs(points, weights, float(row["r"]))
                claim("torus", f"(V2), {s['name']}, r = {float(row['r'])}", value,
                      float(row["var_random_shift"]), 1e-11)
    random.seed(7)
    points = [(random.random(), random.random()) for _ in range(5)]
    weights = [1, 2, .5, -.3, 1.2]
    powers, rest = disk_powers(.25, 90)
    value = 0
    for k, power in powers:
        phases = [2 * math.pi * (k[0] * x + k[1] * y) for x, y in points]
        value += power * (sum(w * math.cos(p) for w, p in zip(weights, phases)) ** 2
                          + sum(w * math.sin(p) for w, p in zip(weights, phases)) ** 2)
    value += rest * sum(w * w for w in weights)
    claim("torus", "(V1) and (V2), 5 weighted points", value / sum(weights) ** 2,
          variance_from_pairs(points, weights, .25), 1e-5)
    jittered = sum(power * jittered_power((k[0] / 2, k[1] / 2)) for k, power in powers)
    claim("torus", "(V1), 4 jittered points", (jittered + rest) / 4, 0.02969, 1e-3)
    claim("torus", "4 jittered points, shifted, 100000 sets", simulated_variance(100000, True),
          0.02969, 2e-2)
    claim("torus", "the same without shifts", simulated_variance(100000, False), 0.0396, 2e-2)
    uniform = lambda z: pi * z / 2 * besselj(1, z) ** 2
    top = findroot(lambda z: diff(uniform, z), mpf("2.1"))
    claim("torus", "envelope of the disk", uniform(top), 1.0692034, 1e-7)
    claim("torus", "envelope of the disk, where", top, 2.166, 1e-3)


def samplers():
    directions = [(math.cos(math.radians(a)), math.sin(math.radians(a))) for a in range(46)]
    steps = [q / 1000 for q in range(1, 2000)]
    def least(power):  # alpha such that half of the quadratic profile is below the power
        return max(nu * math.sqrt(.5 / power(nu)) for nu in steps if power(nu) < .5)
    each = max(least(lambda nu, c=c, s=s: jittered_power((nu * c, nu * s))) for c, s in directions)
    claim("samplers", "alpha of jittered points, every direction", each, 0.4508, 2e-3)
    claim("samplers", "alpha of jittered points, axis", least(lambda nu: jittered_power((nu,))), 0.4430, 2e-3)
    turns = [2 * math.pi * (i + .5) / 64 for i in range(64)]
    mean = lambda nu: sum(jittered_power((nu * math.cos(a), nu * math.sin(a))) for a in turns) / 64
    claim("samplers", "alpha of jittered points, mean", least(mean), 0.4468, 2e-3)
    nu = mpf(1) / 100
    claim("samplers", "second term of the mean", (1 - mean(float(nu)) / (math.pi ** 2 / 3 * nu ** 2)) / nu ** 2,
          1.398, 1e-3)


# ---- the sphere -------------------------------------------------------------------------------


def sphere():
    def squared_norm(l, m, factor):
        """Of sqrt(factor) P_l^m(cos theta) e^{i m phi}."""
        return factor * 2 * pi * quad(
            lambda z: diff(lambda x: legendre(l, x), z, m) ** 2 * (1 - z * z) ** m, [-1, 0, 1])
    right = mpf(7) / (4 * pi) * factorial(1) / factorial(5)
    claim("sphere", "squared norm of Y_32", squared_norm(3, 2, right), 1, 1e-15)
    claim("errata", "the same, S-15", squared_norm(3, 2, 2 * right), 2, 1e-15)
    claim("errata", "the same, (2) of M18", squared_norm(3, 2, mpf(7) / (4 * pi) * 120), 14400, 1e-15)
    golden = (1 + sqrt(5)) / 2
    corners = [v for a in (1, -1) for b in (golden, -golden) for v in ((0, a, b), (a, b, 0), (b, 0, a))]
    for l, stated in ((2, 0), (4, 0), (6, 5.28), (8, 0), (14, 0)):
        cosines = [sum(x * y for x, y in zip(u, corners[0])) / (1 + golden ** 2) for u in corners]
        claim("sphere", f"icosahedron, P({l})", sum(legendre(l, x) for x in cosines), stated, 1e-12)
    x, last = cos(pi / 3), 3000
    p = [mpf(1), x]
    for l in range(1, last + 2):
        p.append(((2 * l + 1) * x * p[l] - l * p[l - 1]) / (l + 1))
    squares = [0] + [pi / (2 * l + 1) * (p[l - 1] - p[l + 1]) ** 2 for l in range(1, last + 1)]
    area = 2 * pi * (1 - x)
    claim("sphere", "F_30 of a cap", sqrt(squares[3]),
          abs(2 * pi * sqrt(7 / (4 * pi)) * quad(lambda z: legendre(3, z), [x, 1])), 1e-15)
    claim("sphere", "energy of a cap beyond l = 3000", area - area ** 2 / (4 * pi) - sum(squares), 5.77213e-4, 1e-5)
    claim("errata", "l^2 F_l0^2 over 4 sin t", max(l * l * squares[l] for l in range(last)) / (4 * sin(pi / 3)),
          0.933, 1e-3)
    claim("sphere", "(H1), z^2 and white noise", (2 * pi) ** 2 * (mpf(1) / 5 - mpf(1) / 9),
          16 * pi ** 2 / 45, 1e-20)


# ---- quadrature -------------------------------------------------------------------------------


def eigenvalues(s, last):
    """(K1)."""
    a = [4 * pi * 2 ** (2 * s - 2) / s]
    a.append(a[0] * (s - 1) / (s + 1))
    for l in range(1, last):
        a.append(a[l] * (l + 1 - s) / (l + 1 + s))
    return a


def diffuse(last):
    b = [1 / (2 * sqrt(pi)), 1 / sqrt(3 * pi)] + [mpf(0)] * (last - 1)
    g = mpf(1) / 2
    for l in range(2, last + 1, 2):
        b[l] = (-1) ** (l // 2 + 1) * sqrt((2 * l + 1) / pi) * g / ((l - 1) * (l + 2))
        g *= mpf(l + 1) / (l + 2)
    return b


def glossy(n, last):
    """Not cut."""
    return [unit(l, 4 * pi) * besseli(l + mpf(1) / 2, n) / besseli(mpf(1) / 2, n)
            for l in range(last + 1)]


def unit(l, area):
    """Of P_l(z) times this the integral of the square over the sphere is 1, for area 4 pi."""
    return sqrt((2 * l + 1) / area)


def squared_norm_of(a, b):
    return sum(x * y * y for x, y in zip(a, b))


def kernel():
    for s in SMOOTHNESS:
        c, a = 2 ** (2 * s - 1) / s, eigenvalues(s, 3001)
        for l in (0, 1, 2, 10):
            integral = 2 * pi * quad(lambda t: (c - (2 * t) ** (s - 1)) * legendre(l, 1 - t), [0, .01, .5, 1, 2])
            claim("quadrature", f"a_{l}, s = {mp.nstr(s, 2)}", a[l], integral, 1e-24)
        a_of_gamma = (-4 * pi * 2 ** (2 * s - 2) / s * gamma(3001 - s) * gamma(1 + s)
                      / gamma(3001 + s) / gamma(1 - s))
        claim("quadrature", f"a_3000, s = {mp.nstr(s, 2)}", a[3000], a_of_gamma, 1e-24)
        tail = 3001 * (3001 + s) * a[3001] / (4 * pi * (s - 1))
        total = sum(a[l] * (2 * l + 1) for l in range(1, 3001)) / (4 * pi) + tail
        claim("quadrature", f"tau_0, s = {mp.nstr(s, 2)}", total, 2 ** (2 * s - 2) / s, 1e-24)


def lobes():
    b, n = diffuse(8), mpf(1)
    for l in range(9):
        integral = quad(lambda z: legendre(l, z) * z, [0, 1])
        claim("quadrature", f"diffuse b_{l}", b[l], unit(l, pi) * integral, 1e-24)
    for n in (mpf(1), mpf(5), mpf(30)):
        for l, value in enumerate(glossy(n, 3)):
            integral = quad(lambda z: exp(n * (z - 1)) * legendre(l, z), [-1, 0, .5, 1]) * n / (1 - exp(-2 * n))
            claim("quadrature", f"glossy b_{l}, n = {int(n)}, not cut", value,
                  unit(l, 4 * pi) * integral, 1e-24)
            order = l + mpf(1) / 2
            printed = exp(-n) / (1 - exp(-n)) * sqrt(n * order) * besseli(order, n)
            claim("errata", f"(27) over that, l = {l}", printed / value, 1 + exp(-n), 1e-24)
            exact = exp(-n / 2) / (1 - exp(-n)) * sqrt(n * order) * besseli(order, n / 2)
            integral = quad(lambda z: exp(n * (z - 1)) * legendre(l, 2 * z - 1), [0, .5, 1])
            claim("errata", f"(30), l = {l}", exact,
                  unit(l, 2 * pi) * integral * n / (1 - exp(-n)), 1e-24)
    for l in range(2, 9, 2):
        printed = unit(l, pi) / (2 * l * (l - 1) * (l + 2)) * factorial(l) / factorial(l // 2) ** 2
        claim("errata", f"(22) with 2 l, l = {l}", printed / abs(b[l]), mpf(2) ** l / (2 * l), 1e-24)
    phong = [1 / (n + 1), 1 / (n + 2)]
    for l in range(2, 9):
        phong.append(phong[l - 2] * (n - l + 2) / (n + l + 1))
    for l in (2, 5, 8):
        integral = quad(lambda z: z ** n * legendre(l, z), [0, .5, 1])
        claim("quadrature", f"Phong G_{l}, n = 30", phong[l], integral, 1e-20)


def half_range(m, l):
    """M_ml."""
    integral = quad(lambda z: legendre(m, 2 * z - 1) * legendre(l, z), [0, 1])
    return sqrt(mpf((2 * l + 1) * (2 * m + 1)) / 2) * integral


def truncation():
    claim("quadrature", "M_10", half_range(1, 0), 0, 1e-24)
    claim("quadrature", "M_11", half_range(1, 1), 1 / sqrt(8), 1e-20)
    claim("quadrature", "sum of M_0l^2, l < 40", sum(half_range(0, l) ** 2 for l in range(40)), 0.992, 1e-3)
    for l in range(2, 5):
        claim("errata", f"diffuse b~_{l}", quad(lambda z: legendre(l, 2 * z - 1) * z, [0, 1]), 0, 1e-24)
    a, b, lobe = eigenvalues(mpf(3) / 2, 1500), diffuse(1499), glossy(mpf(30), 60)
    error = lambda b, last: sqrt(sum(a[l] * b[l] ** 2 for l in range(last + 1, len(b))))
    for last, stated in ((2, 9.861e-3), (3, 9.861e-3), (4, 2.656e-3), (6, 1.066e-3), (8, 5.29e-4)):
        claim("quadrature", f"diffuse E({last})", error(b, last), stated, 3e-4)
    for last, stated in ((10, 1.210e-2), (11, 7.38e-3), (12, 4.40e-3), (13, 2.560e-3), (14, 1.45e-3)):
        claim("quadrature", f"glossy E({last})", error(lobe, last), stated, 3e-3)
    claim("errata", "(50), diffuse, L = 2", sum(a[l] * b[l] * pi * b[l] for l in range(3, 1500)), 3.055e-4, 1e-4)


def fibonacci_error(num):
    """(Q1) of spherical Fibonacci points, diffuse, s = 3/2, in double precision."""
    points = []
    for j in range(num):
        height = 1 - (2 * j + 1) / (2 * num)
        z, turn = math.sqrt(height), 2 * math.pi * math.fmod(j * 2 / (1 + math.sqrt(5)), 1)
        points.append((math.sqrt(1 - height) * math.cos(turn), math.sqrt(1 - height) * math.sin(turn), z))
    a, b = ([float(x) for x in row] for row in (eigenvalues(mpf(3) / 2, 2000), diffuse(2000)))
    series = [a[l] * b[l] * math.sqrt((2 * l + 1) / (4 * math.pi)) for l in range(401)]
    kappa = 0
    for _, _, z in points:
        before, now = 1.0, z
        kappa += series[0] + series[1] * z
        for l in range(1, 400):
            before, now = now, ((2 * l + 1) * z * now - l * before) / (l + 1)
            kappa += series[l + 1] * now
    distance = 2 * sum(math.dist(points[i], points[j]) for i in range(num) for j in range(i))
    return math.sqrt(8 / 3 - distance / num ** 2 - 2 * kappa / num + squared_norm_of(a, b))


def worst_case():
    wallis = lambda q: sqrt(pi) / 2 * gamma((q + 1) / 2) / gamma(q / 2 + 1)
    stated_d_0 = "0.973390620443737", "0.965775773191709", "1.06978693775332"
    for s, stated in zip(SMOOTHNESS, stated_d_0):
        w, v, c = wallis(2 * s), wallis(2 * s + 2), 2 ** (2 * s - 1) / s
        d_0 = 4 / (3 * pi) * 2 ** (2 * s - 1) * (4 * (w - v) + 2 / s * w - 4 / (s + 1) * v)
        claim("quadrature", f"D_0, diffuse, s = {mp.nstr(s, 2)}", d_0, mpf(stated), 1e-14)
        a, b = eigenvalues(s, 20000), diffuse(19999)
        claim("quadrature", "the same, series", c - squared_norm_of(a, b), d_0, 1e-22)
        n, lobe = mpf(5), glossy(mpf(5), 60)
        d_0 = 2 * n * exp(-2 * n) / (1 - exp(-2 * n)) ** 2 * quad(
            lambda t: (4 - t * t) ** (s - 1) * sinh(n * t), [0, 1, 1.5, 2])
        claim("quadrature", "D_0, glossy, n = 5", c - squared_norm_of(a, lobe), d_0, 1e-20)
        rings(s)
    for num, stated in ((64, 3.4513e-2), (930, 4.4580e-3)):
        claim("quadrature", f"E of {num} Fibonacci points, diffuse", fibonacci_error(num), stated, 2e-5)


def mean_power(s, z, other):
    """R_s: the mean over azimuths of |u-v|^(2s-2)."""
    high, low = max(z, other), min(z, other)
    q = (1 + high) * (1 - low)
    return q ** (s - 1) * hyp2f1(1 - s, 1 - s, 1, (1 - high) * (1 + low) / q)


def rings(s):
    z = mpf(6) / 10
    chord = lambda phi: (2 - 2 * (z * mpf(3) / 10 + sqrt((1 - z * z) * (1 - mpf(9) / 100)) * cos(phi))) ** (s - 1)
    claim("quadrature", "R_s", mean_power(s, z, mpf(3) / 10), quad(chord, linspace(0, pi, 5)) / pi, 1e-16)

    def ring(theta, g):
        x, y = cos(theta) * cos(g), sin(theta) * sin(g)
        if x >= y:
            return x
        return mpf(0) if x <= -y else (x * acos(-x / y) + sqrt(y * y - x * x)) / pi

    def by_rings(theta):
        split = sorted({mpf(0), abs(pi / 2 - theta), min(pi / 2 + theta, 3 * pi / 2 - theta), pi})
        return quad(lambda g: (2 * sin(g / 2)) ** (2 * s - 2) * ring(theta, g) * 2 * sin(g), split)

    by_heights = quad(lambda other: 2 * other * mean_power(s, z, other), [0, z, 1])
    claim("quadrature", "D at z = 0.6", by_rings(acos(z)), by_heights, 1e-12)
    claim("quadrature", "D at z = 1", by_rings(mpf("1e-12")), 2 ** s / (s * (s + 1)), 1e-12)
    claim("quadrature", "D at z = -1", by_rings(pi - mpf("1e-12")),
          2 ** s * ((2 ** (s + 1) - 1) / (s + 1) - (2 ** s - 1) / s), 1e-12)


# ---- the rest ---------------------------------------------------------------------------------


def errata():
    area = pi / 16
    claim("errata", "E-13, disk", 1 / (1 - area), 1.2443, 1e-4)
    claim("errata", "E-13, Gaussian", 1 / (1 - 4 * pi / 100), 1.1437, 1e-4)
    claim("errata", "E-40 at k = (1,0), N = 64", jittered_power((1 / 8, 0)), 0.0504, 2e-3)
    claim("errata", "the same, 10000 sets", simulated_power(10000), 0.0504, 4e-2)
    claim("errata", "S-28", 4 * pi * 5 / sum(2 * l + 1 for l in range(1, 5)), 2.62, 1e-2)
    claim("errata", "S-37", 4 * pi * 55 / sum(l * l * (2 * l + 1) for l in range(1, 5)), 3.01, 1e-2)
    rest = psi(1, 8)
    claim("errata", "S-39, counted twice", (8 / mpf(64) + rest) / (7 / mpf(64) + rest), 1.06, 1e-2)
    claim("errata", "sum of 1/l^2 from 8", rest, nsum(lambda l: 1 / l ** 2, [8, inf]), 1e-15)
    claim("numerics", "P_2000(1 + 6e-8)", legendre(2000, 1 + mpf("6e-8")), 1.1237, 1e-4)


if __name__ == "__main__":
    mp.dps = 30
    for part in (torus, samplers, sphere, kernel, lobes, truncation, worst_case, errata):
        part()
    sys.exit(1 if failures else 0)

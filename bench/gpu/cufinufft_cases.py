"""cuFINUFFT in the table of bench_device. Standard input: lines "DIMENSION N K R TOLERANCE single|double".

A plan for all realizations, then for each: points from host memory, set points, execute, |S|^2 on the device.
The error is the root mean square of |S| - |S_referee| over some frequencies, in units of sqrt(N)."""

import statistics
import sys
import time

import cufinufft
import cupy
import numpy

REPEATS = 5
MOST_SETS = 64  # realizations that differ; more of them use the same points again
MOST_REALIZATIONS = 1024  # of a case; each is a call, and takes as long as any other
SAMPLES = 64


def reference(points, frequencies):
    phases = (points.astype(numpy.longdouble) @ frequencies.T.astype(numpy.longdouble)) % 1
    return numpy.abs(numpy.exp(-2j * numpy.pi * phases.astype(numpy.float64)).sum(axis=0))


def run_case(line):
    words = line.split()
    dimension, num, reach, realizations = (int(word) for word in words[:4])
    real, kind = {"single": ("float32", "complex64"), "double": ("float64", "complex128")}[words[5]]
    realizations = min(realizations, MOST_REALIZATIONS)
    random = numpy.random.default_rng(1)
    points = random.random((min(realizations, MOST_SETS), num, dimension))
    centred = numpy.ascontiguousarray(
        (2 * numpy.pi * (points - (points >= 0.5))).transpose(0, 2, 1), dtype=real)
    weights = cupy.ones(num, kind)
    plan = cufinufft.Plan(1, (2 * reach + 1,) * dimension, 1, float(words[4]), -1, kind)

    def transform(realization):
        coordinates = cupy.asarray(centred[realization % len(centred)])
        plan.setpts(*coordinates)
        return plan.execute(weights)

    def run():
        begin = time.perf_counter()
        for realization in range(realizations):
            sums = transform(realization)
            power = sums.real**2 + sums.imag**2
        cupy.cuda.Device().synchronize()
        return (time.perf_counter() - begin) / realizations, power

    run()
    each = statistics.median(run()[0] for _ in range(REPEATS))
    frequencies = random.integers(-reach, reach + 1, (SAMPLES, dimension))
    found = numpy.abs(cupy.asnumpy(transform(0))[tuple((frequencies + reach).T)])
    error = numpy.sqrt(numpy.mean((found - reference(points[0], frequencies)) ** 2) / num)
    text = " ".join(words)
    print(f"{text:29} {'cufinufft':12} {realizations:7} {each * 1e6:11.2f} {error:9.1e} {'-':>9} {'-':>8} {'-':>8}",
          flush=True)


for each_line in sys.stdin:
    run_case(each_line)

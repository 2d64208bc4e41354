"""The library of C loops, and the functions of loops.c in it."""

import ctypes

import numpy as np

SUFFIX = {np.float32: "single", np.float64: "double"}
PRECISION = {"single": np.float32, "double": np.float64}

_library = None


def load(folder):
    global _library
    _library = ctypes.CDLL(str(folder / "libloops.so"))


def library():
    return _library


def pointer(array):
    return ctypes.c_void_p(array.ctypes.data)


def accumulate(modes, sums, precision):
    function = getattr(_library, "accumulate_" + precision)
    function(pointer(modes), ctypes.c_int64(sums.size), pointer(sums))


def finufft(precision, plan, setpts, execute, points, first, count, weights, modes, sums):
    """Seconds of accumulating."""
    accumulating = ctypes.c_double(0)
    _, dimension, num_points = points.shape
    error = getattr(_library, "finufft_loop_" + precision)(
        plan, setpts, execute, dimension, ctypes.c_int64(num_points), pointer(points),
        ctypes.c_int64(first), ctypes.c_int64(count), pointer(weights), pointer(modes),
        ctypes.c_int64(sums.size), pointer(sums), ctypes.byref(accumulating))
    if error:
        raise RuntimeError(f"finufft returned {error}")
    return accumulating.value


def nfft(plan, set_x, adjoint, points, first, count, sums):
    """Seconds of accumulating."""
    accumulating = ctypes.c_double(0)
    _, num_points, dimension = points.shape
    _library.nfft_loop(
        plan, set_x, adjoint, dimension, ctypes.c_int64(num_points), pointer(points),
        ctypes.c_int64(first), ctypes.c_int64(count), ctypes.c_int64(sums.size), pointer(sums),
        ctypes.byref(accumulating))
    return accumulating.value


def direct_sums(points, frequencies):
    num_points, dimension = points.shape
    sums = np.empty(len(frequencies), np.complex128)
    _library.direct_sums(
        pointer(points), ctypes.c_int64(num_points), dimension, pointer(frequencies),
        ctypes.c_int64(len(frequencies)), pointer(sums))
    return sums

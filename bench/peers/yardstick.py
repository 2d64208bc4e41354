"""FFTW's transform of 1280 x 1280 complex single precision numbers, by two threads: median of five fresh plans
by MEASURE. It tells one machine, and one hour, from another."""

import ctypes
import time

import numpy as np

import loops

SIZE, PLANS, RUNS, THREADS = 1280, 5, 7, 2


def measure():
    """Milliseconds, or None when FFTW is not there."""
    try:
        fftw = ctypes.CDLL("libfftw3f.so.3", mode=ctypes.RTLD_GLOBAL)
        threads = ctypes.CDLL("libfftw3f_omp.so.3")
    except OSError:
        return None
    fftw.fftwf_plan_dft_2d.restype = ctypes.c_void_p
    threads.fftwf_init_threads()
    threads.fftwf_plan_with_nthreads(THREADS)
    noise = np.random.default_rng(1).standard_normal((2, SIZE, SIZE), np.float32)
    grid = np.empty((SIZE, SIZE), np.complex64)
    times = []
    for _ in range(PLANS):
        fftw.fftwf_forget_wisdom()
        plan = ctypes.c_void_p(
            fftw.fftwf_plan_dft_2d(SIZE, SIZE, loops.pointer(grid), loops.pointer(grid), -1, 0))
        best = []
        for _ in range(RUNS):
            grid.real, grid.imag = noise
            begin = time.perf_counter()
            fftw.fftwf_execute(plan)
            best.append(time.perf_counter() - begin)
        fftw.fftwf_destroy_plan(plan)
        times.append(np.median(best))
    fftw.fftwf_forget_wisdom()
    threads.fftwf_plan_with_nthreads(1)
    return 1e3 * float(np.median(times))

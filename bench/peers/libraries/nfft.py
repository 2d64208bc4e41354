"""NFFT 3 (pynfft3), adjoint transform in double precision through its C interface. Options: the window's
cut-off m decides the error; oversampling, precomputed windows or not, FFTW's planner, threads."""

import ctypes
import math

import numpy as np

import loops
from runner import Runner, thread_choices

LARGEST_MEASURED = 1 << 20  # modes
DIGITS = 0.6  # of the cut-off for one digit, sigma = 2
MOST_WINDOW_BYTES = 2 << 30


def smooth(number):
    """The next even 2-3-5-7-smooth number."""
    number += number % 2
    while True:
        rest = number
        for prime in (2, 3, 5, 7):
            while rest % prime == 0:
                rest //= prime
        if rest == 1:
            return number
        number += 2


def cut_off(tolerance):
    return round(DIGITS * -math.log10(tolerance))


class Nfft:
    name = "NFFT"
    precisions = ("double",)
    knob = "m"

    def __init__(self, folder):
        import pyNFFT3
        from importlib.metadata import version

        self.flags = pyNFFT3.flags
        self.library = pyNFFT3._nfftlib
        self.create = pyNFFT3.NFFT
        self.version = version("pynfft3")
        self.how = (folder / "nfft.how").read_text().strip()
        self.library.fftw_init_threads()

    def accuracies(self, points, precision):
        return [{"sigma": sigma} for sigma in (1.5, 2.0)]

    def ladder(self, precision):
        return list(range(1, 15))

    def guess(self, precision, tolerance):
        return cut_off(tolerance)

    def variants(self, points, precision):
        small = points.case.num_modes < LARGEST_MEASURED
        return [
            {"windows": windows, "planner": planner, "plans": plans, "threads": threads}
            for plans, threads in thread_choices(points)
            for planner in ["estimate"] + ["measure"] * (small and threads == 1)
            for windows in ("computed", "precomputed")
        ]

    def open(self, points, precision, m, sigma, windows, planner, plans, threads):
        self.library.omp_set_num_threads(threads)  # the library has an OpenMP of its own inside
        case = points.case
        if windows == "precomputed" and 8 * (2 * m + 2) * case.dimension * case.points > MOST_WINDOW_BYTES:
            raise MemoryError("precomputed windows of NFFT would be too large")
        return Runner([Plan(self, points, m, sigma, windows, planner) for _ in range(plans)])

    def describe(self, setting):
        return (f"sigma {setting['sigma']} windows {setting['windows']} {setting['planner']} "
                f"{setting['plans']}x{setting['threads']}")


class Plan:
    def __init__(self, peer, points, m, sigma, windows, planner):
        case = points.case
        self.case, self.library = case, peer.library
        self.points = points.layout("centred double")
        flags = peer.flags
        f1 = (flags.PRE_PHI_HUT | flags.MALLOC_X | flags.MALLOC_F_HAT | flags.MALLOC_F
              | flags.FFTW_INIT | flags.FFT_OUT_OF_PLACE | flags.NFFT_SORT_NODES
              | flags.NFFT_OMP_BLOCKWISE_ADJOINT)
        if windows == "precomputed":
            f1 |= flags.PRE_PSI
        f2 = flags.FFTW_DESTROY_INPUT | (flags.FFTW_ESTIMATE if planner == "estimate" else 0)
        width = case.width + 1  # even: from -K-1 to K
        self.shape = [width] * case.dimension
        self.sums = np.zeros(width**case.dimension)
        fine = np.array([smooth(int(np.ceil(sigma * width)))] * case.dimension, dtype=np.int32)
        self.nfft = peer.create(
            np.array(self.shape, dtype=np.int32), case.points, fine, m, ctypes.c_uint32(f1),
            ctypes.c_uint32(f2))
        self.nfft.nfft_init()
        self.library.jnfft_set_x(self.nfft.plan, self.points[0])
        self.nfft.f = np.ones(case.points, np.complex128)

    def address(self, name):
        return ctypes.cast(getattr(self.library, name), ctypes.c_void_p)

    def run(self, first, count):
        return loops.nfft(
            self.nfft.plan, self.address("jnfft_set_x"), self.address("jnfft_adjoint"), self.points,
            first, count, self.sums)

    def modes(self, realization):
        self.library.jnfft_set_x(self.nfft.plan, self.points[realization])
        self.nfft.nfft_adjoint()
        inside = (slice(1, None),) * self.case.dimension
        return self.nfft._fhat.reshape(self.shape)[inside].conj().ravel()  # its sign is +

    def close(self):
        self.nfft.nfft_finalize_plan()

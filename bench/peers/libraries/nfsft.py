"""NFSFT of NFFT 3 (the library that pynfft3 brings), adjoint transform in double precision through its C
interface; its precomputation for a degree is outside of the clock. Options: the window's cut-off m decides the
error, oversampling is 2; threads. Its precomputed data have work space in them that belongs to a call, so two
calls at the same time are not possible."""

import ctypes
import time

import numpy as np

from loops_sphere import nfsft_coefficients, sum_orders_nfsft
from libraries.nfft import cut_off
from runner import Runner

THRESHOLD = 1000.0  # of its fast polynomial transform, the default
PLAN_BYTES = 4096  # its nfsft_plan has less than 1 KiB
MOST_DEGREE = 1024  # precomputation, a minute there, grows like its fourth power
THREADS = 2


class NfsftPlan(ctypes.Structure):
    """The beginning of its nfsft_plan."""

    _fields_ = [
        ("N_total", ctypes.c_ssize_t),
        ("M_total", ctypes.c_ssize_t),
        ("f_hat", ctypes.POINTER(ctypes.c_double)),
        ("f", ctypes.POINTER(ctypes.c_double)),
        ("mv_trafo", ctypes.c_void_p),
        ("mv_adjoint", ctypes.c_void_p),
        ("N", ctypes.c_int),
        ("x", ctypes.POINTER(ctypes.c_double)),
        ("rest", ctypes.c_byte * PLAN_BYTES),
    ]


class Nfsft:
    name = "NFSFT"
    precisions = ("double",)
    knob = "m"

    def __init__(self, folder):
        import pyNFFT3
        from importlib.metadata import version

        self.flags = pyNFFT3.flags
        self.library = library = pyNFFT3._nfftlib
        for name in ("nfsft_init_guru", "nfsft_adjoint", "nfsft_precompute", "omp_set_num_threads"):
            if not hasattr(library, name):
                raise ImportError(f"pynfft3 has no {name}")
        library.nfsft_precompute.argtypes = [ctypes.c_int, ctypes.c_double, ctypes.c_uint, ctypes.c_uint]
        self.version = version("pynfft3")
        self.how = (folder / "nfft.how").read_text().strip()
        self.precomputed = None
        library.fftw_init_threads()

    def precompute(self, degree, threads):
        """The library keeps it: for one degree and number of threads at a time."""
        self.library.omp_set_num_threads(threads)
        if self.precomputed != (degree, threads):
            if self.precomputed is not None:
                self.library.nfsft_forget()
            self.library.nfsft_precompute(degree, THRESHOLD, 0, 0)
            self.precomputed = (degree, threads)

    def accuracies(self, points, precision):
        return [{}]

    def ladder(self, precision):
        return list(range(1, 15))

    def guess(self, precision, tolerance):
        return cut_off(tolerance)

    def variants(self, points, precision):
        return [{"threads": THREADS}, {"threads": 1}]

    def open(self, points, precision, m, threads):
        if points.case.degree > MOST_DEGREE:
            raise MemoryError("NFSFT would precompute for a quarter of an hour")
        self.precompute(points.case.degree, threads)
        return Runner([Plan(self, points, m)])

    def describe(self, setting):
        return f"sigma 2 1x{setting['threads']}"


class Plan:
    def __init__(self, peer, points, m):
        case = points.case
        self.library, self.degree = peer.library, case.degree
        self.points = points.layout("turns double")
        self.sums = np.zeros(case.degree + 1)
        self.plan = NfsftPlan()
        flags = peer.flags
        self.library.nfsft_init_guru(
            ctypes.byref(self.plan), case.degree, case.points,
            ctypes.c_uint(flags.NFSFT_NORMALIZED | flags.NFSFT_MALLOC_F_HAT | flags.NFSFT_MALLOC_F
                          | flags.NFSFT_MALLOC_X),
            ctypes.c_uint(flags.PRE_PHI_HUT | flags.FFTW_INIT | flags.FFT_OUT_OF_PLACE | flags.NFFT_SORT_NODES
                          | flags.NFFT_OMP_BLOCKWISE_ADJOINT),
            m)
        ones = np.ones(case.points, np.complex128)
        ctypes.memmove(self.plan.f, ones.ctypes.data, ones.nbytes)
        self.f_hat = ctypes.cast(self.plan.f_hat, ctypes.c_void_p)

    def transform(self, realization):
        angles = self.points[realization]
        ctypes.memmove(self.plan.x, angles.ctypes.data, angles.nbytes)
        self.library.nfsft_precompute_x(ctypes.byref(self.plan))
        self.library.nfsft_adjoint(ctypes.byref(self.plan))

    def run(self, first, count):
        accumulating = 0.0
        for realization in range(first, first + count):
            self.transform(realization)
            begin = time.perf_counter()
            sum_orders_nfsft(self.f_hat, self.sums)
            accumulating += time.perf_counter() - begin
        return accumulating

    def modes(self, realization):
        self.transform(realization)
        return nfsft_coefficients(self.f_hat, self.degree)

    def close(self):
        self.library.nfsft_finalize(ctypes.byref(self.plan))

"""FINUFFT, type 1 with weights 1, through its C interface: a plan for all realizations, set points and execute
for each. Options: the FFT it was built with, FFTW's planner, oversampling, threads, precision."""

import ctypes
import importlib
import sys

import numpy as np

import loops
from runner import Runner, thread_choices

NAME = "finufft"
ESTIMATE, MEASURE = 64, 0  # fftw3.h
LARGEST_MEASURED = 1 << 21  # modes: FFTW's MEASURE takes a minute and more beyond
KINDS = [("ducc0", ESTIMATE), ("fftw", ESTIMATE), ("fftw", MEASURE), ("wheel", ESTIMATE)]


class Finufft:
    name = NAME
    loose_name = "finufft fp32"
    precisions = ("single", "double")
    knob = "eps"

    def __init__(self, folder):
        self.libraries = {}
        found = [kind for kind in ("fftw", "ducc0", "wheel") if (folder / f"finufft-{kind}.how").exists()]
        if not found:
            raise ImportError("not installed")
        self.how = "; ".join((folder / f"finufft-{kind}.how").read_text().strip() for kind in found)
        sys.path.insert(0, str(folder / f"finufft-{found[0]}"))
        binding = importlib.import_module("finufft._finufft")
        self.version = importlib.import_module("finufft").__version__
        self.options_type = binding.FinufftOpts
        for kind in found:
            paths = sorted((folder / f"finufft-{kind}" / "finufft").glob("*finufft*.so"))
            self.libraries[kind] = ctypes.CDLL(str(paths[0]))

    def accuracies(self, points, precision):
        """What decides about the error besides eps."""
        return [{"sigma": sigma} for sigma in (1.25, 2.0)]

    def ladder(self, precision):
        last = 21 if precision == "single" else 43
        return [10 ** (-j / 3) for j in range(3, last)]

    def guess(self, precision, tolerance):
        return sum(eps > tolerance for eps in self.ladder(precision))

    def variants(self, points, precision):
        """What decides about the time only; the first is that with which errors are measured."""
        large = points.case.num_modes >= LARGEST_MEASURED
        return [
            {"fft": kind, "planner": planner, "plans": plans, "threads": threads}
            for plans, threads in thread_choices(points)
            for kind, planner in KINDS
            if kind in self.libraries and (planner != MEASURE or (threads == 1 and not large))
        ]

    def open(self, points, precision, eps, sigma, fft, planner, plans, threads):
        library = self.libraries[fft]
        return Runner(
            [Plan(self, library, points, precision, eps, sigma, planner, threads) for _ in range(plans)])

    def describe(self, setting):
        planner = {ESTIMATE: "estimate", MEASURE: "measure"}[setting["planner"]]
        fft = setting["fft"] + (" " + planner if setting["fft"] == "fftw" else "")
        return f"sigma {setting['sigma']} {fft} {setting['plans']}x{setting['threads']}"


class Plan:
    def __init__(self, peer, library, points, precision, eps, sigma, planner, threads):
        case = points.case
        self.precision = precision
        self.letter = "f" if precision == "single" else ""
        self.library = library
        self.points = points.layout("radians " + precision)
        real = loops.PRECISION[precision]
        self.weights = np.ones(case.points, np.result_type(real, np.complex64))
        self.raw = np.zeros(case.num_modes, self.weights.dtype)
        self.sums = np.zeros(case.num_modes, real)
        options = peer.options_type()
        library.finufft_default_opts(ctypes.byref(options))
        options.showwarn = 0
        options.nthreads = threads
        options.fftw = planner
        options.upsampfac = sigma
        shape = (ctypes.c_longlong * 3)(*([case.width] * case.dimension))
        self.plan = ctypes.c_void_p()
        real_type = ctypes.c_float if precision == "single" else ctypes.c_double
        error = self.function("makeplan")(
            1, case.dimension, shape, -1, 1, real_type(eps), ctypes.byref(self.plan),
            ctypes.byref(options))
        if error > 1:  # 1: eps is smaller than can be reached, which the measured error shows
            raise RuntimeError(f"finufft_makeplan returned {error}")

    def function(self, name):
        return getattr(self.library, f"finufft{self.letter}_{name}")

    def run(self, first, count):
        return loops.finufft(
            self.precision, self.plan, self.function("setpts"), self.function("execute"), self.points,
            first, count, self.weights, self.raw, self.sums)

    def modes(self, realization):
        self.run(realization, 1)
        return self.raw

    def close(self):
        self.function("destroy")(self.plan)

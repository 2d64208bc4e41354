"""pointspec through its C library: one plan, all realizations in one call, then the spectrum. Start-up,
which the peers' times do not have either, is outside of the clock."""

import csv
import ctypes
import subprocess
import time
from typing import NamedTuple

import numpy as np

from loops_sphere import num_coefficients


class Planned(NamedTuple):
    chosen: str
    seconds: dict  # of a realization, for every engine that meets the tolerance


class Pattern(ctypes.Structure):
    """pspec_pattern"""

    _fields_ = [
        ("dimension", ctypes.c_uint),
        ("num_points", ctypes.c_size_t),
        ("points", ctypes.c_void_p),
        ("weights", ctypes.c_void_p),
    ]


class Pointspec:
    name = "pointspec"

    def __init__(self, build, question):
        self.question = question
        self.program = build / "pointspec"
        self.library = library = ctypes.CDLL(str(build / "libpointspec.so"))
        library.pspec_version.restype = ctypes.c_char_p
        library.pspec_context_create.restype = ctypes.c_void_p
        library.pspec_context_message.restype = ctypes.c_char_p
        library.pspec_plan_text.restype = ctypes.c_char_p
        library.pspec_spectrum_error.restype = ctypes.c_double
        library.pspec_spectrum_powers.restype = ctypes.POINTER(ctypes.c_double)
        self.context = ctypes.c_void_p(library.pspec_context_create())
        self.version = library.pspec_version().decode()

    def check(self, status):
        if status:
            raise RuntimeError(self.library.pspec_context_message(self.context).decode())

    def plan(self, case, tolerance, engine):
        """What `pointspec plan` says, of all engines or with this one."""
        command = [
            self.program, "plan", *self.question.arguments(case), "-n", case.points, "-m", case.realizations,
            "--tol", tolerance] + (["--engine", engine] if engine else [])
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(done.stderr.strip().splitlines()[-1])
        table = csv.DictReader(line for line in done.stdout.splitlines() if line[:1] != "#")
        chosen, seconds = None, {}
        for row in table:
            name = row["engine"].partition(":")[0]  # without the precision
            if row["verdict"] == "chosen":
                chosen = name
            if row["verdict"] in ("chosen", "slower"):
                planned = float(row["seconds"]) / case.realizations
                seconds[name] = min(planned, seconds.get(name, planned))
        if chosen is None:
            raise RuntimeError(f"{engine or 'no engine'} cannot do this")
        return Planned(chosen, seconds)

    def open(self, points, tolerance, engine):
        return PointspecRunner(self, points, tolerance, engine)


class PointspecRunner:
    def __init__(self, peer, points, tolerance, engine):
        self.peer, self.points, self.library = peer, points, peer.library
        case = points.case
        create, self.request = peer.question.request(
            case, tolerance, engine.encode() if engine else None)
        self.plan = ctypes.c_void_p()
        peer.check(getattr(self.library, create)(
            ctypes.byref(self.plan), peer.context, ctypes.byref(self.request)))
        self.text = self.library.pspec_plan_text(self.plan).decode().strip("()")
        stride = 8 * case.points * case.dimension
        start = points.rows.ctypes.data
        self.patterns = (Pattern * points.count)(
            *(Pattern(case.dimension, case.points, start + r * stride) for r in range(points.count)))

    def average(self, first, count, use):
        spectrum = ctypes.c_void_p()
        patterns = ctypes.byref(self.patterns, first * ctypes.sizeof(Pattern))
        self.peer.check(self.library.pspec_plan_reset(self.plan))
        self.peer.check(self.library.pspec_plan_run(self.plan, patterns, ctypes.c_size_t(count)))
        self.peer.check(self.library.pspec_spectrum_create(ctypes.byref(spectrum), self.plan))
        result = use(spectrum)
        self.library.pspec_spectrum_destroy(spectrum)
        return result

    def run(self, count):
        begin = time.perf_counter()
        self.average(0, count, lambda spectrum: None)
        return time.perf_counter() - begin, float("nan")

    def magnitudes(self, realization):
        """(|S| or sqrt(Q(l)) of all frequencies or degrees, the error that pointspec claims)."""
        case = self.points.case

        def use(spectrum):
            num = ctypes.c_size_t()
            self.library.pspec_spectrum_frequencies.restype = ctypes.c_void_p
            self.library.pspec_spectrum_frequencies(spectrum, ctypes.byref(num))
            powers = self.library.pspec_spectrum_powers(spectrum)
            powers = np.ctypeslib.as_array(powers, (num.value,))
            return np.sqrt(powers * case.points), self.library.pspec_spectrum_error(spectrum)

        return self.average(realization, 1, use)

    def modes(self, realization):
        """The conjugate c_lm, as those of the peers."""
        found = np.empty(num_coefficients(self.points.case.degree), np.complex128)
        pattern = ctypes.byref(self.patterns, realization * ctypes.sizeof(Pattern))
        self.peer.check(self.library.pspec_plan_coefficients(
            self.plan, pattern, 0, ctypes.c_void_p(found.ctypes.data)))
        return np.conj(found)

    def close(self):
        self.library.pspec_plan_destroy(self.plan)

"""pointspec through its C library: a question with all realizations, and its answer. What a first answer
prepares for all others, and the peers' times do not have either, is outside of the clock."""

import csv
import ctypes
import subprocess
import time
from typing import NamedTuple

import numpy as np


class Planned(NamedTuple):
    chosen: str
    seconds: dict  # of a realization, for every engine that meets the tolerance


class Field(ctypes.Structure):
    """pspec_field"""

    _fields_ = [
        ("struct_size", ctypes.c_size_t),
        ("name", ctypes.c_char_p),
        ("unit", ctypes.c_char_p),
        ("group", ctypes.c_int),
        ("type", ctypes.c_int),
        ("rank", ctypes.c_uint),
        ("shape", ctypes.POINTER(ctypes.c_size_t)),
        ("num", ctypes.c_size_t),
        ("data", ctypes.c_void_p),
    ]


TYPES = (ctypes.c_double, ctypes.c_int64, ctypes.c_double, ctypes.c_char_p)  # pspec_type
C128 = 2


class Pointspec:
    name = "pointspec"

    def __init__(self, build, question):
        self.question = question
        self.program = build / "pointspec"
        self.library = library = ctypes.CDLL(str(build / "libpointspec.so"))
        library.pspec_version.restype = ctypes.c_char_p
        library.pspec_context_create.restype = ctypes.c_void_p
        library.pspec_context_message.restype = ctypes.c_char_p
        library.pspec_answer_find.restype = ctypes.POINTER(Field)
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
        self.words = dict(peer.question.options(points.case), tol=tolerance)
        if engine:
            self.words["engine"] = engine
        self.text = self.ask(0, 1, {}, lambda answer: self.field(answer, "engine")[0]).decode()

    def ask(self, first, count, more, use):
        """What use makes of the answer for these realizations; more: options, None asks for an array."""
        library, question, answer = self.library, ctypes.c_void_p(), ctypes.c_void_p()
        case = self.points.case
        self.peer.check(library.pspec_question_create(
            ctypes.byref(question), self.peer.context, self.peer.question.kind))
        try:
            for option, value in {**self.words, "no-self-check": None, **more}.items():
                self.peer.check(library.pspec_question_set(
                    question, option.encode(), None if value is None else str(value).encode()))
            start = self.points.rows.ctypes.data + 8 * first * case.points * case.dimension
            self.peer.check(library.pspec_question_borrow(
                question, ctypes.c_size_t(count), ctypes.c_size_t(case.points), case.dimension,
                ctypes.c_void_p(start), None))
            self.peer.check(library.pspec_question_answer(ctypes.byref(answer), question))
            return use(answer)
        finally:
            library.pspec_answer_destroy(answer)
            library.pspec_question_destroy(question)

    def field(self, answer, name):
        field = self.library.pspec_answer_find(answer, name.encode()).contents
        count = field.num * (2 if field.type == C128 else 1)
        values = ctypes.cast(field.data, ctypes.POINTER(TYPES[field.type]))
        return [values[0]] if count == 1 else np.ctypeslib.as_array(values, (count,)).copy()

    def run(self, count):
        begin = time.perf_counter()
        self.ask(0, count, {}, lambda answer: None)
        return time.perf_counter() - begin, float("nan")

    def magnitudes(self, realization):
        """(|S| or sqrt(Q(l)) of all frequencies or degrees, the error that pointspec claims)."""
        case, question = self.points.case, self.peer.question

        def use(answer):
            powers = np.asarray(self.field(answer, question.powers))
            if question.powers == "full":  # the half lattice after DC
                powers = powers[powers.size // 2 + 1:]
            return np.sqrt(powers * case.points), self.field(answer, "predicted_error")[0]

        more = {"full": None} if question.powers == "full" else {}
        return self.ask(realization, 1, more, use)

    def modes(self, realization):
        """The conjugate c_lm, as those of the peers."""
        return np.conj(self.ask(realization, 1, {"coefficients": None},
                                lambda answer: self.field(answer, "coefficients").view(np.complex128)))

    def close(self):
        pass

"""The C library by ctypes: its types and functions, as pointspec.h declares them."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
from ctypes import (
    CFUNCTYPE,
    POINTER,
    Structure,
    c_char_p,
    c_double,
    c_int,
    c_size_t,
    c_uint,
    c_uint64,
    c_void_p,
)
from pathlib import Path

# Groups and types of fields (pspec_group, pspec_type).
COLUMN, ARRAY, STATE, ENTRY = range(4)
F64, I64, C128, TEXT = range(4)


class Field(Structure):
    """pspec_field: a view of what an answer, or the caller, keeps."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("unit", c_char_p),
        ("group", c_int),
        ("type", c_int),
        ("rank", c_uint),
        ("shape", POINTER(c_size_t)),
        ("num", c_size_t),
        ("data", c_void_p),
    ]


class Pattern(Structure):
    """pspec_pattern: a point set that a function of the caller shows."""

    _fields_ = [
        ("dimension", c_uint),
        ("num_points", c_size_t),
        ("points", c_void_p),
        ("weights", c_void_p),
    ]


class Report(Structure):
    """pspec_progress_report: what is being done, and how far it is."""

    _fields_ = [
        ("phase", c_char_p),
        ("done", c_uint64),
        ("total", c_uint64),
        ("detail", c_char_p),
    ]


Progress = CFUNCTYPE(c_int, POINTER(Report), c_void_p)
Sentence = CFUNCTYPE(None, c_char_p, c_void_p)
Give = CFUNCTYPE(c_int, c_uint64, POINTER(Pattern), c_void_p)
Values = CFUNCTYPE(c_int, c_size_t, c_uint, POINTER(c_double), POINTER(c_double), c_void_p)

_OUT = POINTER(c_void_p)
_FIELD = POINTER(Field)

# Results and arguments of the functions that are called; statuses are ints.
_FUNCTIONS = {
    "version": (c_char_p, []),
    "context_create": (c_void_p, []),
    "context_destroy": (None, [c_void_p]),
    "context_message": (c_char_p, [c_void_p]),
    "context_set_device": (c_int, [c_void_p, c_char_p]),
    "context_set_progress": (None, [c_void_p, Progress, c_void_p]),
    "context_set_warnings": (None, [c_void_p, Sentence, c_void_p]),
    "answer_kind": (c_char_p, [c_size_t]),
    "options_table": (c_int, [_OUT, c_void_p, c_char_p]),
    "fields_table": (c_int, [_OUT, c_void_p, c_char_p]),
    "pictures_table": (c_int, [_OUT, c_void_p, c_char_p]),
    "question_create": (c_int, [_OUT, c_void_p, c_char_p]),
    "question_reset": (None, [c_void_p]),
    "question_destroy": (None, [c_void_p]),
    "question_set": (c_int, [c_void_p, c_char_p, c_char_p]),
    "question_set_number": (c_int, [c_void_p, c_char_p, c_double]),
    "question_set_array": (c_int, [c_void_p, c_char_p, _FIELD]),
    "question_begin_set": (c_int, [c_void_p, c_char_p]),
    "question_borrow": (c_int, [c_void_p, c_size_t, c_size_t, c_uint, c_void_p, c_void_p]),
    "question_give": (c_int, [c_void_p, c_uint64, Give, c_void_p]),
    "question_integrand": (c_int, [c_void_p, c_char_p, c_double, Values, c_void_p]),
    "question_plan": (c_int, [_OUT, c_void_p]),
    "question_answer": (c_int, [_OUT, c_void_p]),
    "answer_num_fields": (c_size_t, [c_void_p]),
    "answer_field": (_FIELD, [c_void_p, c_size_t]),
    "answer_verdict": (c_char_p, [c_void_p]),
    "answer_write": (c_int, [c_void_p, c_void_p, c_char_p, c_char_p]),
    "answer_load": (c_int, [_OUT, c_void_p, c_char_p]),
    "answer_merge": (c_int, [_OUT, c_void_p, POINTER(c_void_p), c_size_t]),
    "answer_destroy": (None, [c_void_p]),
}


def _find() -> str:
    """The library beside this file, as wheels have it, else that of POINTSPEC_LIBRARY or of the system."""
    own = sorted(Path(__file__).parent.glob("libpointspec.so*"))
    named = os.environ.get("POINTSPEC_LIBRARY")
    found = named or (str(own[0]) if own else ctypes.util.find_library("pointspec"))
    if found is None:
        raise ImportError(
            "pointspec: libpointspec is neither beside the module nor among the system's libraries; "
            "POINTSPEC_LIBRARY names it elsewhere"
        )
    return found


class Library:
    """Functions of the library by their names without pspec_. Calls give the GIL back."""

    def __init__(self) -> None:
        library = ctypes.CDLL(_find())
        for name, (result, arguments) in _FUNCTIONS.items():
            function = getattr(library, "pspec_" + name)
            function.restype = result
            function.argtypes = arguments
            setattr(self, name, function)

    def __getattr__(self, name: str) -> "ctypes._FuncPointer":
        raise AttributeError(name)


library = Library()

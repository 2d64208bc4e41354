"""What is asked of pointspec: the request of its C library, and the same for `pointspec plan`."""

import ctypes


class PowerRequest(ctypes.Structure):
    """pspec_power_request"""

    _fields_ = [
        ("struct_size", ctypes.c_size_t),
        ("dimension", ctypes.c_uint),
        ("num_points", ctypes.c_size_t),
        ("num_realizations", ctypes.c_uint64),
        ("max_frequency", ctypes.c_int32),
        ("frequencies", ctypes.c_void_p),
        ("num_frequencies", ctypes.c_size_t),
        ("bins", ctypes.c_char_p),
        ("rings_only", ctypes.c_int),
        ("normalization", ctypes.c_int),
        ("tolerance", ctypes.c_double),
        ("floor", ctypes.c_double),
        ("engine", ctypes.c_char_p),
        ("precision", ctypes.c_char_p),
        ("no_self_check", ctypes.c_int),
        ("per_ring", ctypes.c_uint64),
        ("per_ring_seed", ctypes.c_uint64),
    ]


class AngularRequest(ctypes.Structure):
    """pspec_angular_request"""

    _fields_ = [
        ("struct_size", ctypes.c_size_t),
        ("num_points", ctypes.c_size_t),
        ("num_realizations", ctypes.c_uint64),
        ("max_degree", ctypes.c_int32),
        ("hemisphere", ctypes.c_int),
        ("normalization", ctypes.c_int),
        ("tolerance", ctypes.c_double),
        ("floor", ctypes.c_double),
        ("engine", ctypes.c_char_p),
        ("precision", ctypes.c_char_p),
        ("no_self_check", ctypes.c_int),
    ]


PAIRS = 2  # PSPEC_NORMALIZATION_PAIRS


class TorusQuestion:
    gives_modes = False

    def arguments(self, case):
        return ["power", "--sampler", "white", "-d", case.dimension, "-k", case.max_frequency]

    def request(self, case, tolerance, engine):
        """(the function that makes its plan, the request)"""
        return "pspec_plan_create", PowerRequest(
            struct_size=ctypes.sizeof(PowerRequest), dimension=case.dimension, num_points=case.points,
            num_realizations=case.realizations, max_frequency=case.max_frequency,
            tolerance=tolerance, engine=engine, no_self_check=1)


class SphereQuestion:
    gives_modes = True  # the coefficients that powers are made of

    def arguments(self, case):
        return ["angular", "--sampler", "white-sphere", "-l", case.degree]

    def request(self, case, tolerance, engine):
        return "pspec_plan_create_angular", AngularRequest(
            struct_size=ctypes.sizeof(AngularRequest), num_points=case.points,
            num_realizations=case.realizations, max_degree=case.degree,
            tolerance=tolerance, engine=engine, no_self_check=1)


class PairsQuestion:
    gives_modes = False

    def arguments(self, case):
        return ["pairs", "--sampler", "white-sphere", "-l", case.degree]

    def request(self, case, tolerance, engine):
        return "pspec_plan_create_angular", AngularRequest(
            struct_size=ctypes.sizeof(AngularRequest), num_points=case.points,
            num_realizations=case.realizations, max_degree=case.degree, normalization=PAIRS,
            tolerance=tolerance, engine=engine, no_self_check=1)

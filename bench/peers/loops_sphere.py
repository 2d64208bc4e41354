"""The C functions of loops_sphere.c."""

from ctypes import c_int64

import numpy as np

import loops
from loops import pointer


def num_coefficients(degree):
    """Of the orders m >= 0."""
    return (degree + 1) * (degree + 2) // 2


def sum_orders(coefficients, sums, precision):
    function = getattr(loops.library(), "sum_orders_" + precision)
    function(pointer(coefficients), c_int64(sums.size - 1), pointer(sums))


def sum_orders_nfsft(f_hat, sums):
    loops.library().sum_orders_nfsft(f_hat, c_int64(sums.size - 1), pointer(sums))


def nfsft_coefficients(f_hat, degree):
    coefficients = np.empty(num_coefficients(degree), np.complex128)
    loops.library().nfsft_coefficients(f_hat, c_int64(degree), pointer(coefficients))
    return coefficients


def plain_recurrence(degree):
    recurrence = np.empty((num_coefficients(degree), 2))
    loops.library().plain_recurrence(c_int64(degree), pointer(recurrence))
    return recurrence


def plain_coefficients(points, degree, recurrence, coefficients):
    loops.library().plain_coefficients(pointer(points), c_int64(len(points)), c_int64(degree),
                                       pointer(recurrence), pointer(coefficients))


def exact_order(points, degree, order):
    coefficients = np.empty(degree - order + 1, np.complex128)
    loops.library().exact_order(pointer(points), c_int64(len(points)), c_int64(degree), c_int64(order),
                                pointer(coefficients))
    return coefficients

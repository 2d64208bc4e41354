"""A class of exceptions for each status of the library. The message is the library's sentence."""

from __future__ import annotations


class PointspecError(Exception):
    """Something that the library refuses or could not do."""


class InvalidArgumentError(PointspecError, ValueError):
    """A kind, option or value that cannot be meant."""


class InputError(PointspecError, ValueError):
    """Points, weights, frequencies or files that cannot be used."""


class FileError(PointspecError, OSError):
    """The system refused to read or write."""


class NoMemoryError(PointspecError, MemoryError):
    """Memory of the machine, or the limit that was asked for."""


class NoDeviceError(PointspecError, RuntimeError):
    """No OpenCL driver that starts, or none that has a device."""


class DeviceError(PointspecError, RuntimeError):
    """An OpenCL call failed."""


class BuildError(PointspecError, RuntimeError):
    """A kernel did not compile."""


class ToleranceError(PointspecError, ArithmeticError):
    """No engine reaches the tolerance that was asked for."""


class CancelledError(PointspecError):
    """The progress callback asked to stop."""


class CheckError(PointspecError, ArithmeticError):
    """A check of the results failed."""


class PointspecWarning(UserWarning):
    """What the program says on standard error without failing."""


# By pspec_status, which begins with PSPEC_OK.
_CLASSES: list[type[PointspecError]] = [
    PointspecError,
    InvalidArgumentError,
    InputError,
    FileError,
    NoMemoryError,
    NoDeviceError,
    DeviceError,
    BuildError,
    ToleranceError,
    CancelledError,
    CheckError,
]


def of_status(status: int, sentence: str) -> PointspecError:
    """The exception of a status, with a sentence."""
    return _CLASSES[status if status < len(_CLASSES) else 0](sentence)

"""Contexts: one for each thread and device, kept, so that kernels and buffers are made once."""

from __future__ import annotations

import contextlib
import os
import threading
import warnings
from collections.abc import Callable, Iterator
from signal import SIGINT
from typing import Any

import _signal  # signal without its enums, which take 10 us a call

from . import _errors, _library
from ._library import library

ProgressCallback = Callable[[str, int, int, str], Any]


class Context:
    """A context of the library, with what its callbacks have said and raised during a call."""

    def __init__(self, device: str | None) -> None:
        self.handle = library.context_create()
        if self.handle is None:
            raise _errors.NoMemoryError("there is no memory for a context")
        self.process = os.getpid()
        self.progress: ProgressCallback | None = None
        self.raised: BaseException | None = None
        self.warned: list[str] = []
        self.kept: Any = None  # the question of the last call
        # The library calls them as long as it has them: they must not be collected.
        self._report = _library.Progress(self._hear)
        self._warn = _library.Sentence(self._hear_warning)
        library.context_set_progress(self.handle, self._report, None)
        library.context_set_warnings(self.handle, self._warn, None)
        if device is not None:
            self.check(library.context_set_device(self.handle, device.encode()))

    def __del__(self) -> None:
        # Names of modules are None when the interpreter ends.
        if getattr(self, "handle", None) is not None and library is not None and self.process == os.getpid():
            if self.kept is not None:
                self.kept.close()
            library.context_destroy(self.handle)

    def _hear(self, report: Any, _payload: Any) -> int:
        """Python runs signal handlers here; what they or progress raise is kept for `check`, and ends the call."""
        try:
            if self.progress is not None:
                said = report.contents
                self.progress(said.phase.decode(), said.done, said.total, (said.detail or b"").decode())
        except BaseException as error:  # an exception must not leave a callback of C
            self.raised = error
        return self.raised is not None

    def _hear_warning(self, sentence: bytes, _payload: Any) -> None:
        self.warned.append(sentence.decode())

    def check(self, status: int) -> None:
        """Raises what a callback has raised, else the error of a status; warns of what was said meanwhile."""
        said, self.warned = self.warned, []
        raised, self.raised = self.raised, None
        if raised is not None:
            raise raised
        if status != 0:
            raise _errors.of_status(status, library.context_message(self.handle).decode())
        for sentence in said:
            warnings.warn(sentence, _errors.PointspecWarning, stacklevel=4)


_own = threading.local()


def get(device: str | None = None) -> Context:
    """The context of this thread for a device; None is that of POINTSPEC_DEVICE, else the first GPU, else CPU."""
    contexts: dict[str | None, Context] = _own.__dict__.setdefault("contexts", {})
    context = contexts.get(device)
    if context is None:
        context = contexts[device] = Context(device)
    elif context.process != os.getpid():
        raise RuntimeError(
            "pointspec was used before this process was forked, and OpenCL does not live through a fork: "
            'start processes with multiprocessing.get_context("spawn")'
        )
    return context


@contextlib.contextmanager
def listening(context: Context, progress: "ProgressCallback | bool | None") -> Iterator[None]:
    """During a call of the library: progress is a function of (phase, done, total, detail), or True for tqdm's bar;
    Ctrl-C ends the call within a second."""
    bar = _Bar() if progress is True else None
    context.progress = bar or (None if isinstance(progress, bool) else progress)
    former = _signal.getsignal(SIGINT) if threading.current_thread() is threading.main_thread() else None

    def keep(number: int, frame: Any) -> None:
        """Python would raise anywhere in a callback of C; what the former handler raises ends the call instead."""
        try:
            former(number, frame)
        except BaseException as error:
            context.raised = error

    if callable(former):
        _signal.signal(SIGINT, keep)
    try:
        yield
    finally:
        if callable(former):
            _signal.signal(SIGINT, former)
        context.progress = None
        if bar is not None:
            bar.close()
    if context.raised is not None:  # it came when the work was done
        context.check(0)


class _Bar:
    """A bar of tqdm's for each phase, which must be installed."""

    def __init__(self) -> None:
        from tqdm.auto import tqdm

        self._make: Any = tqdm
        self._phase, self._bar = "", None  # type: str, Any

    def __call__(self, phase: str, done: int, total: int, detail: str) -> None:
        if phase != self._phase or self._bar is None:
            self.close()
            self._phase, self._bar = phase, self._make(desc=phase, total=total or None, leave=False)
        self._bar.set_postfix_str(detail, refresh=False)
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()

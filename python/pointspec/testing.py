"""Gates for tests: has a sampler still the spectrum that it had?"""

from __future__ import annotations

from typing import Any

from . import _question
from ._answer import Answer


def assert_same_spectrum(patterns: Any, saved: Any, /, *, false_alarm_rate: float = 1e-3, **options: Any) -> Answer:
    """Asserts that points have the spectrum of a saved answer, statistically, as ``pointspec check`` does.

    patterns: points as for any question, or None with ``sampler=``. saved: an answer that was asked with state=True, or
    the NPZ file of one. The AssertionError has the verdict; the answer, with a row for every ring, is returned.

    >>> import numpy, pointspec
    >>> random = numpy.random.default_rng(1)
    >>> saved = pointspec.power(random.random((64, 100, 2)), max_frequency=8, state=True)
    >>> assert_same_spectrum(random.random((40, 100, 2)), saved).header["verdict"]
    'same'
    >>> assert_same_spectrum(random.random((40, 100, 2)) ** 2, saved)
    Traceback (most recent call last):
    AssertionError: ...
    """
    options = {"against": saved, "false_alarm_rate": false_alarm_rate, **options}
    answer = _question.ask("check", patterns, options)
    assert answer.verdict == "", answer.verdict
    return answer

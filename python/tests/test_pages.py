"""The programs of docs/user/python.md run as they stand, one after the other."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

import pointspec
import pointspec.testing

PAGE = Path(__file__).parents[2] / "docs" / "user" / "python.md"


def test_programs_of_the_page(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    programs = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE)
    assert len(programs) == 2
    for program in programs:
        exec(program, names)
    assert Path("own.png").stat().st_size > 10000
    shown = capsys.readouterr().out
    assert "normalized_frequency" in shown and "own has the least variance" in shown or "jittered has the least" in shown


def test_docstrings() -> None:
    for module in (pointspec, pointspec.testing):
        assert doctest.testmod(module, optionflags=doctest.ELLIPSIS).failed == 0

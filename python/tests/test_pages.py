"""The programs of docs/user/python.md and the notebooks run as they stand, one after the other."""

from __future__ import annotations

import doctest
import json
import re
from pathlib import Path

import pytest

import pointspec
import pointspec.testing

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "user" / "python.md"
NOTEBOOKS = sorted((DOCS / "notebooks").glob("*.ipynb"))


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


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks(
    notebook: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Cells are run, and what they print is what the notebook shows, but for digits."""
    pytest.importorskip("matplotlib").use("Agg")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    cells = [cell for cell in json.loads(notebook.read_text())["cells"] if cell["cell_type"] == "code"]
    for cell in cells:
        program = "".join(line for line in cell["source"] if not line.startswith("%"))
        exec(program, names)
        shown = "".join(text for out in cell["outputs"] if out["output_type"] == "stream" for text in out["text"])
        assert re.sub(r"[\d.e+-]+", "", capsys.readouterr().out) == re.sub(r"[\d.e+-]+", "", shown)


def test_docstrings() -> None:
    for module in (pointspec, pointspec.testing):
        assert doctest.testmod(module, optionflags=doctest.ELLIPSIS).failed == 0

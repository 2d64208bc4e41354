"""Pictures by Matplotlib: the library says which fields they are made of, and what their axes are."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _answer

if TYPE_CHECKING:
    import matplotlib.axes

Line = dict[str, Any]

# Below this share of the largest number a logarithmic axis would show rounding (host/plots/plot.h).
_ROUNDING = 1e-16


def _pictures(kind: str) -> list[list[Line]]:
    """The pictures of a kind, each a list of its lines."""
    lines = _answer.rows(kind, "pictures")
    return [[line for line in lines if line["picture"] == number] for number in dict.fromkeys(x["picture"] for x in lines)]


def _kind(answer: _answer.Answer) -> str:
    words = str(answer.header["command"]).split()
    return words[1]


def _has(answer: _answer.Answer, line: Line) -> bool:
    """Are the fields there, and of header entries several?"""
    is_column = line["y"] in answer.columns and line["x"] in answer.columns
    entries = answer.header
    is_entry = all(isinstance(entries.get(line[axis]), list) for axis in "xy")
    return is_entry if line["entries"] == "yes" else is_column


def _choose(answer: _answer.Answer) -> list[Line]:
    """The lines of the last picture whose fields the answer has, as the program draws it."""
    fit = [[line for line in lines if _has(answer, line)] for lines in _pictures(_kind(answer))]
    fit = [lines for lines in fit if lines]
    if not fit:
        raise ValueError("the answer has no picture of lines; its arrays may be images")
    return fit[-1]


class _Curves:
    """Rows of an answer by what tells curves apart: texts and numbers of columns before x."""

    def __init__(self, answer: _answer.Answer, line: Line, label: str) -> None:
        self.answer, self.line, self.label = answer, line, label
        if line["entries"] == "yes":
            self.columns = {name: np.array(value) for name, value in answer.header.items() if isinstance(value, list)}
            leads = [name for name in ("sampler",) if name in self.columns]
        else:
            self.columns = {name: answer[name] for name in answer.columns}
            before = answer.columns[: answer.columns.index(line["x"])]
            leads = [name for name in before if name in ("sampler", "points", "integrand", "brdf", "harmonics", "smoothness", "weights")]
        self.leads = [name for name in leads if name != line["panels"]]

    def panels(self) -> list[Any]:
        panels = self.line["panels"]
        return list(dict.fromkeys(self.columns[panels])) if panels in self.columns else [None]

    def of_panel(self, panel: Any) -> list[tuple[str, np.ndarray[Any, Any]]]:
        """Labels of curves and their rows."""
        size = len(self.columns[self.line["x"]])
        keys = list(zip(*(self.columns[name] for name in self.leads))) if self.leads else [()] * size
        inside = [panel is None or self.columns[self.line["panels"]][i] == panel for i in range(size)]
        several = [len({key[i] for key in keys}) > 1 for i in range(len(self.leads))]
        curves: dict[Any, list[int]] = {}
        for i, key in enumerate(keys):
            if inside[i]:
                curves.setdefault(key, []).append(i)
        return [(self._name(key, several), np.array(rows)) for key, rows in curves.items()]

    def _name(self, key: Sequence[Any], several: list[bool]) -> str:
        words = [str(value) for i, value in enumerate(key) if several[i] or self.leads[i] == "sampler"]
        return ", ".join([word for word in [self.label, *words] if word])


def _draw_line(axes: Any, curves: _Curves, line: Line, rows: Any, label: str, color: Any) -> Any:
    """One line of one curve; the colour that it got."""
    columns = curves.columns
    x, y = (np.asarray(columns[line[axis]], dtype=float)[rows] for axis in "xy")
    if line["log_y"] == "yes":
        y = np.where(y > _ROUNDING * np.nanmax(y), y, np.nan)
    name = label if not line["name"] else ", ".join(word for word in (label, line["name"]) if word)
    look = {"marks": "o", "bound": ":", "reference": "--", "curve": "-"}.get(line["look"], ".-")
    own = "0.6" if line["look"] == "reference" else color
    drawn = axes.plot(x, y, look, color=own, label=None if line["look"] == "marks" else name, markersize=4)[0]
    if line["error"] in columns:
        error = np.asarray(columns[line["error"]], dtype=float)[rows]
        axes.errorbar(x, y, error, fmt="none", color=drawn.get_color(), capsize=2)
    if line["low"] in columns:
        low, high = (np.asarray(columns[line[end]], dtype=float)[rows] for end in ("low", "high"))
        axes.fill_between(x, low, high, color=drawn.get_color(), alpha=0.2, linewidth=0)
    return drawn.get_color()


def _draw(axes: Any, curves: _Curves, lines: list[Line], panel: Any) -> None:
    for number, (label, rows) in enumerate(curves.of_panel(panel)):
        color = None
        for line in lines:
            values = np.asarray(curves.columns[line["y"]], dtype=float)[rows]
            if line["look"] == "reference":  # the same for all curves
                label = ""
            if not np.all(np.isnan(values)) and (number == 0 or line["look"] != "reference"):
                found = _draw_line(axes, curves, line, rows, label, color)
                color = color or found


def plot(
    *answers: _answer.Answer, labels: Sequence[str] | None = None, ax: "matplotlib.axes.Axes | None" = None
) -> "matplotlib.axes.Axes | np.ndarray[Any, Any]":
    """Draws answers of one kind in one picture, with error bars and bands where there are any.

    labels: what the curves of each answer are called, beside samplers. ax: axes to draw into; else there is a new
    figure, with a panel for each integrand. Returns the axes.
    """
    import matplotlib.pyplot

    if not answers:
        raise ValueError("there is no answer to draw")
    lines = _choose(answers[0])
    names = list(labels) if labels is not None else ["" if len(answers) == 1 else str(i + 1) for i in range(len(answers))]
    curves = [_Curves(answer, lines[0], name) for answer, name in zip(answers, names)]
    panels = list(dict.fromkeys(panel for one in curves for panel in one.panels()))
    if ax is None:
        _, all_axes = matplotlib.pyplot.subplots(1, len(panels), squeeze=False, figsize=(5 * len(panels) + 1, 4))
    else:
        all_axes = np.array([[ax] * len(panels)])
    for axes, panel in zip(all_axes[0], panels):
        for one in curves:
            _draw(axes, one, [line for line in lines if _has(one.answer, line)], panel)
        numbers = _kind(answers[0]) if lines[0]["panels"] else lines[0]["y"].replace("_", " ")
        axes.set(
            xlabel=lines[0]["x"].replace("_", " "), ylabel=numbers if panel is None else f"{numbers}, {panel}"
        )
        axes.set_xscale("log" if lines[0]["log_x"] == "yes" else "linear")
        axes.set_yscale("log" if lines[0]["log_y"] == "yes" else "linear")
        if axes.get_legend_handles_labels()[1]:
            axes.legend(fontsize="small")
    return ax if ax is not None else all_axes[0][0] if len(panels) == 1 else all_axes[0]

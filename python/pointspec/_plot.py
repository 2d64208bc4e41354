"""Pictures by Matplotlib: the library says which fields they are made of, and what their axes are."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _answer, _images

if TYPE_CHECKING:
    import matplotlib.axes

Line = dict[str, Any]

# Below this share of the largest number a logarithmic axis would show rounding (host/plots/plot.h).
_ROUNDING = 1e-16
# Panels of a row: as many are read side by side.
_MOST_COLUMNS = 4


def _pictures(kind: str) -> list[list[Line]]:
    """The pictures of a kind, each a list of its lines."""
    lines = _answer.rows(kind, "pictures")
    return [[line for line in lines if line["picture"] == number] for number in dict.fromkeys(x["picture"] for x in lines)]


def _kind(answer: _answer.Answer) -> str:
    words = str(answer.header["command"]).split()
    return words[1]


def _has(answer: _answer.Answer, line: Line) -> bool:
    """Are the fields there, and of header entries several? What has no x is an array."""
    if not line["x"]:
        return line["y"] in answer.arrays
    is_column = line["y"] in answer.columns and line["x"] in answer.columns
    entries = answer.header
    is_entry = all(isinstance(entries.get(line[axis]), list) for axis in "xy")
    return is_entry if line["entries"] == "yes" else is_column


def _choose(answer: _answer.Answer) -> tuple[list[Line], list[Line]]:
    """The arrays that pictures of the answer show, and the lines of the last picture whose fields it has, where they are
    more than places."""
    fit = [[line for line in lines if _has(answer, line)] for lines in _pictures(_kind(answer))]
    arrays = {line["y"]: line for lines in fit for line in lines if not line["x"]}
    lines = [found for lines in fit if (found := [line for line in lines if line["x"]])]
    if arrays:
        lines = [found for found in lines if len(set(_numbers(answer, found[0]["x"]))) > 1]
    if not arrays and not lines:
        raise ValueError("the answer has no picture: images are among its arrays with state=True, as NPZ files have them")
    return list(arrays.values()), lines[-1] if lines else []


def _numbers(answer: _answer.Answer, name: str) -> list[Any]:
    return list(answer[name]) if name in answer.columns else list(answer.header[name])


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
    error = np.asarray(columns.get(line["error"], np.nan), dtype=float)
    if not np.all(np.isnan(error)):  # missing of one realization
        error = error[rows]
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


def _draw_panel(axes: Any, curves: list[_Curves], lines: list[Line], panel: Any) -> None:
    for one in curves:
        _draw(axes, one, [line for line in lines if _has(one.answer, line)], panel)
    numbers = _kind(curves[0].answer) if lines[0]["panels"] else lines[0]["y"].replace("_", " ")
    axes.set(xlabel=lines[0]["x"].replace("_", " "), ylabel=numbers if panel is None else f"{numbers}, {panel}")
    axes.set_xscale("log" if lines[0]["log_x"] == "yes" else "linear")
    axes.set_yscale("log" if lines[0]["log_y"] == "yes" else "linear")
    if axes.get_legend_handles_labels()[1]:
        axes.legend(fontsize="small")


def _make_axes(num: int) -> "np.ndarray[Any, Any]":
    """Axes of a new figure; what is no panel of the last row is empty."""
    import matplotlib.pyplot

    columns = min(num, _MOST_COLUMNS)
    rows = -(-num // columns)
    size = (5 * columns + 1, 4 * rows)
    _, axes = matplotlib.pyplot.subplots(rows, columns, squeeze=False, figsize=size, layout="constrained")
    for empty in axes.ravel()[num:]:
        empty.set_axis_off()
    return np.asarray(axes.ravel()[:num])


def plot(
    *answers: _answer.Answer, labels: Sequence[str] | None = None, ax: "matplotlib.axes.Axes | None" = None
) -> "matplotlib.axes.Axes | np.ndarray[Any, Any]":
    """Draws answers of one kind in one picture, with error bars and bands where there are any.

    labels: what the curves of each answer are called, beside samplers. ax: axes to draw into; else there is a new
    figure, with a panel for each image and, of lines, for each integrand. Returns the axes, an array of several.
    """
    if not answers:
        raise ValueError("there is no answer to draw")
    arrays, lines = _choose(answers[0])
    names = list(labels) if labels is not None else ["" if len(answers) == 1 else str(i + 1) for i in range(len(answers))]
    images = [image for answer, name in zip(answers, names) for image in _images.panels(answer, name, arrays)]
    curves = [_Curves(answer, lines[0], name) for answer, name in zip(answers, names)] if lines else []
    panels = list(dict.fromkeys(panel for one in curves for panel in one.panels()))
    if ax is None:
        all_axes = _make_axes(len(images) + len(panels))
    elif panels or len(images) == 1:
        images = [] if panels else images
        all_axes = np.array([ax] * max(1, len(panels)))
    else:
        raise ValueError(f"ax: one panel does not hold {len(images)} images")
    for axes, image in zip(all_axes, images):
        image.draw(axes)
    for axes, panel in zip(all_axes[len(images) :], panels):
        _draw_panel(axes, curves, lines, panel)
    return ax if ax is not None else all_axes[0] if len(all_axes) == 1 else all_axes

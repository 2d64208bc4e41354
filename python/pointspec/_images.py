"""Arrays as panels of a picture: points, frequencies about 0, images of light."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _answer

Array = np.ndarray[Any, Any]

# Scales of the program's pictures (host/plots/plot_image.c, host/answers/*/*_figure.c), so that both look alike: one in a
# thousand frequencies may be brighter than white, which is no darker than twice white noise; light is white at six times
# its mean, as brightness is seen; and errors have the colours of three times their root mean square.
_BRIGHTEST, _FAINTEST_WHITE = 0.999, 2.0
_MOST_MEANS, _GAMMA = 6.0, 2.2
_MOST_ERRORS = 3.0


def _titles(answer: _answer.Answer, name: str, num: int) -> list[str]:
    """What tells images apart: rows of the table of the largest number of points, or functions of the sphere."""
    rows = range(len(answer))
    if "points" in answer.columns:
        rows = np.flatnonzero(answer["points"] == answer["points"].max()).tolist()
    words = [key for key in ("sampler", "points", "integrand", "smoothness") if key in answer.columns]
    integrands = [str(one) for one in np.atleast_1d(answer.header.get("integrand", []))]
    if len(rows) == num and name != "light":
        return [", ".join([name, *(f"{key} {answer[key][row]}" for key in words)]) for row in rows]
    return integrands if len(integrands) == num else [name] * num


def _points(axes: Any, points: Array, _scale: Any) -> None:
    others = points[:, 1] if points.shape[1] > 1 else np.zeros(len(points))
    axes.scatter(points[:, 0], others, s=min(9.0, 4e3 / len(points)), color="k", linewidths=0)
    axes.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xticks=[0, 1], yticks=[0, 1])


def _plane(axes: Any, power: Array, _scale: Any) -> None:
    shown = power.copy()
    middle = power.shape[0] // 2
    shown[middle, middle] = np.nan  # of the power at 0, which is N, the rest would be dark
    white = max(_FAINTEST_WHITE, float(np.nanquantile(shown, _BRIGHTEST)))
    reach = middle + 0.5
    axes.imshow(shown.T, "gray", origin="lower", extent=(-reach, reach, -reach, reach), vmin=0, vmax=white)


def _pixels(axes: Any, image: Array, _scale: Any) -> None:
    reach = _MOST_ERRORS * float(np.sqrt(np.mean(image**2))) or 1.0
    is_signed = bool(np.min(image) < 0)
    axes.imshow(image, "RdBu_r" if is_signed else "gray", vmin=-reach if is_signed else 0, vmax=reach if is_signed else 1)
    axes.set_axis_off()


def _light(axes: Any, image: Array, scale: Array) -> None:
    import matplotlib.colors

    least = min(0.0, float(scale.min()))
    most = min(float(scale.max()), _MOST_MEANS * float(np.mean(np.abs(scale))))
    axes.imshow(image, "gray", norm=matplotlib.colors.PowerNorm(1 / _GAMMA, least, max(most, least + 1e-300), clip=True))
    axes.set_axis_off()


_LOOKS = {"points": _points, "plane": _plane, "pixels": _pixels, "light": _light}


class Panel:
    """One image, that can be drawn into axes."""

    def __init__(self, title: str, look: str, values: Array, scale: Array) -> None:
        self.title, self.look, self.values, self.scale = title, look, values, scale

    def draw(self, axes: Any) -> None:
        _LOOKS[self.look](axes, self.values, self.scale)
        axes.set_title(self.title, fontsize="small")


def panels(answer: _answer.Answer, label: str, arrays: list[dict[str, Any]]) -> list[Panel]:
    """The images of the arrays of a picture; frequencies in three dimensions are none."""
    found = []
    scales = None
    for array in arrays:
        name, look = array["y"], array["look"]
        values = answer[name]
        if look == "plane" and values.ndim != 2:
            continue
        images = values if values.ndim == 3 else values[np.newaxis]
        scales = images if scales is None else scales
        words = "averaged periodogram" if look == "plane" else name.replace("_", " ")
        for i, title in enumerate(_titles(answer, words, len(images))):
            words = ", ".join(word for word in (label, title) if word)
            found.append(Panel(words, look, images[i], scales[i % len(scales)]))
    return found

"""Every engine against one thing that is varied, with the bound."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.lab.bench.axes import plain_numbers
from tagmetry.lab.beside.limit_summary import Limits, Looks
from tagmetry.lab.engines import OURS
from tagmetry.lab.engines.palette import COLOURS
from tagmetry.lab.rigs.limit_sweeps import SWEEPS
from tagmetry.record.report import ReportFigure
from tagmetry.record.report.plot import blank

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_RIGHT_DISTANCE2 = 8.0
_WIDE = 100.0  # times; so many numbers leave no room for more
_COUNTED = "found where there is none"
_PANELS: dict[str, Callable[[Looks], float]] = {
    "corners' error, px": lambda one: one.corner_px,
    "markers found, %": lambda one: 100 * one.recall,
    _COUNTED: lambda one: one.false_positives,
    "error of the place, % of the distance": lambda one: one.position_percent,
    "flipped poses, %": lambda one: 100 * one.flipped,
    "squared distance, 8 is right": lambda one: one.distance2,
}
_LOGARITHMIC = ("corners' error, px", "error of the place, % of the distance")


def limit_figure(run: Limits, variable: str) -> ReportFigure:
    """Return six curves of every engine over one thing that is varied."""

    def draw() -> "Figure":
        figure, _ = blank(12.0, 7.0)
        figure.clear()
        grid = figure.subplots(2, 3)
        for axes, name in zip(grid.flat, _PANELS, strict=True):
            for engine in run.engines:
                _curve(axes, run, variable, engine, _PANELS[name])
            _dress(axes, variable, name)
        _bound(grid.flat[0], run, variable)
        grid.flat[5].axhline(_RIGHT_DISTANCE2, color="k", ls="--", lw=1)
        names, labels = grid.flat[0].get_legend_handles_labels()
        figure.legend(names, labels, loc="outside lower center", ncols=5, fontsize=9)
        return figure

    told = "Dashed: the Cramér-Rao bound, and the squared distance of a right covariance."
    label = SWEEPS[variable].label
    return ReportFigure(f"detector_{variable}", f"Every detector by {label}", told, draw)


def _curve(
    axes: "Axes", run: Limits, variable: str, engine: str, value: Callable[[Looks], float]
) -> None:
    """Draw one engine; ours stands out."""
    looks = run.looks(variable, engine)
    y = np.array([value(one) for one in looks.values()], dtype=np.float64)
    width = 2.4 if engine == OURS else 1.1
    if np.isfinite(y).any():
        axes.plot(
            list(looks), y, "o-", ms=3, lw=width, color=COLOURS.get(engine, "0.5"), label=engine
        )


def _bound(axes: "Axes", run: Limits, variable: str) -> None:
    looks = run.looks(variable, run.engines[0])
    least_px = [one.bound_px for one in looks.values()]
    axes.plot(list(looks), least_px, "k--", lw=1.4, label="Cramér-Rao bound")


def _dress(axes: "Axes", variable: str, name: str) -> None:
    axes.set_title(name, fontsize=10)
    axes.set_xlabel(SWEEPS[variable].label)
    if (sweep := SWEEPS[variable]).logarithmic:
        axes.set_xscale("log")
        is_wide = max(sweep.values) > _WIDE * min(sweep.values)
        plain_numbers(axes.xaxis, (1.0,) if is_wide else (1.0, 2.0, 5.0))
    if name == _COUNTED:
        axes.set_ylim(bottom=-0.5, top=max(2.0, axes.get_ylim()[1]))
    if name in _LOGARITHMIC and axes.lines:
        axes.set_yscale("log")

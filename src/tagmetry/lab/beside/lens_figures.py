"""Curves of seed 000: errors and times over depth or turn, ours and its steps, with its bound."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.beside.lens_readings import LensReadings, rms
from tagmetry.record.report import ReportFigure
from tagmetry.record.report.plot import BLUE, GOLD, LIGHT, RED, blank

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLORS = (BLUE, RED, GOLD, LIGHT, "#666666")
_AXES = {"depth_m": "depth, m", "turn_deg": "turn of the marker, degrees"}
_NAMES = {"tagmetry": "ours", "paper": "its steps on the twin"}

Quantity = Callable[[LensReadings], Array]


def depth_error(readings: LensReadings) -> Array:
    """Return error rates of the depth."""
    return readings.errors_percent


def turn_error(readings: LensReadings) -> Array:
    """Return errors of the turn."""
    return readings.errors_deg


def duration(readings: LensReadings) -> Array:
    """Return simulated times."""
    return readings.column("simulated_s")


def lens_figure(
    number: str,
    title: str,
    groups: Mapping[str, LensReadings],
    against: str,
    quantity: Quantity,
    axis: str,
    *,
    limit: float,
    bounded: bool = False,
) -> ReportFigure:
    """Return curves of means with the range of the repeats, ours beside its steps.

    Args:
        number: Of the paper's figure.
        title: What it shows.
        groups: Readings by what a curve is called.
        against: The field along the horizontal axis.
        quantity: What is drawn.
        axis: Its name and unit.
        limit: What the paper says that it stays within, drawn dotted.
        bounded: Draw the Cramer-Rao bound, too.
    """

    def draw() -> "Figure":
        figure, _ = blank(8.8, 3.9)
        figure.clear()
        grid = figure.subplots(1, 2, sharex=True)
        for axes, method in zip(grid, ("tagmetry", "paper"), strict=True):
            for color, (name, readings) in zip(_COLORS, groups.items(), strict=False):
                _curve(axes, readings.where(method=method), against, quantity, (name, color))
                if bounded and method == "tagmetry":
                    _bound(axes, readings.where(method=method), against, color)
            for level in (limit,) if quantity is duration else (limit, -limit):
                axes.axhline(level, ls=":", color="black", lw=1.2)
            if quantity is duration:
                axes.set_ylim(bottom=0)
            axes.set_title(_NAMES[method], fontsize=10)
            axes.set_xlabel(_AXES[against])
        grid[0].set_ylabel(axis)
        grid[0].legend(fontsize=8)
        return figure

    told = f"Mean of five and their range. Dotted: {limit:g}, what the paper says."
    told += " Dashed: 1.96 times one image's Cramer-Rao bound." if bounded else ""
    return ReportFigure(f"seed000_figure{number}", f"Figure {number}: {title}", told, draw)


def trace_figure(readings: LensReadings) -> ReportFigure:
    """Return the depths of each iteration, image by image (figure 13)."""

    def draw() -> "Figure":
        figure, _ = blank(8.8, 6.4)
        figure.clear()
        depths = list(reversed(readings.by("depth_m").items()))
        grid = figure.subplots(len(depths), 2, sharex="col", squeeze=False)
        for row, (depth_m, part) in zip(grid, depths, strict=True):
            for axes, method in zip(row, ("tagmetry", "paper"), strict=True):
                for color, run in zip(
                    _COLORS, part.where(method=method).by("repeat").values(), strict=False
                ):
                    axes.plot(
                        run.column("image") + 1, run.column("measured_m"), "o-", ms=3, color=color
                    )
                axes.axhline(depth_m, ls=":", color="black", lw=1.2)
                axes.set_title(f"{_NAMES[method]}, {depth_m:g} m", fontsize=9)
        figure.supxlabel("settled image since the marker was found", fontsize=10)
        figure.supylabel("depth, m", fontsize=10)
        return figure

    return ReportFigure(
        "seed000_figure13",
        "Figure 13: convergence of the depth",
        "Five runs each; dotted: the truth. Readings are too far where the marker is blurred.",
        draw,
    )


def _curve(
    axes: "Axes",
    readings: LensReadings,
    against: str,
    quantity: Quantity,
    look: tuple[str, str],
) -> None:
    parts = {x: quantity(part) for x, part in readings.by(against).items()}
    known = {x: y[np.isfinite(y)] for x, y in parts.items() if np.isfinite(y).any()}
    if not known:
        return
    x, (name, color) = np.array(list(known)), look
    axes.plot(x, [y.mean() for y in known.values()], "o-", ms=3, lw=1.3, color=color, label=name)
    low, high = ([end(y) for y in known.values()] for end in (np.min, np.max))
    axes.fill_between(x, low, high, color=color, alpha=0.2, lw=0)


def _bound(axes: "Axes", readings: LensReadings, against: str, color: str) -> None:
    parts = readings.by(against)
    bound = np.array([1.96 * rms(part.column("bound_deg")) for part in parts.values()])
    for sign in (1, -1):
        axes.plot(np.array(list(parts)), sign * bound, "--", lw=1, color=color)

"""Errors of localization as curves with confidence bands, and as surfaces."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.lab.beside.sample import Sample
from tagmetry.lab.published.seed002 import Statement
from tagmetry.record.report import ReportFigure
from tagmetry.record.report.plot import BLUE, GOLD, RED, blank, log_colors

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLORS = (BLUE, RED, GOLD)
_AXES = {
    "distance_m": "distance, m",
    "yaw_deg": "yaw, degrees",
    "pitch_deg": "pitch, degrees",
    "roll_deg": "roll, degrees",
}
_ERRORS = {
    "radial_m": ("radial error, mm", 1000.0),
    "angle_deg": ("angular error, degrees", 1.0),
    "xy_m": ("error in XY, mm", 1000.0),
    "abs_z_m": ("error in Z, mm", 1000.0),
    "place_m": ("error of the place, mm", 1000.0),
    "heading_deg": ("error of the heading, degrees", 1.0),
}


@dataclass(frozen=True, eq=False)
class Curve:
    """One curve.

    Attributes:
        name: For the legend.
        rows: What is averaged.
        color: Which colour it has; ours and the paper's of one setting have the same.
        dashed: Whether it is dashed, as the paper's are.
        stated: What the paper says of it, drawn as dotted lines.
    """

    name: str
    rows: Sample
    color: int = 0
    dashed: bool = False
    stated: tuple[Statement, ...] = ()


@dataclass(frozen=True)
class Plot:
    """One pair of axes: an error against a setting."""

    error: str
    against: str


def curve_figure(
    number: int,
    title: str,
    curves: Sequence[Curve],
    plots: Sequence[Plot],
    seed: str = "seed002",
) -> ReportFigure:
    """Return curves of the mean error with its 95 % confidence band, side by side."""

    def draw() -> "Figure":
        figure, _ = blank(4.4 * min(len(plots), 2), 3.6 * (1 + (len(plots) > 2)))
        figure.clear()
        grid = figure.subplots(1 + (len(plots) > 2), min(len(plots), 2), squeeze=False)
        for axes, plot in zip(grid.flat, plots, strict=True):
            for curve in curves:
                _draw_curve(axes, curve, plot)
            axes.set_yscale("log")
            axes.set_xlabel(_AXES[plot.against])
            axes.set_ylabel(_ERRORS[plot.error][0])
        names, labels = grid.flat[0].get_legend_handles_labels()
        figure.legend(names, labels, loc="outside upper center", ncols=2, fontsize=8)
        return figure

    stated = any(curve.stated for curve in curves)
    told = "Mean and its 95 % confidence band." + (" Dotted: what the paper says." * stated)
    return ReportFigure(f"{seed}_figure{number}", f"Figure {number}: {title}", told, draw)


def _draw_curve(axes: "Axes", curve: Curve, plot: Plot) -> None:
    scale, color = _ERRORS[plot.error][1], _COLORS[curve.color]
    groups = curve.rows.by(plot.against)
    means = [one.mean(plot.error) for one in groups.values()]
    x, y = np.array(list(groups)), scale * np.array([one.mean for one in means])
    half = scale * np.array([one.half for one in means])
    line = "o--" if curve.dashed else "o-"
    axes.plot(x, y, line, color=color, ms=3, lw=1.3, label=curve.name)
    axes.fill_between(x, np.maximum(y - half, 0.2 * y), y + half, color=color, alpha=0.2, lw=0)
    for one in curve.stated:
        if one.quantity == plot.error and plot.against == "distance_m":
            ends = [one.from_m, max(one.to_m, one.from_m + 0.2)]
            axes.plot(ends, [scale * one.at_most] * 2, ":", color=color, lw=2.2)


def surface_figure(number: int, title: str, rows: Sample, against: str) -> ReportFigure:
    """Return mean errors over distance and a second setting, ours above the paper's steps."""

    def draw() -> "Figure":
        figure, _ = blank(8.8, 5.6)
        figure.clear()
        grid = figure.subplots(2, 2, sharex=True, sharey=True)
        for column, error in enumerate(("radial_m", "angle_deg")):
            both = [_surface(one, against, error) for one in (rows.ours, rows.paper)]
            known = np.concatenate([z[np.isfinite(z)] for *_, z in both])
            norm = log_colors([float(known.min()), float(known.max())])
            for row, (x, y, z) in enumerate(both):
                axes = grid[row, column]
                mesh = axes.pcolormesh(x, y, z, norm=norm, cmap="cividis", shading="nearest")
                axes.grid(visible=False)
                axes.set_title(("ours", "the paper's steps")[row], fontsize=9)
            figure.colorbar(mesh, ax=list(grid[:, column]), label=_ERRORS[error][0])
        figure.supxlabel(_AXES[against], fontsize=10)
        figure.supylabel("distance, m", fontsize=10)
        return figure

    told = "Mean over repeated pictures; white: never localized. Colours on a logarithmic scale."
    return ReportFigure(f"seed002_figure{number}", f"Figure {number}: {title}", told, draw)


def _surface(
    rows: Sample, against: str, error: str
) -> "tuple[list[float], list[float], np.ndarray[tuple[int, int], np.dtype[np.float64]]]":
    """Return setting, distance, and the mean error over them."""
    by_distance = {distance_m: one.by(against) for distance_m, one in rows.by("distance_m").items()}
    settings = sorted({x for one in by_distance.values() for x in one})
    scale = _ERRORS[error][1]
    z = [[scale * one[x].mean(error).mean for x in settings] for one in by_distance.values()]
    return settings, list(by_distance), np.array(z)

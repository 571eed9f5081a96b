"""Two trajectories drawn: the ways from above, and the errors over time."""

from typing import TYPE_CHECKING

import numpy as np

from tagmetry.localize.trajectory import Comparison
from tagmetry.record.report.plot import BLUE, RED, blank, png

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_PLANES = ((0, 1), (0, 2), (1, 2))


def comparison_picture(found: Comparison) -> bytes:
    """Return a PNG: the ways in the plane in which they are widest, and the errors over time.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    figure, _ = blank(12.0, 5.0)
    figure.clear()
    grid = figure.add_gridspec(2, 2)
    _ways(figure.add_subplot(grid[:, 0]), found)
    shifts, turns = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])
    times_s = found.both.true.times_s - found.both.true.times_s[0]
    _over_time(shifts, times_s, 1000 * found.absolute_m, "position, mm")
    _over_time(turns, times_s, np.degrees(found.absolute_rad), "turn, degrees")
    shifts.set_title("absolute error")
    turns.set_xlabel("time, s")
    return png(figure)


def _ways(axes: "Axes", found: Comparison) -> None:
    true, own = found.both.true.positions_m, found.both.estimated.positions_m
    widths_m = np.ptp(true, axis=0)
    across, up = max(_PLANES, key=lambda plane: float(widths_m[list(plane)].sum()))
    for name, way, color, line in (("true", true, BLUE, "o-"), ("estimated", own, RED, ".-")):
        axes.plot(way[:, across], way[:, up], line, color=color, ms=4, lw=0.8, label=name)
    axes.set(xlabel=f"{'xyz'[across]}, m", ylabel=f"{'xyz'[up]}, m", title="the ways")
    axes.set_aspect("equal", adjustable="datalim")
    axes.legend()


def _over_time(axes: "Axes", times_s: np.ndarray, errors: np.ndarray, name: str) -> None:
    axes.plot(times_s, errors, ".-", color=RED, ms=4, lw=0.8)
    axes.set_ylabel(name)
    axes.set_ylim(0)

"""Robots' ways through an arena, drawn from above, and how far neighbours in a chain were apart."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.arena import WorldState
from tagmetry.errors import MissingExtraError
from tagmetry.geometry import Array
from tagmetry.record.report.plot import png

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MOST_NAMED = 30


def ways_picture(
    worlds: Sequence[WorldState], radii_m: Mapping[int, float], title: str = ""
) -> bytes:
    """Return a PNG: every robot's way, a dot each second, and where it is at the end.

    Args:
        worlds: In order of time.
        radii_m: Of the robots, by id.
        title: Over the drawing.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ModuleNotFoundError as error:
        raise MissingExtraError("a drawing of robots' ways", "report") from error
    figure = Figure(figsize=(10.0, 6.0), layout="constrained", facecolor="white")
    axes = figure.add_subplot()
    for number, (robot, way) in enumerate(sorted(_ways(worlds).items())):
        _draw(axes, robot, way, radii_m.get(robot, 0.08), f"C{number % 10}")
    axes.set(xlabel="x, m", ylabel="y, m", title=title)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.08)
    return png(figure)


def _ways(worlds: Sequence[WorldState]) -> dict[int, Array]:
    """Return time, x, y and heading of every robot, shape (n, 4)."""
    ways: dict[int, list[tuple[float, float, float, float]]] = {}
    for world in worlds:
        for one in world:
            ways.setdefault(one.id, []).append((world.time_s, one.x_m, one.y_m, one.heading_rad))
    return {robot: np.array(way) for robot, way in ways.items()}


def _draw(axes: "Axes", robot: int, way: Array, radius_m: float, color: str) -> None:
    from matplotlib.patches import Circle

    time_s, x_m, y_m, heading_rad = way.T
    seconds = np.flatnonzero(np.diff(np.floor(time_s), prepend=-1.0))
    axes.plot(x_m, y_m, color=color, linewidth=1)
    axes.plot(x_m[seconds], y_m[seconds], ".", color=color, markersize=4)
    axes.add_patch(Circle((x_m[-1], y_m[-1]), radius_m, fill=False, color=color, linewidth=1.5))
    ahead = radius_m * np.array([np.cos(heading_rad[-1]), np.sin(heading_rad[-1])])
    axes.plot([x_m[-1], x_m[-1] + ahead[0]], [y_m[-1], y_m[-1] + ahead[1]], color=color)
    if robot < _MOST_NAMED:
        axes.annotate(str(robot), (x_m[-1], y_m[-1]), ha="center", va="center", fontsize=8)

"""A marker map drawn from above and in three dimensions, with the camera's way through it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from tagmetry.errors import MissingExtraError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.localize import MarkerMap
from tagmetry.record.report.plot import BLUE, GOLD, RED, png

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LEAST_M = 0.3  # drawn around a small map
_DEVIATIONS = 2.0  # drawn of every marker's place
_MOST_NAMED = 60
_SIGHT_M, _MOST_SIGHTS = 0.15, 30
_BESIDE: Any = {"xytext": (4, 4), "textcoords": "offset points"}


def map_picture(marker_map: MarkerMap, Ts_world_camera: Sequence[RigidTransform] = ()) -> bytes:
    """Return a PNG of a map: from above on the left, in three dimensions on the right.

    Args:
        marker_map: Markers with a line out of their faces, and ellipses of two deviations of their
            places where those are uncertain.
        Ts_world_camera: Where a camera was, in order; lines show where it looks.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ModuleNotFoundError as error:
        raise MissingExtraError("a drawing of a marker map", "report") from error
    figure = Figure(figsize=(13.0, 6.0), layout="constrained", facecolor="white")
    way = _way(Ts_world_camera)
    _from_above(figure.add_subplot(1, 2, 1), marker_map, way)
    _in_space(figure, marker_map, way)
    return png(figure)


@dataclass(frozen=True, eq=False)
class _Way:
    """Where a camera was, and the ends of short lines in the directions that it looked, (n, 3)."""

    places_m: Array
    ends_m: Array

    @property
    def sights_m(self) -> Array:
        """The lines of at most so many places, spread over the way, shape (k, 2, 3)."""
        chosen = np.unique(np.linspace(0, len(self.places_m) - 1, _MOST_SIGHTS).round().astype(int))
        return np.stack([self.places_m, self.ends_m], axis=1)[chosen if len(self.places_m) else []]


def _way(Ts_world_camera: Sequence[RigidTransform]) -> _Way:
    places_m = np.array([T.translation for T in Ts_world_camera]).reshape(-1, 3)
    sights = np.array([T.rotation.as_matrix()[:, 2] for T in Ts_world_camera]).reshape(-1, 3)
    return _Way(places_m, places_m + _SIGHT_M * sights)


def _from_above(axes: "Axes", marker_map: MarkerMap, way: _Way) -> None:
    for marker in marker_map.markers:
        x, y = np.vstack([marker.p_world, marker.p_world[:1]])[:, :2].T
        axes.plot(x, y, color=BLUE, linewidth=2)
        center = marker.T_world_marker.translation
        tip = center + marker.size_m * marker.matrix[:3, 2]
        axes.plot([center[0], tip[0]], [center[1], tip[1]], color=BLUE, linewidth=0.8)
        if not marker.is_exact:
            axes.plot(*_ellipse_m(center[:2], marker.covariance[:2, :2]).T, color=GOLD)
        if len(marker_map.markers) <= _MOST_NAMED:
            axes.annotate(str(marker.id), (tip[0], tip[1]), fontsize=9, **_BESIDE)
    if len(way.places_m):
        axes.plot(*way.places_m[:, :2].T, ".-", color=RED, markersize=3, linewidth=0.8)
        axes.plot(*way.places_m[0, :2], "o", color=RED)
        axes.annotate(
            "camera", (way.places_m[0, 0], way.places_m[0, 1]), fontsize=9, color=RED, **_BESIDE
        )
    for sight in way.sights_m:
        axes.plot(*sight[:, :2].T, color=RED, linewidth=1.5)
    axes.set(xlabel="x, m", ylabel="y, m", title=f"{marker_map.name}, from above")
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.1)


def _in_space(figure: "Figure", marker_map: MarkerMap, way: _Way) -> None:
    axes: Any = figure.add_subplot(1, 2, 2, projection="3d")
    for marker in marker_map.markers:
        axes.plot(*np.vstack([marker.p_world, marker.p_world[:1]]).T, color=BLUE, linewidth=1.5)
        top_left = np.vstack([marker.p_world[0], marker.T_world_marker.translation])
        axes.plot(*top_left.T, color=GOLD, linewidth=1)
    if len(way.places_m):
        axes.plot(*way.places_m.T, color=RED, linewidth=1)
        axes.scatter(*way.places_m[:1].T, color=RED)
    for sight in way.sights_m:
        axes.plot(*sight.T, color=RED, linewidth=1.5)
    _same_scale(axes, np.vstack([*(one.p_world for one in marker_map.markers), way.places_m]))
    axes.set(xlabel="x, m", ylabel="y, m", title="a line to each marker's top left; z up, m")


def _same_scale(axes: Any, points_m: Array) -> None:  # noqa: ANN401 (its 3-D axes have no types)
    low, high = points_m.min(axis=0), points_m.max(axis=0)
    half = np.maximum((high - low) / 2, _LEAST_M)
    middle = (low + high) / 2
    axes.set(
        xlim=(middle[0] - half[0], middle[0] + half[0]),
        ylim=(middle[1] - half[1], middle[1] + half[1]),
        zlim=(middle[2] - half[2], middle[2] + half[2]),
    )
    axes.set_box_aspect(tuple(half))
    axes.locator_params(axis="z", nbins=4)


def _ellipse_m(center_m: Array, covariance_m2: Array) -> Array:
    """Return points of an ellipse of two standard deviations, shape (n, 2)."""
    angle = np.linspace(0, 2 * np.pi, 61)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    variances, axes = np.linalg.eigh(covariance_m2)
    root = axes * np.sqrt(np.maximum(variances, 0.0))
    return np.asarray(center_m + _DEVIATIONS * circle @ root.T)

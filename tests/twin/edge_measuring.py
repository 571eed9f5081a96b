"""Where edges stand in a picture, from the light alone.

Along a row that crosses an edge from one even tone to another, the sum of the light tells the
edge's place exactly, whatever the point spread: with n pixels from `first` on, tones a and b,

    place = first - 1/2 + (sum - n b) / (a - b).

A row sees the mean over its own height and over the spread across it, which of a bowed edge x(v) is
x + x'' (1/12 + s^2) / 2; that much is taken off again. Edges nearer to level than to upright are
measured in columns.

The nominal places only choose what is looked at. Nothing of tagmetry is used.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial

Array = np.ndarray
_REACH = 4.5  # standard deviations of a point spread that are waited for


@dataclass(frozen=True, eq=False)
class Edge:
    """A measured edge.

    Attributes:
        upright: Whether it was measured in rows.
        at_px: The rows (upright) or columns that were measured.
        places_px: Where it crosses them.
        curve: The place as a function of the row or column.
    """

    upright: bool
    at_px: Array
    places_px: Array
    curve: Polynomial


def clear_px(s_px: float) -> float:
    """Return how far from an edge a picture is even, under a spread of a standard deviation."""
    return _REACH * s_px + 1.5


def measured_edge(
    picture: Array, side_px: Array, others_px: Array, clear: float, degree: int, s_px: float
) -> Edge:
    """Return an edge as the picture shows it.

    Args:
        picture: Shape (height, width).
        side_px: Points along the nominal edge, in order, shape (n, 2).
        others_px: Points of all that must not come into a window, shape (m, 2).
        clear: How far from an edge the tones are even.
        degree: Of the polynomial that the edge is; 1 is straight.
        s_px: Standard deviation of the point spread.
    """
    along = np.abs(side_px[-1] - side_px[0])
    upright = bool(along[1] >= along[0])
    if not upright:
        picture, side_px, others_px = picture.T, side_px[:, ::-1], others_px[:, ::-1]
    half = clear * np.linalg.norm(along) / along.max()
    side_px = side_px[np.argsort(side_px[:, 1])]
    rows = np.arange(int(np.ceil(side_px[0, 1])), int(np.floor(side_px[-1, 1])) + 1)
    rough = np.interp(rows, side_px[:, 1], side_px[:, 0])
    crossed = zip(rough, rows, strict=True)
    kept = np.array([_is_clear(u, v, half, clear, others_px) for u, v in crossed], bool)
    at = rows[kept]
    if len(at) < degree + 2:
        raise ValueError(f"{len(at)} lines of pixels are too few for an edge of degree {degree}")
    places = np.array([_place(picture[v], u, half) for u, v in zip(rough[kept], at, strict=True)])
    curve = Polynomial.fit(at, places, degree)
    if degree > 1:
        curve = curve - curve.deriv(2) * ((1 / 12 + s_px**2) / 2)
    return Edge(upright, at, places, curve)


def crossing(one: Edge, other: Edge) -> Array:
    """Return where two edges meet, shape (2,)."""
    point = np.array([one.places_px.mean(), one.at_px.mean()])
    point = point if one.upright else point[::-1]
    for _ in range(20):
        (row_a, miss_a), (row_b, miss_b) = _constraint(one, point), _constraint(other, point)
        point = point - np.linalg.solve([row_a, row_b], [miss_a, miss_b])
    return point


def outline_corners(
    picture: Array,
    sides_px: list[Array],
    degree: int = 1,
    s_px: float = 0.0,
    extra_px: float = 0.0,
    beside_px: list[Array] | None = None,
) -> Array:
    """Return the corners of a closed outline, shape (n, 2).

    Args:
        picture: Shape (height, width).
        sides_px: Nominal points along each side, in order round it.
        degree: Of the polynomials that the sides are.
        s_px: Standard deviation of the point spread.
        extra_px: How far light is carried besides, by motion or defocus.
        beside_px: Points along what else there is, that must not come into a window.
    """
    edges = []
    for i, side in enumerate(sides_px):
        others = np.concatenate([*sides_px[:i], *sides_px[i + 1 :], *(beside_px or [])])
        edges.append(measured_edge(picture, side, others, clear_px(s_px) + extra_px, degree, s_px))
    return np.array([crossing(edges[i - 1], edges[i]) for i in range(len(edges))])


def darkness(picture: Array, middle_px: Array, half_px: int) -> tuple[float, Array]:
    """Return the area and the centroid of a dark spot on an even tone in a square window."""
    left, top = np.rint(middle_px).astype(int) - half_px
    window = picture[top : top + 2 * half_px + 1, left : left + 2 * half_px + 1].astype(float)
    tone, ink = window[0, 0], window[half_px, half_px]
    dark = (tone - window) / (tone - ink)
    v, u = np.mgrid[: len(window), : len(window)]
    area = float(dark.sum())
    return area, np.array([left + (dark * u).sum() / area, top + (dark * v).sum() / area])


def _is_clear(u: float, v: int, half: float, clear: float, others_px: Array) -> bool:
    """Say whether a window in a row stays clear of all other edges."""
    beyond = np.maximum(np.abs(others_px[:, 0] - u) - half, 0.0)
    return bool(np.all(np.hypot(beyond, others_px[:, 1] - v) > clear))


def _place(line: Array, rough: float, half: float) -> float:
    first, last = int(np.floor(rough - half)), int(np.ceil(rough + half))
    if first < 0 or last >= len(line):
        raise ValueError(f"an edge at {rough:.1f} px is too near to the border to be measured")
    window = line[first : last + 1].astype(np.float64)
    a, b = window[0], window[-1]
    return float(first - 0.5 + (window.sum() - len(window) * b) / (a - b))


def _constraint(edge: Edge, point: Array) -> tuple[list[float], float]:
    """Return the gradient of (place - curve(at)) over (u, v), and its value."""
    place, at = point if edge.upright else point[::-1]
    slope = float(edge.curve.deriv()(at))
    gradient = [1.0, -slope] if edge.upright else [-slope, 1.0]
    return gradient, float(place - edge.curve(at))

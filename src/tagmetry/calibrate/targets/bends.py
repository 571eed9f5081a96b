"""How do a board's straight lines bend in the picture? The corners themselves tell, no camera.

Three neighbouring corners of a line lie on a circle, whose curvature is

    k = 2 (b - a) x (c - b) / (|b - a| |c - b| |c - a|);

it varies smoothly over the board, so polynomials in the place on the board take the corners' own
errors out of it and carry it to the board's border, where a corner has a neighbour on one side
only. Perspective leaves lines straight; what bends them is the lens.

Reference: K. Menger, Untersuchungen ueber allgemeine Metrik, 1930 (the curvature of three points).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array

_DEGREE = 3
_SAMPLES_TO_A_TERM = 2


@dataclass(frozen=True, eq=False)
class Bends:
    """Curvatures of the line to the right and of that down, at n corners.

    Attributes:
        values: Positive where a line turns from the picture's x to its y, shape (n, 2), 1 / px.
        doubts: How far they may be off: what polynomials of one degree less would say otherwise,
            shape (n, 2), 1 / px. It is large where a curve is continued to the board's border
            behind a lens that bends there as nowhere else.
    """

    values: Array
    doubts: Array


def line_bends(places: Array, corners_px: Array) -> Bends:
    """Return the curvature of the board's lines at its corners.

    Args:
        places: x to the board's right and y to its top, shape (n, 2), in any unit.
        corners_px: Where the picture shows them, shape (n, 2).

    Returns:
        The curvatures; zero where no three corners lie on a line.
    """
    if len(places) < 3:
        return Bends(np.zeros((len(places), 2)), np.zeros((len(places), 2)))
    unit = _centred(places)
    turned = np.stack([-unit[:, 1], unit[:, 0]], axis=1)
    both = [(_sampled(along, corners_px), along) for along in (unit, turned)]
    values, simpler = (
        np.stack([_smooth(samples, along, degree) for samples, along in both], axis=1)
        for degree in (_DEGREE, _DEGREE - 1)
    )
    return Bends(values, np.abs(values - simpler))


@dataclass(frozen=True, eq=False)
class _Samples:
    """Curvatures (m,) at places (m, 2), with their weights (m,)."""

    places: Array
    bends: Array
    weights: Array


def _centred(places: Array) -> Array:
    """Return places about their middle, the farthest at distance 1."""
    low, high = places.min(axis=0), places.max(axis=0)
    return np.asarray((places - (low + high) / 2) / (np.max(high - low) / 2))


def _sampled(places: Array, corners_px: Array) -> _Samples:
    """Return the curvatures along x, one from every three neighbours on a line."""
    triples = list(_triples(places))
    if not triples:
        return _Samples(np.zeros((0, 2)), np.zeros(0), np.zeros(0))
    rows = np.array(triples)
    a, b, c = (corners_px[row] for row in rows.T)
    weights = np.linalg.norm(b - a, axis=1) * np.linalg.norm(c - b, axis=1)
    return _Samples(places[rows].mean(axis=1), curvature(a, b, c), weights)


def curvature(a: Array, b: Array, c: Array) -> Array:
    """Return that of the circles through three points (n, 2) each, shape (n,)."""
    before, after = b - a, c - b
    lengths = [np.linalg.norm(part, axis=1) for part in (before, after, c - a)]
    turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.asarray(2 * turn / np.prod(lengths, axis=0))


def _triples(places: Array) -> Iterator[tuple[int, int, int]]:
    """Give all neighbours of three on a line along x, as rows of `places`."""
    lines = np.rint(places[:, 1] * 1e6).astype(np.int64)
    for line in np.unique(lines):
        on_it = np.flatnonzero(lines == line)
        ordered = on_it[np.argsort(places[on_it, 0])].tolist()
        yield from zip(ordered, ordered[1:], ordered[2:], strict=False)


def _smooth(samples: _Samples, places: Array, degree: int) -> Array:
    """Return the curvature at places by the polynomial that fits the samples best."""
    powers = _powers(samples, degree)
    if not powers:
        return np.zeros(len(places))
    equations = _terms(samples.places, powers) * samples.weights[:, None]
    fitted = np.linalg.lstsq(equations, samples.bends * samples.weights, rcond=1e-9)[0]
    return np.asarray(_terms(places, powers) @ fitted)


def _powers(samples: _Samples, most: int) -> list[tuple[int, int]]:
    """Return the powers of x and y, at most of a degree, that so many samples can tell."""
    along, across = (len(np.unique(np.rint(column * 1e6))) for column in samples.places.T)
    for degree in range(most, -1, -1):
        powers = [
            (i, j)
            for i in range(min(degree + 1, along))
            for j in range(min(degree + 1 - i, across))
        ]
        if _SAMPLES_TO_A_TERM * len(powers) <= len(samples.bends):
            return powers
    return []


def _terms(places: Array, powers: list[tuple[int, int]]) -> Array:
    x, y = places.T
    return np.stack([x**i * y**j for i, j in powers], axis=1)

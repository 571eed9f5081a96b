"""Which markers have something beside them: pictures in borders, or squares at their corners."""

import numpy as np
from numba import njit

from tagmetry.detect.places import discs
from tagmetry.geometry.arrays import Array, BoolArray

_NEAR = 0.75, 1.6  # from centre to centre by the marker's side; closer is within it
_OF_A_SIZE = 0.2, 2.5  # a neighbour's side by the marker's
_TOUCHING_FROM = 0.6  # of a marker's side, from centre to centre
_TOUCHING = 0.15  # of a marker's side, from corner to corner


@njit(cache=True, nogil=True)
def unread(markers_px: Array, pictures_px: Array) -> int:
    """Return how many pictures (k, 4, 2) stand where no marker (m, 4, 2) does."""
    markers, pictures, count = discs(markers_px), discs(pictures_px), 0
    for picture in pictures:
        lone = True
        for marker in markers:
            lone &= _apart(marker, picture) > _NEAR[0]
        count += lone
    return count


@njit(cache=True, nogil=True)
def crowded(markers_px: Array, pictures_px: Array, squares_px: Array) -> BoolArray:
    """Say which markers have a picture of about their size beside them, or touch a square, (m,).

    Args:
        markers_px: Shape (m, 4, 2).
        pictures_px: Squares with something printed in a border, shape (k, 4, 2).
        squares_px: All squares, shape (n, 4, 2).
    """
    markers, pictures, squares = discs(markers_px), discs(pictures_px), discs(squares_px)
    crowded = np.zeros(len(markers), np.bool_)
    for i in range(len(markers)):
        for picture in pictures:
            crowded[i] |= _is_beside(markers[i], picture)
        for k in range(len(squares)):
            if not crowded[i] and _may_touch(markers[i], squares[k]):
                apart_px = _between_corners(markers_px[i], squares_px[k])
                crowded[i] = apart_px < _TOUCHING * markers[i, 2]
    return crowded


@njit(cache=True, nogil=True)
def _is_beside(marker: Array, picture: Array) -> bool:
    apart, ratio = _apart(marker, picture), picture[2] / marker[2]
    return _NEAR[0] < apart < _NEAR[1] and _OF_A_SIZE[0] < ratio < _OF_A_SIZE[1]


@njit(cache=True, nogil=True)
def _may_touch(marker: Array, square: Array) -> bool:
    apart = _apart(marker, square)
    return _TOUCHING_FROM < apart < _NEAR[1] and square[2] > _OF_A_SIZE[0] * marker[2]


@njit(cache=True, nogil=True)
def _apart(marker: Array, other: Array) -> float:
    """Return the distance from centre to centre by the marker's side."""
    return float(np.sqrt((other[0] - marker[0]) ** 2 + (other[1] - marker[1]) ** 2) / marker[2])


@njit(cache=True, nogil=True)
def _between_corners(a: Array, b: Array) -> float:
    """Return the least distance of a corner of one square from one of another, pixels."""
    least2 = np.inf
    for i in range(4):
        for k in range(4):
            least2 = min(least2, (a[i, 0] - b[k, 0]) ** 2 + (a[i, 1] - b[k, 1]) ** 2)
    return float(np.sqrt(least2))

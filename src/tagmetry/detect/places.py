"""Which squares stand in one place? Those with centres close by, and sides of about one length."""

import numpy as np
from numba import njit

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

_SAME_PLACE = 0.5  # centres closer than this share of a side, and sides alike, are one place
_ALIKE = 1.6


def side_lengths(corners_px: Array) -> Array:
    """Return the lengths of the sides of squares (n, 4, 2), shape (n, 4), pixels."""
    sides = corners_px[:, [1, 2, 3, 0]] - corners_px
    return np.hypot(sides[..., 0], sides[..., 1])


def one_per_place(corners_px: Array) -> Array:
    """Return squares (n, 4, 2) without those that an earlier one stands in the place of."""
    return corners_px[first_per_place(corners_px)]


def first_per_place(corners_px: Array) -> BoolArray:
    """Say which squares (n, 4, 2) no earlier one stands in the place of, shape (n,)."""
    return _first_per_place(discs(np.ascontiguousarray(corners_px)))


def in_places(corners_px: Array, known_px: Array) -> BoolArray:
    """Say which squares (n, 4, 2) stand in the place of one of others (m, 4, 2), shape (n,)."""
    known = discs(np.ascontiguousarray(known_px))
    return _in_places(discs(np.ascontiguousarray(corners_px)), known)


@njit(cache=True, nogil=True)
def discs(corners_px: Array) -> Array:
    """Return centre x, y and mean side of squares, shape (n, 3), pixels."""
    places = np.zeros((len(corners_px), 3))
    for i in range(len(corners_px)):
        for k in range(4):
            x, y = corners_px[i, k, 0], corners_px[i, k, 1]
            dx, dy = x - corners_px[i, k - 1, 0], y - corners_px[i, k - 1, 1]
            places[i, 0] += x / 4
            places[i, 1] += y / 4
            places[i, 2] += np.sqrt(dx**2 + dy**2) / 4
    return places


@njit(cache=True, nogil=True)
def _first_per_place(places: Array) -> BoolArray:
    first = np.ones(len(places), np.bool_)
    for i in range(len(places)):
        for k in range(i):
            if first[k] and _is_same(places[i], places[k]):
                first[i] = False
                break
    return first


@njit(cache=True, nogil=True)
def _in_places(places: Array, known: Array) -> BoolArray:
    among = np.zeros(len(places), np.bool_)
    for i in range(len(places)):
        for k in range(len(known)):
            if _is_same(places[i], known[k]):
                among[i] = True
                break
    return among


@njit(cache=True, nogil=True)
def _is_same(one: Array, other: Array) -> bool:
    apart2 = (one[0] - other[0]) ** 2 + (one[1] - other[1]) ** 2
    smaller, larger = min(one[2], other[2]), max(one[2], other[2])
    return bool(apart2 < (_SAME_PLACE * smaller) ** 2 and larger < _ALIKE * smaller)

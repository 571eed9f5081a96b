"""Which robots are within reach of others, compiled: all pairs are looked at in every image."""

import numpy as np

from tagmetry.arena.compiled import kernel, wrapped_rad
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray

_ROUNDING_RAD = 1e-12


@kernel
def within_reach(
    places: Array, rows: IntArray, range_m: float, view: tuple[float, float]
) -> tuple[IntArray, IntArray, Array]:
    """Return which robots some have within their sensors' range and field of view.

    Args:
        places: (x, y, heading) of all robots, shape (n, 3).
        rows: Whose sensors are asked, shape (m,).
        range_m: Farthest.
        view: Middle and width of the field of view, rad.

    Returns:
        Of every pair, in rising order: which of `rows`, shape (k,), which robot, shape (k,), and
        its range, bearing and relative heading, the last not wrapped, shape (k, 3).
    """
    count = _near_count(places, rows, range_m)
    who, whom = np.empty(count, dtype=np.int64), np.empty(count, dtype=np.int64)
    told, found = np.empty((count, 3)), 0
    for k, row in enumerate(rows):
        for other in range(len(places)):
            if other == row or not _may_be_near(places, row, other, range_m):
                continue
            x, y = places[other, 0] - places[row, 0], places[other, 1] - places[row, 1]
            away_m, bearing = np.hypot(x, y), wrapped_rad(np.arctan2(y, x) - places[row, 2])
            off = abs(wrapped_rad(bearing - view[0]))
            if away_m <= range_m and off <= view[1] / 2.0 + _ROUNDING_RAD:
                who[found], whom[found] = k, other
                told[found, 0], told[found, 1] = away_m, bearing
                told[found, 2] = places[other, 2] - places[row, 2]
                found += 1
    return who[:found], whom[:found], told[:found]


@kernel
def _near_count(places: Array, rows: IntArray, range_m: float) -> int:
    """Return how many pairs there may be at most."""
    count = 0
    for row in rows:
        for other in range(len(places)):
            count += _may_be_near(places, row, other, range_m)
    return count


@kernel
def _may_be_near(places: Array, row: int, other: int, range_m: float) -> bool:
    """Say whether a pair is worth a root; but for rounding, whether it is within the range."""
    x, y = places[other, 0] - places[row, 0], places[other, 1] - places[row, 1]
    return bool(x * x + y * y <= range_m * range_m * (1.0 + 1e-9))

"""Predicted squares moved onto the edges that the image shows close by.

Across each side eight profiles are read. Each tells where its steepest step from the inside to the
outside is; a line of median slope and offset through the eight is the side, whatever one or two of
them met. So predictions may be off by a cell, and are good to a fraction of a pixel afterwards.
"""

import numpy as np
from numba import njit

from tagmetry.detect.reading.sample import bilinear
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

_SCANS = 8
_HALF = _SCANS // 2
_AT = (np.arange(_SCANS) + 0.5) / _SCANS - 0.5  # along a side, from its middle
_REACH = 8  # steps of a profile to each side
_APART = 3  # steps inside and outside a place, where the values are that are compared
_COUNT = 2 * _REACH + 1
_READ = _COUNT + 2 * _APART
_SHARE = 0.6  # of the steepest step: its middle is midway between where it falls below
_LEAST_SINE = 0.1


@njit(cache=True, nogil=True, error_model="numpy")
def nudged(grey: GreyPixels, corners_px: Array, reach_px: Array, sign: Array) -> Array:
    """Return squares moved onto the edges within reach, shape (n, 4, 2).

    Args:
        grey: 8-bit image.
        corners_px: Where they are expected, clockwise, shape (n, 4, 2).
        reach_px: How far from there edges are looked for, shape (n,).
        sign: +1 for dark squares on bright ground, -1 for bright ones, shape (n,).
    """
    moved = np.empty_like(corners_px)
    lines = np.empty((4, 4))
    for i in range(len(corners_px)):
        for side in range(4):
            a, b = corners_px[i, side], corners_px[i, (side + 1) % 4]
            _find_side(grey, a, b, reach_px[i] / _REACH, sign[i], lines[side])
        _meet(lines, corners_px[i], moved[i])
    return moved


@njit(cache=True, nogil=True, error_model="numpy")
def _find_side(
    grey: GreyPixels, a: Array, b: Array, step_px: float, sign: float, line: Array
) -> None:
    """Write (point, direction) of the line on which the side from a to b is seen."""
    along_x, along_y = b[0] - a[0], b[1] - a[1]
    length = max(np.hypot(along_x, along_y), 1e-9)
    across = (step_px * along_y / length, -step_px * along_x / length)  # outward
    shifts, values, rises = np.empty(_SCANS), np.empty(_READ), np.empty(_COUNT)
    for k in range(_SCANS):
        x, y = a[0] + (0.5 + _AT[k]) * along_x, a[1] + (0.5 + _AT[k]) * along_y
        shifts[k] = _steepest(grey, (x, y), across, sign, values, rises)
    first, last = _ends(shifts)
    line[0], line[1] = a[0] + first * across[0], a[1] + first * across[1]
    line[2], line[3] = b[0] + last * across[0] - line[0], b[1] + last * across[1] - line[1]


@njit(cache=True, nogil=True, error_model="numpy")
def _steepest(
    grey: GreyPixels,
    place: tuple[float, float],
    step: tuple[float, float],
    sign: float,
    values: Array,
    rises: Array,
) -> float:
    """Return where a profile through a place rises most, in steps from the place.

    Its values and rises are written.
    """
    x, y = place
    best, far = 0, _REACH + _APART
    for k in range(_READ):
        values[k] = bilinear(grey, x + (k - far) * step[0], y + (k - far) * step[1])
    for k in range(_COUNT):
        rises[k] = sign * (values[k + 2 * _APART] - values[k])
        best = k if rises[k] > rises[best] else best
    return 0.5 * (_falls(rises, best, -1) + _falls(rises, best, 1)) - _REACH


@njit(cache=True, nogil=True, error_model="numpy")
def _falls(rises: Array, best: int, way: int) -> float:
    """Return where rises fall below a share of the best one, going one way from it."""
    least = _SHARE * rises[best]
    k = best
    while 0 <= k + way < _COUNT:
        if rises[k + way] < least:
            return float(k + way * (rises[k] - least) / (rises[k] - rises[k + way]))
        k += way
    return float(k)


@njit(cache=True, nogil=True)
def _ends(shifts: Array) -> tuple[float, float]:
    """Return by how many steps a side moves at its start and at its end, by medians."""
    apart = _AT[_HALF] - _AT[0]
    slopes, offsets = np.empty(_HALF), np.empty(_SCANS)
    for k in range(_HALF):
        slopes[k] = (shifts[k + _HALF] - shifts[k]) / apart
    slope = _median(slopes)
    for k in range(_SCANS):
        offsets[k] = shifts[k] - slope * _AT[k]
    offset = _median(offsets)
    return offset - 0.5 * slope, offset + 0.5 * slope


@njit(cache=True, nogil=True)
def _median(values: Array) -> float:
    """Return the mean of the middle two of an even number of values, which are put in order."""
    for k in range(1, len(values)):  # NumPy's own would take seconds to compile
        for j in range(k, 0, -1):
            low, high = min(values[j - 1], values[j]), max(values[j - 1], values[j])
            values[j - 1], values[j] = low, high
    half = len(values) // 2
    return float(0.5 * (values[half - 1] + values[half]))


@njit(cache=True, nogil=True, error_model="numpy")
def _meet(lines: Array, first_px: Array, moved: Array) -> None:
    """Write where each line (point, direction) meets the one before it; else where it was."""
    for k in range(4):
        ax, ay, ux, uy = lines[k - 1]
        bx, by, vx, vy = lines[k]
        cross = ux * vy - uy * vx
        moved[k] = first_px[k]
        if cross > _LEAST_SINE * np.hypot(ux, uy) * np.hypot(vx, vy):
            along = ((bx - ax) * vy - (by - ay) * vx) / cross
            moved[k, 0], moved[k, 1] = ax + along * ux, ay + along * uy

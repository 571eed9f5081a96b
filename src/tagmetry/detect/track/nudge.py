"""Predicted squares moved onto the edges that the image shows close by.

Across each side eight profiles are read. Each tells where its steepest step from the inside to the
outside is; a line of median slope and offset through the eight is the side, whatever one or two of
them met. So predictions may be off by a cell, and are good to a fraction of a pixel afterwards.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tagmetry.detect.reading.sample import Narrow, Room, look_up, new_room
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

_SCANS = 8  # of each side
_HALF = _SCANS // 2
_AT = (np.arange(_SCANS) + 0.5) / _SCANS - 0.5  # along a side, from its middle
_REACH = 8  # steps of a profile to each side
_APART = 3  # steps inside and outside a place, where the values are that are compared
_COUNT = 2 * _REACH + 1
_READ = _COUNT + 2 * _APART
_SHARE = 0.6  # of the steepest step: its middle is midway between where it falls below
_LEAST_SINE = 0.1
PLACES = 4 * _SCANS * _READ  # that are looked up of a square


class Bench(NamedTuple):
    """What is worked on for one square.

    Attributes:
        room: For `PLACES` places at least.
        rises: Of a profile.
        shifts: Of the profiles of a side.
        lines: Of the sides, (point, direction), shape (4, 4).
    """

    room: Room
    rises: Array
    shifts: Array
    lines: Array


@njit(cache=True, nogil=True)
def new_bench(room: Room) -> Bench:
    """Return a bench with a room."""
    return Bench(room, np.empty(_COUNT), np.empty(_SCANS), np.empty((4, 4)))


@njit(cache=True, nogil=True)
def nudged(grey: GreyPixels, corners_px: Array, reach_px: Array, sign: Array) -> Array:
    """Return squares moved onto the edges within reach, shape (n, 4, 2).

    Args:
        grey: 8-bit image.
        corners_px: Where they are expected, clockwise, shape (n, 4, 2).
        reach_px: How far from there edges are looked for, shape (n,).
        sign: +1 for dark squares on bright ground, -1 for bright ones, shape (n,).
    """
    moved, bench = np.empty_like(corners_px), new_bench(new_room(PLACES))
    for i in range(len(corners_px)):
        nudge(grey, corners_px[i], reach_px[i], sign[i], bench, moved[i])
    return moved


@njit(cache=True, nogil=True)
def nudge(
    grey: GreyPixels, square_px: Array, reach_px: float, sign: float, bench: Bench, moved: Array
) -> None:
    """Write one square, (4, 2), moved onto the edges within reach; arguments as of `nudged`."""
    step_px = reach_px / _REACH
    for side in range(4):
        _place_profiles(square_px, side, step_px, bench.room)
    look_up(grey, bench.room, PLACES)
    for side in range(4):
        _find_side(square_px, side, step_px, sign, bench)
    _meet(bench.lines, square_px, moved)


@njit(cache=True, nogil=True)
def _place_profiles(square_px: Array, side: int, step_px: float, room: Room) -> None:
    """Write the places of the profiles across a side, from the inside out."""
    start_x, start_y, along_x, along_y = _side(square_px, side)
    out_x, out_y = _outward(along_x, along_y, step_px)
    for scan in range(_SCANS):
        first = (side * _SCANS + scan) * _READ
        x, y = start_x + (0.5 + _AT[scan]) * along_x, start_y + (0.5 + _AT[scan]) * along_y
        for k in range(_READ):
            steps = k - (_REACH + _APART)
            room.x[first + k], room.y[first + k] = x + steps * out_x, y + steps * out_y


@njit(cache=True, nogil=True)
def _side(square_px: Array, side: int) -> tuple[float, float, float, float]:
    """Return where a side starts, x and y, and what is added to come to its end."""
    x, y, end = square_px[side, 0], square_px[side, 1], (side + 1) % 4
    return x, y, square_px[end, 0] - x, square_px[end, 1] - y


@njit(cache=True, nogil=True)
def _outward(along_x: float, along_y: float, step_px: float) -> tuple[float, float]:
    """Return a step across a side."""
    length = max(np.hypot(along_x, along_y), 1e-9)
    return step_px * along_y / length, -step_px * along_x / length


@njit(cache=True, nogil=True, error_model="numpy")
def _find_side(square_px: Array, side: int, step_px: float, sign: float, bench: Bench) -> None:
    """Write (point, direction) of the line on which a side is seen."""
    x, y, along_x, along_y = _side(square_px, side)
    out_x, out_y = _outward(along_x, along_y, step_px)
    for scan in range(_SCANS):
        first = (side * _SCANS + scan) * _READ
        bench.shifts[scan] = _steepest(bench.room.values, first, sign, bench.rises)
    start, end = _ends(bench.shifts)
    turn = end - start
    bench.lines[side, 0], bench.lines[side, 1] = x + start * out_x, y + start * out_y
    bench.lines[side, 2], bench.lines[side, 3] = along_x + turn * out_x, along_y + turn * out_y


@njit(cache=True, nogil=True, error_model="numpy")
def _steepest(values: Narrow, first: int, sign: float, rises: Array) -> float:
    """Return where a profile rises most, in steps from its middle; its rises are written."""
    best = 0
    for k in range(_COUNT):
        rises[k] = sign * (values[first + k + 2 * _APART] - values[first + k])
    for k in range(1, _COUNT):
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

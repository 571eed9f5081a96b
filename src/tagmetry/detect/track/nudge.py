"""Predicted squares moved onto the edges that the image shows close by.

Across each side eight profiles are read. Each tells where its steepest step from the inside to the
outside is; a line of median slope and offset through the eight is the side, whatever one or two of
them met. So predictions may be off by a cell, and are good to a fraction of a pixel afterwards.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tagmetry.detect.reading.sample import Narrow, Room, look_up
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels, IntArray

_SCANS = 8  # profiles of a side
_HALF = _SCANS // 2
_AT = (np.arange(_SCANS) + 0.5) / _SCANS - 0.5  # along a side, from its middle
_REACH = 8  # steps of a profile to each side
_APART = 3  # steps inside and outside a place, where the values are that are compared
_COUNT = 2 * _REACH + 1
_READ = _COUNT + 2 * _APART
_SHARE = 0.6  # of the steepest step: its middle is midway between where it falls below
_LEAST_SINE = 0.1
_FINE_CELLS = 0.5  # how far edges are looked for once more
_LEAST_FINE_PX = 1.5
_FINE_TRIES = 3
_STAYS_PX = 0.5  # a square that moves less is on its edges
# What is looked up across a side: the first place of each profile, then the second, …
PROFILE_PLACES = _SCANS * _READ
_ALONG = np.tile(_AT + 0.5, _READ).astype(np.float32)
_ACROSS = np.repeat(np.arange(_READ) - _REACH - _APART, _SCANS).astype(np.float32)


class Bench(NamedTuple):
    """What is worked on for one square.

    Attributes:
        room: For `PROFILE_PLACES` places at least.
        rises: Of the profiles of a side, the first of each, the second, …
        best: Where each rises most.
        shifts: Where that is, in steps from its middle.
        lines: Of the sides, (point, direction), shape (4, 4).
        before_px: The square before it is moved once more, shape (4, 2).
    """

    room: Room
    rises: Narrow
    best: IntArray
    shifts: Array
    lines: Array
    before_px: Array


@njit(cache=True, nogil=True)
def new_bench(room: Room) -> Bench:
    """Return a bench with a room."""
    rises, best = np.empty(_COUNT * _SCANS, np.float32), np.empty(_SCANS, np.int64)
    return Bench(room, rises, best, np.empty(_SCANS), np.empty((4, 4)), np.empty((4, 2)))


@njit(cache=True, nogil=True)
def onto_edges(
    grey: GreyPixels,
    square_px: Array,
    reach_px: float,
    sign: float,
    side_cells: float,
    bench: Bench,
    moved_px: Array,
) -> None:
    """Write a square moved onto the edges: from afar at first coarsely, then finely until it stays.

    One side may be drawn to another edge as long as the others are not on theirs.

    Args:
        grey: 8-bit image.
        square_px: Where it is expected, clockwise, shape (4, 2).
        reach_px: How far from there edges are looked for at first.
        sign: +1 for a dark square on bright ground, -1 for a bright one.
        side_cells: Along a side.
        bench: To work on.
        moved_px: For the result, shape (4, 2).
    """
    before_px = bench.before_px
    before_px[:] = square_px
    nudge(grey, before_px, reach_px, sign, bench, moved_px)
    fine_px = max(_FINE_CELLS * cell_px(moved_px, side_cells), _LEAST_FINE_PX)
    for _ in range(_FINE_TRIES):
        if reach_px <= fine_px and _farthest(before_px, moved_px) <= _STAYS_PX:
            break
        before_px[:], reach_px = moved_px, fine_px
        nudge(grey, before_px, fine_px, sign, bench, moved_px)


@njit(cache=True, nogil=True)
def _farthest(before_px: Array, after_px: Array) -> float:
    """Return the most that a coordinate of the corners differs."""
    most_px = 0.0
    for k in range(4):
        x, y = after_px[k, 0] - before_px[k, 0], after_px[k, 1] - before_px[k, 1]
        most_px = max(most_px, abs(x), abs(y))
    return most_px


@njit(cache=True, nogil=True)
def cell_px(square_px: Array, side_cells: float) -> float:
    """Return the size of a cell of a square."""
    around_px = 0.0
    for k in range(4):
        x, y = square_px[k, 0] - square_px[k - 1, 0], square_px[k, 1] - square_px[k - 1, 1]
        around_px += np.sqrt(x**2 + y**2)
    return float(around_px / 4 / side_cells)


@njit(cache=True, nogil=True)
def nudge(
    grey: GreyPixels, square_px: Array, reach_px: float, sign: float, bench: Bench, moved: Array
) -> None:
    """Write a square moved onto the edges within reach.

    Args:
        grey: 8-bit image.
        square_px: Where it is expected, clockwise, shape (4, 2).
        reach_px: How far from there edges are looked for.
        sign: +1 for a dark square on bright ground, -1 for a bright one.
        bench: To work on.
        moved: For the result, shape (4, 2).
    """
    for side in range(4):
        x, y = square_px[side, 0], square_px[side, 1]
        along_x, along_y = square_px[side - 3, 0] - x, square_px[side - 3, 1] - y
        step = reach_px / _REACH / max(np.hypot(along_x, along_y), 1e-9)
        out_x, out_y = step * along_y, -step * along_x
        _place_profiles((x, y), (along_x, along_y), (out_x, out_y), bench.room)
        look_up(grey, bench.room, PROFILE_PLACES)
        _write_shifts(sign, bench)
        start, end = _ends(bench.shifts)
        turn, line = end - start, bench.lines[side]
        line[0], line[1] = x + start * out_x, y + start * out_y
        line[2], line[3] = along_x + turn * out_x, along_y + turn * out_y
    _meet(bench.lines, square_px, moved)


@njit(cache=True, nogil=True)
def _place_profiles(
    start: tuple[float, float], along: tuple[float, float], out: tuple[float, float], room: Room
) -> None:
    """Write the places of the profiles across a side, from the inside out."""
    x, y = np.float32(start[0]), np.float32(start[1])
    along_x, along_y = np.float32(along[0]), np.float32(along[1])
    out_x, out_y = np.float32(out[0]), np.float32(out[1])
    for k in range(PROFILE_PLACES):
        room.x[k] = x + _ALONG[k] * along_x + _ACROSS[k] * out_x
        room.y[k] = y + _ALONG[k] * along_y + _ACROSS[k] * out_y


@njit(cache=True, nogil=True)
def _write_shifts(sign: float, bench: Bench) -> None:
    """Write where the profiles of a side rise most, in steps from their middles."""
    values, rises, best, wanted = bench.room.values, bench.rises, bench.best, np.float32(sign)
    for k in range(_COUNT * _SCANS):
        rises[k] = wanted * (values[k + 2 * _APART * _SCANS] - values[k])
    best[:] = np.arange(_SCANS)
    for k in range(_SCANS, _COUNT * _SCANS):
        scan = k % _SCANS
        best[scan] = k if rises[k] > rises[best[scan]] else best[scan]
    for scan in range(_SCANS):
        inside, outside = _falls(rises, best[scan], -_SCANS), _falls(rises, best[scan], _SCANS)
        bench.shifts[scan] = 0.5 * (inside + outside) - _REACH


@njit(cache=True, nogil=True, error_model="numpy")
def _falls(rises: Narrow, best: int, way: int) -> float:
    """Return at which step rises fall below a share of the best one.

    Args:
        rises: Of all profiles of a side.
        best: The best of one profile.
        way: To the next of this profile, outward or inward.
    """
    least, k, end = _SHARE * rises[best], best, len(rises)
    while 0 <= k + way < end:
        if rises[k + way] < least:
            past = (rises[k] - least) / (rises[k] - rises[k + way])
            return float((k // _SCANS) + (past if way > 0 else -past))
        k += way
    return float(k // _SCANS)


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

"""What is seen where markers are expected, one after another in a kernel.

A marker's square is moved onto the edges close by, and its cells are read. Where motion blurs edges
until they are nowhere steep, the prediction may be the better place: the one of the two is taken
that looks more like the marker.

With v the values at the k places, w what is expected, +1 and -1, and both less their parts that the
functions of light explain (even light, and light that falls off),

    half the contrast = v . w / w . w        correlation = v . w / (|v| |w|)
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tagmetry.detect.reading.sample import (
    STEPS,
    Narrow,
    Room,
    new_room,
    write_means,
    write_square_to_quad,
    write_steps,
)
from tagmetry.detect.track.nudge import PLACES, Bench, new_bench, nudge
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray

_FINE_CELLS = 0.5  # how far edges are looked for once more
_LEAST_FINE_PX = 1.5
_FINE_TRIES = 3
_STAYS_PX = 0.5  # a square that moves less is on its edges
_CLEAR = 0.9  # correlation below which the place that was predicted is tried as well
_EDGE_CELLS = 0.3  # how far inside and outside a side the image must differ


class Asked(NamedTuple):
    """What n markers of one family are expected.

    Attributes:
        codes: Of all markers of the family, True is white, shape (ids, bits).
        ids: Which are expected, shape (n,).
        corners_px: Where, shape (n, 4, 2).
        reach_px: How far from there edges are looked for, shape (n,).
        sign: +1 for dark squares on bright ground, -1 for bright ones, shape (n,).
        is_inverted: The other way about than their family is printed, shape (n,).
    """

    codes: BoolArray
    ids: IntArray
    corners_px: Array
    reach_px: Array
    sign: Array
    is_inverted: BoolArray


class Spots(NamedTuple):
    """What is looked at on the markers of a layout; see `cells.Places`.

    Attributes:
        taps: Shape (2, 4 k).
        plain: Shape (k - bits,).
        light: Shape (k, 3).
        quiet: How many of the places lie outside of the marker.
        side_cells: Along a side.
    """

    taps: Narrow
    plain: Array
    light: Array
    quiet: int
    side_cells: float


class Seen(NamedTuple):
    """What is seen of n markers; see `sight.Sights`.

    Attributes:
        corners_px: Shape (n, 4, 2).
        margins: Shape (n, k).
        measures: Contrast, correlation, wrong bits, confidence, right shares of frame and of quiet
            zone, shape (n, 6).
        steps: Shape (n, 4).
    """

    corners_px: Array
    margins: Array
    measures: Array
    steps: Array


class _Desk(NamedTuple):
    """What is worked on for one marker.

    Attributes:
        room: For places to look up.
        bench: To move its square.
        before_px: Its corners before they are moved, shape (4, 2).
        H: From the unit square to pixels, shape (3, 3).
        values: At its places, shape (k,).
        expected: Shape (k,).
        steps: Across its sides, shape (40,).
    """

    room: Room
    bench: Bench
    before_px: Array
    H: Array
    values: Array
    expected: Array
    steps: Array


@njit(cache=True, nogil=True)
def see_each(grey: GreyPixels, asked: Asked, spots: Spots, seen: Seen) -> None:
    """Write what is seen of n markers.

    Args:
        grey: 8-bit image.
        asked: Which, and where.
        spots: What is looked at.
        seen: For the result.
    """
    desk, other = _new_desk(spots), _new_seen(spots)
    for i in range(len(asked.ids)):
        square_px, light = asked.corners_px[i], -1.0 if asked.is_inverted[i] else 1.0
        _expect(asked.codes[asked.ids[i]], spots.plain, desk.expected)
        _onto_edges(grey, square_px, asked.reach_px[i], asked.sign[i], spots, desk, seen, i)
        _see(grey, light, asked.sign[i], spots, desk, seen, i)
        if not seen.measures[i, 1] >= _CLEAR:
            other.corners_px[0] = square_px
            _see(grey, light, asked.sign[i], spots, desk, other, 0)
            if other.measures[0, 1] > seen.measures[i, 1]:
                _replace(seen, i, other)


@njit(cache=True, nogil=True)
def _new_desk(spots: Spots) -> _Desk:
    room = new_room(max(spots.taps.shape[1], PLACES, 2 * STEPS))
    values, expected = np.empty(len(spots.light)), np.empty(len(spots.light))
    before_px, H, steps = np.empty((4, 2)), np.empty((3, 3)), np.empty(STEPS)
    return _Desk(room, new_bench(room), before_px, H, values, expected, steps)


@njit(cache=True, nogil=True)
def _new_seen(spots: Spots) -> Seen:
    margins = np.empty((1, len(spots.light)))
    return Seen(np.empty((1, 4, 2)), margins, np.empty((1, 6)), np.empty((1, 4)))


@njit(cache=True, nogil=True)
def _replace(seen: Seen, i: int, other: Seen) -> None:
    seen.corners_px[i], seen.margins[i] = other.corners_px[0], other.margins[0]
    seen.measures[i], seen.steps[i] = other.measures[0], other.steps[0]


@njit(cache=True, nogil=True)
def _expect(code: BoolArray, plain: Array, expected: Array) -> None:
    """Write what a marker's places show."""
    for k in range(code.size):
        expected[k] = 1.0 if code[k] else -1.0
    expected[code.size :] = plain


@njit(cache=True, nogil=True)
def _onto_edges(
    grey: GreyPixels,
    square_px: Array,
    reach_px: float,
    sign: float,
    spots: Spots,
    desk: _Desk,
    seen: Seen,
    i: int,
) -> None:
    """Write a square moved onto the edges: from afar at first coarsely, then finely until it stays.

    One side may be drawn to another edge as long as the others are not on theirs.
    """
    moved_px, before_px = seen.corners_px[i], desk.before_px
    before_px[:] = square_px
    nudge(grey, before_px, reach_px, sign, desk.bench, moved_px)
    fine_px = max(_FINE_CELLS * _cell_px(moved_px, spots.side_cells), _LEAST_FINE_PX)
    for _ in range(_FINE_TRIES):
        if reach_px <= fine_px and _farthest(before_px, moved_px) <= _STAYS_PX:
            break
        before_px[:], reach_px = moved_px, fine_px
        nudge(grey, before_px, fine_px, sign, desk.bench, moved_px)


@njit(cache=True, nogil=True)
def _farthest(before_px: Array, after_px: Array) -> float:
    """Return the most that a coordinate of the corners differs."""
    most_px = 0.0
    for k in range(4):
        x, y = after_px[k, 0] - before_px[k, 0], after_px[k, 1] - before_px[k, 1]
        most_px = max(most_px, abs(x), abs(y))
    return most_px


@njit(cache=True, nogil=True)
def _cell_px(square_px: Array, side_cells: float) -> float:
    around_px = 0.0
    for k in range(4):
        x, y = square_px[k, 0] - square_px[k - 1, 0], square_px[k, 1] - square_px[k - 1, 1]
        around_px += np.sqrt(x**2 + y**2)
    return float(around_px / 4 / side_cells)


@njit(cache=True, nogil=True, error_model="numpy")
def _see(
    grey: GreyPixels, light: float, sign: float, spots: Spots, desk: _Desk, seen: Seen, i: int
) -> None:
    """Write what the square shows that `seen` has for marker i."""
    square_px, measures = seen.corners_px[i], seen.measures[i]
    write_square_to_quad(square_px, desk.H)
    write_means(grey, desk.H, spots.taps, desk.room, desk.values)
    half, correlation = _write_margins(desk.values, desk.expected, spots.light, seen.margins[i])
    measures[0], measures[1] = 2 * light * half, light * correlation
    _write_shares(seen.margins[i], desk.expected, spots, measures[2:])
    reach_px = _EDGE_CELLS * _cell_px(square_px, spots.side_cells)
    write_steps(grey, square_px, reach_px, desk.room, desk.steps)
    along = desk.steps.size // 4
    for side in range(4):
        seen.steps[i, side] = sign * desk.steps[side * along : (side + 1) * along].mean()


@njit(cache=True, nogil=True, error_model="numpy")
def _write_margins(
    values: Array, expected: Array, light: Array, margins: Array
) -> tuple[float, float]:
    """Write (value - middle) / half the contrast; return this half, and the correlation."""
    of_values, of_expected = np.zeros(3), np.zeros(3)
    vv, vw, ww = 0.0, 0.0, 0.0
    for k in range(values.size):
        v, w = values[k], expected[k]
        vv, vw, ww = vv + v * v, vw + v * w, ww + w * w
        for t in range(3):
            of_values[t] += v * light[k, t]
            of_expected[t] += w * light[k, t]
    for t in range(3):
        vv -= of_values[t] ** 2
        vw -= of_values[t] * of_expected[t]
        ww -= of_expected[t] ** 2
    half = vw / ww
    for k in range(values.size):
        middle = 0.0
        for t in range(3):
            middle += (of_values[t] - half * of_expected[t]) * light[k, t]
        margins[k] = (values[k] - middle) / half if half != 0.0 else 0.0
    return half, vw / np.sqrt(vv * ww) if vv > 0.0 else 0.0


@njit(cache=True, nogil=True)
def _write_shares(margins: Array, expected: Array, spots: Spots, shares: Array) -> None:
    """Write the number of wrong bits, the confidence, the right shares of frame and quiet zone."""
    bits, end = margins.size - spots.plain.size, margins.size - spots.quiet
    wrong, clear, framed, quiet = 0, 0.0, 0, 0
    for k in range(margins.size):
        right = margins[k] * expected[k]
        wrong += (k < bits) & (right <= 0)
        framed += (bits <= k) & (k < end) & (right > 0)
        quiet += (k >= end) & (right > 0)
        clear += min(max(right, -1.0), 1.0) if k < end else 0.0
    shares[0], shares[1] = wrong, min(max(clear / end, 0.0), 1.0)
    shares[2], shares[3] = framed / (end - bits), quiet / spots.quiet if spots.quiet else 1.0

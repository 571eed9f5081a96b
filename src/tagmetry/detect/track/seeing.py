"""What is seen where markers are expected, one after another in a kernel.

A marker's square is moved onto the edges close by, and its cells are read. Where motion blurs edges
until they are nowhere steep, the prediction may be the better place: the one of the two is taken
that looks more like the marker.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tagmetry.detect.reading.sample import (
    STEPS,
    Room,
    new_room,
    write_means,
    write_square_to_quad,
    write_steps,
)
from tagmetry.detect.track.cells import Places
from tagmetry.detect.track.margins import write_margins, write_shares
from tagmetry.detect.track.nudge import PROFILE_PLACES, Bench, cell_px, new_bench, onto_edges
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_CLEAR = 0.9  # correlation below which the place that was predicted is tried as well
_EDGE_CELLS = 0.3  # how far inside and outside a side the image must differ


class Asked(NamedTuple):
    """n markers of one family that are expected.

    Attributes:
        codes: Their bits, True is white, shape (n, bits).
        corners_px: Where they are expected, shape (n, 4, 2).
        reach_px: How far from there edges are looked for, shape (n,).
        sign: +1 for dark squares on bright ground, -1 for bright ones, shape (n,).
        is_inverted: The other way about than their family is printed, shape (n,).
    """

    codes: BoolArray
    corners_px: Array
    reach_px: Array
    sign: Array
    is_inverted: BoolArray


class Shown(NamedTuple):
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
        H: From the unit square to pixels, shape (3, 3).
        values: At its places, shape (k,).
        expected: Shape (k,).
        steps: Across its sides, shape (40,).
    """

    room: Room
    bench: Bench
    H: Array
    values: Array
    expected: Array
    steps: Array


@njit(cache=True, nogil=True)
def see_each(grey: GreyPixels, asked: Asked, places: Places, shown: Shown) -> None:
    """Write what is seen of n markers.

    Args:
        grey: 8-bit image.
        asked: Which, and where.
        places: What is looked at.
        shown: For the result.
    """
    desk, other = _new_desk(places), _new_shown(places)
    for i in range(len(asked.codes)):
        square_px, light = asked.corners_px[i], -1.0 if asked.is_inverted[i] else 1.0
        _expect(asked.codes[i], places.plain, desk.expected)
        reach_px, sign, moved_px = asked.reach_px[i], asked.sign[i], shown.corners_px[i]
        onto_edges(grey, square_px, reach_px, sign, places.side_cells, desk.bench, moved_px)
        _see(grey, light, sign, places, desk, shown, i)
        if not shown.measures[i, 1] >= _CLEAR:
            other.corners_px[0] = square_px
            _see(grey, light, sign, places, desk, other, 0)
            if other.measures[0, 1] > shown.measures[i, 1]:
                _replace(shown, i, other)


@njit(cache=True, nogil=True)
def _new_desk(places: Places) -> _Desk:
    room = new_room(max(places.taps.shape[1], PROFILE_PLACES, 2 * STEPS))
    values, expected = np.empty(len(places.light)), np.empty(len(places.light))
    H, steps = np.empty((3, 3)), np.empty(STEPS)
    return _Desk(room, new_bench(room), H, values, expected, steps)


@njit(cache=True, nogil=True)
def _new_shown(places: Places) -> Shown:
    margins = np.empty((1, len(places.light)))
    return Shown(np.empty((1, 4, 2)), margins, np.empty((1, 6)), np.empty((1, 4)))


@njit(cache=True, nogil=True)
def _replace(shown: Shown, i: int, other: Shown) -> None:
    shown.corners_px[i], shown.margins[i] = other.corners_px[0], other.margins[0]
    shown.measures[i], shown.steps[i] = other.measures[0], other.steps[0]


@njit(cache=True, nogil=True)
def _expect(code: BoolArray, plain: Array, expected: Array) -> None:
    """Write what a marker's places show."""
    for k in range(code.size):
        expected[k] = 1.0 if code[k] else -1.0
    expected[code.size :] = plain


@njit(cache=True, nogil=True, error_model="numpy")
def _see(
    grey: GreyPixels, light: float, sign: float, places: Places, desk: _Desk, shown: Shown, i: int
) -> None:
    """Write what the square shows that `shown` has for marker i."""
    square_px, measures = shown.corners_px[i], shown.measures[i]
    write_square_to_quad(square_px, desk.H)
    write_means(grey, desk.H, places.taps, desk.room, desk.values)
    half, correlation = write_margins(desk.values, desk.expected, places.light, shown.margins[i])
    measures[0], measures[1] = 2 * light * half, light * correlation
    write_shares(shown.margins[i], desk.expected, places, measures[2:])
    reach_px = _EDGE_CELLS * cell_px(square_px, places.side_cells)
    write_steps(grey, square_px, reach_px, desk.room, desk.steps)
    along = desk.steps.size // 4
    for side in range(4):
        shown.steps[i, side] = sign * desk.steps[side * along : (side + 1) * along].mean()

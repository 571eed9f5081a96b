"""One look at an image: its dark squares by one idea of what is dark."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numba import njit

from tagmetry.detect.segment.corners import far_points, four_corners
from tagmetry.detect.segment.dark import Bits, Places, dark_bits, row_shift, thinned
from tagmetry.detect.segment.outline import (
    Cracks,
    at_level,
    box,
    midway,
    steps,
    walk,
)
from tagmetry.detect.segment.starts import starts
from tagmetry.detect.segment.tiles import Tiles
from tagmetry.geometry.arrays import Array, GreyPixels, IntArray

_DETOUR = 1.25  # an outline's length by the way around its box, which is 1 for convex shapes
_DETOUR_PX = 4
_STEPS_PX = 0.4  # how far steps from pixel to pixel stray from a side; thinned ones may not
_POINTS = 48  # and up to twice as many, of an outline
_THINNED_PX = 1.0
_NO_LEVELS = np.empty((0, 0), np.uint8)
_FLATTEST = 0.12  # height of a box by its width, or the reverse
_PIXELS_PER_START = 16  # an image of more starts is taken for noise, and its gate raised
_COARSER = 1.6
_MOST_GATE = 255.0


class _Desk(NamedTuple):
    """What the search for corners writes on, made once for all outlines.

    Attributes:
        points: Of an outline, shape (n, 2).
        indices: Which of them are corners, shape (5,).
        strays: How far the outline strays from the lines between them, and where, shape (2, 4).
    """

    points: Array
    indices: IntArray
    strays: Array


@dataclass(frozen=True)
class Look:
    """One idea of what is dark.

    Attributes:
        share: What lies below this share of the way from the darkest to the brightest around. A
            low one parts a marker from dim clutter, a high one closes faint borders.
        thinned: Dark areas are looked at once more, thinned by a pixel, which parts squares that
            touch at corners.
        step_share: By how much of the range around the image steps where an outline begins.
        most_px: Sides much longer than this are passed over.
    """

    share: float = 0.5
    thinned: bool = False
    step_share: float = 0.35
    most_px: float = np.inf


def dark_squares(grey: GreyPixels, tiles: Tiles, look: Look, least_px: float) -> Array:
    """Return the corners of dark squares, clockwise as seen, shape (n, 4, 2).

    Args:
        grey: 8-bit image.
        tiles: It cut into tiles.
        look: What is dark.
        least_px: Sides shorter than this are passed over.
    """
    gate, ranges = tiles.gate, tiles.near.ranges
    farthest_px = min(2 * look.most_px, grey.shape[0] + grey.shape[1])
    longest_px = _detour_px(farthest_px)
    most = max(1000, grey.size // _PIXELS_PER_START)
    while gate <= _MOST_GATE:
        levels = tiles.levels(look.share, gate)
        bits = dark_bits(grey, levels)
        begins = starts(bits, grey, ranges, look.step_share, most)
        if len(begins) < most:
            found = _outlined(bits, grey, levels, begins, least_px, longest_px)
            if not look.thinned:
                return found
            thin = thinned(bits)
            begins = starts(thin, grey, ranges, look.step_share, most)
            more = _outlined(thin, grey, _NO_LEVELS, begins, least_px, longest_px)
            return np.concatenate([found, more])
        gate *= _COARSER
    return np.empty((0, 4, 2))


@njit(cache=True, nogil=True)
def _outlined(
    bits: Bits,
    grey: GreyPixels,
    levels: GreyPixels,
    begins: Places,
    least_px: float,
    longest_px: int,
) -> Array:
    """Walk from all starts, and keep what has four sides."""
    corners = np.empty((len(begins), 4, 2))
    count = 0
    walked = np.empty(longest_px, np.uint64)
    desk = _Desk(np.empty((2 * _POINTS, 2)), np.empty(5, np.int64), np.empty((2, 4)))
    flat, shift, row_px = bits.reshape(-1), row_shift(bits), 8 * bits.shape[1]
    onward, backward = steps(row_px, 1), steps(row_px, -1)
    for start in begins:
        begin, end = walk(flat, np.uint64(row_px), onward, backward, start, walked)
        cracks = walked[begin:end]
        if len(cracks) >= 4 * least_px and _may_be_a_square(cracks, shift, least_px):
            square = _four_sided(cracks, shift, grey, levels, desk, corners[count])
            count += square and _least_side(corners[count]) >= least_px
    return corners[:count]


@njit(cache=True, nogil=True)
def _may_be_a_square(cracks: Cracks, shift: int, least_px: float) -> bool:
    """Say whether an outline is large and wide enough, and goes around without much detour."""
    width, height = box(cracks, shift)
    longer, shorter = max(width, height), min(width, height)
    wide = longer >= least_px and shorter >= max(_FLATTEST * longer, 0.5 * least_px)
    return wide and len(cracks) <= _detour_px(width + height)


@njit(cache=True, nogil=True)
def _four_sided(
    cracks: Cracks,
    shift: int,
    grey: GreyPixels,
    levels: GreyPixels,
    desk: _Desk,
    corners: Array,
) -> bool:
    """Write an outline's corners, told by some dozens of points; say whether it has four sides."""
    every = max(1, len(cracks) // _POINTS)
    points = desk.points[: len(cracks) // every]
    midway(cracks, shift, every, points)
    if not far_points(points, _STEPS_PX if levels.size else 0.0, desk.indices, desk.strays):
        return False
    if levels.size:
        at_level(cracks, shift, every, grey, levels, points)
    return four_corners(points, desk.indices, 0.0 if levels.size else _THINNED_PX, corners)


@njit(cache=True, nogil=True)
def _detour_px(width_and_height: float) -> int:
    """Return the longest outline that a square may have in a box of such a width and height."""
    return int(_DETOUR * 2 * width_and_height) + _DETOUR_PX


@njit(cache=True, nogil=True)
def _least_side(corners: Array) -> float:
    least = np.inf
    for k in range(4):
        side_x = corners[k, 0] - corners[k - 1, 0]
        side_y = corners[k, 1] - corners[k - 1, 1]
        least = min(least, np.hypot(side_x, side_y))
    return least

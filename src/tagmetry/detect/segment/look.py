"""One look at an image: its dark squares by one idea of what is dark."""

from dataclasses import dataclass

import cv2
import numpy as np
from numba import njit

from tagmetry.detect.segment.corners import far_points, four_corners
from tagmetry.detect.segment.mask import dark_mask
from tagmetry.detect.segment.outline import at_level, midway, steps, walk
from tagmetry.detect.segment.starts import Places, starts
from tagmetry.detect.segment.tiles import Tiles
from tagmetry.geometry.arrays import Array, GreyPixels

_DETOUR = 1.5  # an outline's length by the way around its box, which is 1 for convex shapes
_DETOUR_PX = 16
_STEPS_PX = 0.4  # how far the steps from pixel to pixel stray from a straight side
_COARSE_POINTS = 48
_FLATTEST = 0.12  # height of a box by its width, or the reverse
_PIXELS_PER_START = 16  # an image of more starts is taken for noise, and its gate raised
_COARSER = 1.6
_MOST_GATE = 255.0


@dataclass(frozen=True)
class Look:
    """One idea of what is dark.

    Attributes:
        share: What lies below this share of the way from the darkest to the brightest around. A
            low one parts a marker from dim clutter, a high one closes faint borders.
        thinned: Dark areas are thinned by a pixel, which parts squares that touch at corners.
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
    gate = tiles.gate
    while gate <= _MOST_GATE:
        levels = tiles.levels(look.share, gate)
        mask = dark_mask(grey, levels)
        if look.thinned:
            mask = np.asarray(cv2.erode(mask, np.ones((3, 3), np.uint8)), dtype=np.uint8)
        most = max(1000, mask.size // _PIXELS_PER_START)
        begins = starts(mask, grey, tiles.least_steps(look.step_share), most)
        if len(begins) < most:
            crossings = np.empty((0, 0), np.uint8) if look.thinned else levels
            outset_px = 1.0 if look.thinned else 0.0
            farthest_px = min(2 * look.most_px, grey.shape[0] + grey.shape[1])
            return _outlined(
                mask, grey, crossings, begins, outset_px, least_px, _detour_px(farthest_px)
            )
        gate *= _COARSER
    return np.empty((0, 4, 2))


@njit(cache=True, nogil=True)
def _outlined(
    mask: GreyPixels,
    grey: GreyPixels,
    levels: GreyPixels,
    begins: Places,
    outset_px: float,
    least_px: float,
    longest_px: int,
) -> Array:
    """Walk from all starts, and keep what has four sides."""
    corners = np.empty((len(begins), 4, 2))
    count = 0
    walked = np.empty((longest_px, 3), np.int32)
    pixels, width = mask.reshape(-1), mask.shape[1]
    table = steps(width)
    for start in begins:
        cracks = walked[: walk(pixels, width, table, start, walked)]
        if len(cracks) >= 3 * least_px and _may_be_a_square(cracks, least_px):
            square = _four_sided(cracks, grey, levels, outset_px, corners[count])
            count += square and _least_side(corners[count]) >= least_px
    return corners[:count]


@njit(cache=True, nogil=True)
def _may_be_a_square(cracks: Places, least_px: float) -> bool:
    """Say whether an outline is large and wide enough, and goes around without much detour."""
    left, top = right, bottom = cracks[0, 0], cracks[0, 1]
    for i in range(len(cracks)):
        left, right = min(left, cracks[i, 0]), max(right, cracks[i, 0])
        bottom = max(bottom, cracks[i, 1])
    width, height = right - left + 1, bottom - top + 1
    longer, shorter = max(width, height), min(width, height)
    wide = longer >= least_px and shorter >= max(_FLATTEST * longer, 0.5 * least_px)
    return wide and len(cracks) <= _detour_px(width + height)


@njit(cache=True, nogil=True)
def _four_sided(
    cracks: Places, grey: GreyPixels, levels: GreyPixels, outset_px: float, corners: Array
) -> bool:
    """Write an outline's corners; say whether it has four sides. Most are told by few points."""
    indices = np.empty(5, np.int64)
    every = max(1, len(cracks) // _COARSE_POINTS)
    coarse = np.empty((len(cracks) // every, 2))
    midway(cracks, every, coarse)
    if not far_points(coarse, _STEPS_PX, indices):
        return False
    points = np.empty((len(cracks), 2))
    if levels.size:
        at_level(cracks, grey, levels, points)
    else:
        midway(cracks, 1, points)
    return far_points(points, 0.0, indices) and four_corners(points, indices, outset_px, corners)


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

"""One look at an image: its dark squares by one idea of what is dark."""

from dataclasses import dataclass

import cv2
import numpy as np
from numba import njit

from tagmetry.detect.segment.components import joined, likely
from tagmetry.detect.segment.corners import four_corners
from tagmetry.detect.segment.mask import dark_mask
from tagmetry.detect.segment.outline import outline, outline_length
from tagmetry.detect.segment.runs import Int32s, runs
from tagmetry.detect.segment.tiles import levels, noise_gate, tile_extremes
from tagmetry.geometry.arrays import Array, GreyPixels

_DETOUR = 1.5  # an outline's length by the way around its box, which is 1 for convex shapes
_DETOUR_PX = 16
_PIXELS_PER_RUN = 16  # an image of more runs is taken for noise, and its gate raised
_COARSER = 1.6
_MOST_GATE = 255.0


@dataclass(frozen=True)
class Look:
    """One idea of what is dark.

    Attributes:
        share: What lies below this share of the way from the darkest to the brightest around. A
            low one parts a marker from dim clutter, a high one closes faint borders.
        thinned: Dark areas are thinned by a pixel, which parts squares that touch at corners.
    """

    share: float = 0.5
    thinned: bool = False


@dataclass(frozen=True, eq=False)
class Tiled:
    """An image with what its looks share.

    Attributes:
        grey: Shape (h, w), both at least 4.
        darkest: Of each tile.
        brightest: Of each tile.
        gate: The least difference of grey values that is not noise.
    """

    grey: GreyPixels
    darkest: GreyPixels
    brightest: GreyPixels
    gate: float

    @classmethod
    def of(cls, grey: GreyPixels) -> "Tiled":
        """Return an image cut into tiles."""
        darkest, brightest = tile_extremes(grey)
        return cls(grey, darkest, brightest, noise_gate(darkest, brightest))


def dark_squares(image: Tiled, look: Look, least_px: float) -> Array:
    """Return the corners of dark squares, clockwise as seen, shape (n, 4, 2).

    Args:
        image: Cut into tiles.
        look: What is dark.
        least_px: Sides shorter than this are passed over.
    """
    gate = image.gate
    while gate <= _MOST_GATE:
        level = levels(image.darkest, image.brightest, gate, look.share)
        mask = dark_mask(image.grey, level)
        if look.thinned:
            mask = np.asarray(cv2.erode(mask, np.ones((3, 3), np.uint8)), dtype=np.uint8)
        found = runs(mask, max(1000, mask.size // _PIXELS_PER_RUN))
        if found is not None:
            boxes = likely(*found, joined(*found), least_px)
            crossings = np.empty((0, 0), np.uint8) if look.thinned else level
            outset_px = 1.0 if look.thinned else 0.0
            return _outlined(mask, image.grey, crossings, boxes, outset_px, least_px)
        gate *= _COARSER
    return np.empty((0, 4, 2))


@njit(cache=True, nogil=True)
def _outlined(
    mask: GreyPixels,
    grey: GreyPixels,
    level: GreyPixels,
    boxes: Int32s,
    outset_px: float,
    least_px: float,
) -> Array:
    """Walk around components, boxes (n, 4) as `likely` gives them, and keep those of four sides."""
    corners = np.empty((len(boxes), 4, 2))
    count = 0
    for i in range(len(boxes)):
        start = (boxes[i, 0], boxes[i, 1])
        around_px = 2 * (boxes[i, 2] + boxes[i, 3])
        length = outline_length(mask, start, int(_DETOUR * around_px) + _DETOUR_PX)
        if length:
            points = np.empty((length, 2))
            outline(mask, grey, level, start, points)
            square = four_corners(points, outset_px, corners[count])
            count += square and _least_side(corners[count]) >= least_px
    return corners[:count]


@njit(cache=True, nogil=True)
def _least_side(corners: Array) -> float:
    least = np.inf
    for k in range(4):
        side_x = corners[k, 0] - corners[k - 1, 0]
        side_y = corners[k, 1] - corners[k - 1, 1]
        least = min(least, np.hypot(side_x, side_y))
    return least

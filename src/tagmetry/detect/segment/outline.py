"""The outline of a component: the way around it along the cracks between dark and bright pixels.

A crack is the border between a dark pixel and one of its four neighbours that is not. The walk goes
clockwise as seen, the dark on its right hand. On each crack the outline's point is where the grey
values, taken to change linearly between the two pixels, pass the level: far finer than a pixel.
"""

import numpy as np
from numba import njit

from tagmetry.detect.segment.mask import RIM_PX
from tagmetry.detect.segment.tiles import TILE_PX
from tagmetry.geometry.arrays import Array, GreyPixels

_AHEAD = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])  # above, right of, below, left of a pixel
_OUT = np.array([[0, -1], [1, 0], [0, 1], [-1, 0]])


@njit(cache=True, nogil=True)
def outline_length(mask: GreyPixels, start: tuple[int, int], most: int) -> int:
    """Return the number of cracks around a component; 0 when they are more than `most`.

    Args:
        mask: Zeros and ones with a rim of zeros.
        start: Column and row in the mask of the component's first pixel in reading order.
        most: The longest way that is worth walking.
    """
    x, y, side = start[0], start[1], 0
    for count in range(1, most + 1):
        x, y, side = _next(mask, x, y, side)
        if x == start[0] and y == start[1] and side == 0:
            return count
    return 0


@njit(cache=True, nogil=True)
def outline(
    mask: GreyPixels,
    grey: GreyPixels,
    levels: GreyPixels,
    start: tuple[int, int],
    points: Array,
) -> None:
    """Fill `points` with a component's outline.

    Args:
        mask: Zeros and ones with a rim of zeros.
        grey: The image that the mask was made of, shape (h, w).
        levels: Below which each tile's pixels are dark; of size 0 when points are to stand midway.
        start: Column and row in the mask of the component's first pixel in reading order.
        points: For the result, pixels of the image, shape (outline_length, 2).
    """
    x, y, side = start[0], start[1], 0
    for i in range(len(points)):
        out_x, out_y = _OUT[side]
        share = 0.5
        if levels.size:
            share = _crossing(grey, levels, x - RIM_PX, y - RIM_PX, out_x, out_y)
        points[i, 0] = x - RIM_PX + share * out_x
        points[i, 1] = y - RIM_PX + share * out_y
        x, y, side = _next(mask, x, y, side)


@njit(cache=True, nogil=True)
def _next(mask: GreyPixels, x: int, y: int, side: int) -> tuple[int, int, int]:
    """Return the crack after this one: the dark pixel and which of its sides."""
    ahead_x, ahead_y = x + _AHEAD[side, 0], y + _AHEAD[side, 1]
    left_x, left_y = ahead_x + _OUT[side, 0], ahead_y + _OUT[side, 1]
    ahead, left = mask[ahead_y, ahead_x] != 0, mask[left_y, left_x] != 0
    if left and ahead:
        return left_x, left_y, (side + 3) % 4
    if ahead:
        return ahead_x, ahead_y, side
    return x, y, (side + 1) % 4


@njit(cache=True, nogil=True)
def _crossing(
    grey: GreyPixels, levels: GreyPixels, x: int, y: int, out_x: int, out_y: int
) -> float:
    """Return how far from a dark pixel to its neighbour the level is passed, 0 to 1."""
    beside_x, beside_y = x + out_x, y + out_y
    if not (0 <= beside_x < grey.shape[1] and 0 <= beside_y < grey.shape[0]):
        return 0.5
    dark, bright = float(grey[y, x]), float(grey[beside_y, beside_x])
    if bright <= dark:
        return 0.5
    level = levels[y // TILE_PX, x // TILE_PX] - 0.5
    return float(min(max((level - dark) / (bright - dark), 0.0), 1.0))

"""The outline of a dark area: the way around it along the cracks between dark and bright pixels.

A crack is the border between a dark pixel and one of its four neighbours that is not. The walk goes
clockwise as seen, the dark on its right hand. Where the outline passes a crack is told by the grey
values, taken to change linearly between the two pixels: far finer than a pixel.
"""

from numba import njit

from tagmetry.detect.segment.mask import RIM_PX
from tagmetry.detect.segment.starts import Places
from tagmetry.detect.segment.tiles import TILE_PX
from tagmetry.geometry.arrays import Array, GreyPixels

_ABOVE = 0  # sides of a pixel, as the walk meets them: above, right, below, left
_AHEAD_X, _AHEAD_Y = (1, 0, -1, 0), (0, 1, 0, -1)
_OUT_X, _OUT_Y = (0, 1, 0, -1), (-1, 0, 1, 0)
_WALKED = 2  # mark in the mask of a pixel whose upper crack was walked


@njit(cache=True, nogil=True)
def walk(mask: GreyPixels, start: Places, cracks: Places) -> int:
    """Walk around a dark area, write its cracks and return how many they are.

    The walk is given up, with 0, as soon as it meets what shows that the outline begins elsewhere:
    a pixel earlier in reading order, or one that was walked before. So no crack is walked much more
    than once, whatever the image holds.

    Args:
        mask: Zeros and ones with a rim of zeros; pixels are marked in it.
        start: Column and row in the mask of the area's first pixel in reading order.
        cracks: For the result, column and row in the mask of the dark pixel and which of its sides,
            shape (the longest way that is worth walking, 3).
    """
    x, y, side = start[0], start[1], _ABOVE
    for count in range(len(cracks)):
        if side == _ABOVE:
            if count and x == start[0] and y == start[1]:
                return count
            if y < start[1] or (y == start[1] and x < start[0]) or mask[y, x] & _WALKED:
                return 0
            mask[y, x] |= _WALKED
        cracks[count, 0], cracks[count, 1], cracks[count, 2] = x, y, side
        ahead_x, ahead_y = x + _AHEAD_X[side], y + _AHEAD_Y[side]
        left_x, left_y = ahead_x + _OUT_X[side], ahead_y + _OUT_Y[side]
        if not mask[ahead_y, ahead_x]:
            side = (side + 1) % 4
        elif mask[left_y, left_x]:
            x, y, side = left_x, left_y, (side + 3) % 4
        else:
            x, y = ahead_x, ahead_y
    return 0


@njit(cache=True, nogil=True)
def midway(cracks: Places, every: int, points: Array) -> None:
    """Fill `points` with the middles of one in `every` cracks (n, 3), pixels of the image."""
    for i in range(len(points)):
        x, y, side = cracks[i * every]
        points[i, 0] = x - RIM_PX + 0.5 * _OUT_X[side]
        points[i, 1] = y - RIM_PX + 0.5 * _OUT_Y[side]


@njit(cache=True, nogil=True)
def at_level(cracks: Places, grey: GreyPixels, levels: GreyPixels, points: Array) -> None:
    """Fill `points` with the places where the image passes the level on its way across each crack.

    Args:
        cracks: As `walk` gives them, shape (n, 3).
        grey: The image that the mask was made of, shape (h, w).
        levels: Below which each tile's pixels are dark.
        points: For the result, pixels of the image, shape (n, 2).
    """
    for i in range(len(cracks)):
        x, y, side = cracks[i, 0] - RIM_PX, cracks[i, 1] - RIM_PX, cracks[i, 2]
        out_x, out_y = _OUT_X[side], _OUT_Y[side]
        share = _crossing(grey, levels, x, y, out_x, out_y)
        points[i, 0] = x + share * out_x
        points[i, 1] = y + share * out_y


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

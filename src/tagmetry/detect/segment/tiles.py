"""What counts as dark, tile by tile.

The image is cut into tiles of 4 x 4 pixels. Dark is what lies below a share of the way from the
darkest to the brightest value of a tile and its eight neighbours. Where these differ by less than a
gate, the tile is plain: it goes by the tiles farther around, which fill the inside of wide borders.
Where these differ little too, nothing in it is dark.

The gate follows the noise: a good part of most images is plain, so a low quantile of the tiles' own
ranges tells how far noise alone takes them.
"""

import cv2
import numpy as np
from numba import njit

from tagmetry.geometry.arrays import GreyPixels

TILE_PX = 4
_NEAR_TILES, _WIDE_TILES = 3, 9  # how many tiles across are around a tile
_WIDE_GATE = 1.6  # noise reaches farther within many tiles
_LEAST_GATE = 10.0  # grey values
_PLAIN_SHARE = 0.25  # of the tiles are taken to show nothing but noise
_NOISE_REACH = 2.4  # ranges of nine tiles of noise are hardly ever more times that of one


def levels(
    darkest: GreyPixels, brightest: GreyPixels, gate: float, share: float = 0.5
) -> GreyPixels:
    """Return the grey value of each tile below which its pixels are dark; 0 in plain tiles.

    Args:
        darkest: Of each tile, shape (rows, columns).
        brightest: Of each tile.
        gate: The least difference, grey values.
        share: Where between darkest and brightest the level lies, 0 to 1.
    """
    near = _levels(darkest, brightest, gate, share, _NEAR_TILES)
    wide = _levels(darkest, brightest, _WIDE_GATE * gate, share, _WIDE_TILES)
    return np.where(near == 0, wide, near)


def _levels(
    darkest: GreyPixels, brightest: GreyPixels, gate: float, share: float, tiles: int
) -> GreyPixels:
    """Return the levels by the tiles around, a square of `tiles` by `tiles`."""
    around = np.ones((tiles, tiles), np.uint8)
    low, high = cv2.erode(darkest, around), cv2.dilate(brightest, around)
    between = cv2.addWeighted(low, 1 - share, high, share, 0.5)
    clear = cv2.compare(cv2.subtract(high, low), np.ceil(gate), cv2.CMP_GE)
    return np.asarray(cv2.bitwise_and(between, clear), dtype=np.uint8)


def noise_gate(darkest: GreyPixels, brightest: GreyPixels) -> float:
    """Return the difference of grey values that noise alone does not reach within nine tiles."""
    ranges = np.bincount((brightest - darkest).ravel(), minlength=256)
    plain = int(np.searchsorted(np.cumsum(ranges), _PLAIN_SHARE * darkest.size))
    return max(_LEAST_GATE, _NOISE_REACH * plain)


@njit(cache=True, nogil=True)
def tile_extremes(grey: GreyPixels) -> tuple[GreyPixels, GreyPixels]:
    """Return the darkest and the brightest value of each tile, shapes (rows, columns).

    The last tiles are moved inward where the image is no multiple of a tile.

    Args:
        grey: Shape (h, w), both at least 4.
    """
    height, width = grey.shape
    rows, columns = -(-height // TILE_PX), -(-width // TILE_PX)
    darkest = np.empty((rows, columns), np.uint8)
    brightest = np.empty((rows, columns), np.uint8)
    low, high = np.empty(width, np.uint8), np.empty(width, np.uint8)
    for row in range(rows):
        top = min(TILE_PX * row, height - TILE_PX)
        a, b, c, d = grey[top], grey[top + 1], grey[top + 2], grey[top + 3]
        for x in range(width):
            low[x] = min(a[x], b[x], c[x], d[x])
            high[x] = max(a[x], b[x], c[x], d[x])
        _of_fours(low, high, darkest[row], brightest[row])
    return darkest, brightest


@njit(cache=True, nogil=True)
def _of_fours(
    low: GreyPixels, high: GreyPixels, darkest: GreyPixels, brightest: GreyPixels
) -> None:
    """Fill a row of tiles from the extremes (w,) of its columns of pixels."""
    last = low.size - TILE_PX
    for column in range(darkest.size):
        x = min(TILE_PX * column, last)
        darkest[column] = min(low[x], low[x + 1], low[x + 2], low[x + 3])
        brightest[column] = max(high[x], high[x + 1], high[x + 2], high[x + 3])

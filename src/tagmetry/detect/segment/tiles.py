"""What counts as dark, tile by tile.

The image is cut into tiles of 4 x 4 pixels. Dark is what lies below a share of the way from the
darkest to the brightest value of a tile and its eight neighbours. Where these differ by less than a
gate, the tile is plain: it goes by the tiles farther around, which fill the inside of wide borders.
Where these differ little too, nothing in it is dark.

The gate follows the noise: a good part of most images is plain, so a low quantile of the tiles' own
ranges tells how far noise alone takes them.
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numba import njit

from tagmetry.geometry.arrays import GreyPixels

TILE_PX = 4
_NEAR_TILES, _WIDE_TILES = 3, 9  # how many tiles across are around a tile
_WIDE_GATE = 1.6  # noise reaches farther within many tiles
_LEAST_GATE = 10.0  # grey values
_MOST_GATE = 140.0  # where markers fill the image, no tile shows noise alone
_PLAIN_SHARE = 0.25  # of the tiles are taken to show nothing but noise
_TILES_ASKED = 20_000  # how many tell enough about noise
_WHOLE_BITS = 8
_WHOLE = 1 << _WHOLE_BITS  # shares of a range are whole parts of this
_NOISE_REACH = 2.4  # ranges of nine tiles of noise are hardly ever more times that of one


@dataclass(frozen=True, eq=False)
class Extremes:
    """The darkest and the brightest value around each tile, shapes (rows, columns)."""

    darkest: GreyPixels
    brightest: GreyPixels

    @property
    def ranges(self) -> GreyPixels:
        """How far they are apart."""
        return np.asarray(cv2.subtract(self.brightest, self.darkest), dtype=np.uint8)

    def around(self, tiles: int) -> "Extremes":
        """Return the extremes of squares of `tiles` by `tiles` around each tile."""
        square = np.ones((tiles, tiles), np.uint8)
        low, high = cv2.erode(self.darkest, square), cv2.dilate(self.brightest, square)
        return Extremes(np.asarray(low, dtype=np.uint8), np.asarray(high, dtype=np.uint8))


@dataclass(frozen=True, eq=False)
class Tiles:
    """What is around each tile of an image.

    Attributes:
        near: The extremes of the tile and its neighbours.
        wide: The extremes of the tiles farther around.
        gate: The least difference of grey values that is not noise.
    """

    near: Extremes
    wide: Extremes
    gate: float

    @classmethod
    def of(cls, grey: GreyPixels) -> "Tiles":
        """Cut an image (h, w), both at least 4, into tiles."""
        own = Extremes(*tile_extremes(grey))
        return cls(own.around(_NEAR_TILES), own.around(_WIDE_TILES), noise_gate(own))

    def levels(self, share: float, gate: float) -> GreyPixels:
        """Return the grey value of each tile below which its pixels are dark; 0 in plain tiles.

        Args:
            share: Where between darkest and brightest the level lies, 0 to 1.
            gate: The least difference, grey values.
        """
        near, wide = self.near, self.wide
        extremes = near.darkest, near.brightest, wide.darkest, wide.brightest
        return _levels(*extremes, round(_WHOLE * share), gate, _WIDE_GATE * gate)


@njit(cache=True, nogil=True)
def _levels(
    darkest: GreyPixels,
    brightest: GreyPixels,
    wide_darkest: GreyPixels,
    wide_brightest: GreyPixels,
    share: int,
    gate: float,
    wide_gate: float,
) -> GreyPixels:
    """Return the levels by the extremes around each tile, or by those farther around."""
    levels = np.empty_like(darkest)
    least, wide_least = np.uint8(np.ceil(gate)), np.uint8(min(np.ceil(wide_gate), 255))
    for row in range(len(levels)):
        near, wide = (darkest[row], brightest[row]), (wide_darkest[row], wide_brightest[row])
        for i in range(levels.shape[1]):
            level, wide_level = _level(near, i, share, least), _level(wide, i, share, wide_least)
            levels[row, i] = level or wide_level
    return levels


@njit(cache=True, nogil=True)
def _level(
    extremes: tuple[GreyPixels, GreyPixels], i: int, share: int, least: np.uint8
) -> np.uint8:
    """Return what lies just above a share of a range, or 0 where that is less than it has to be.

    Numbers of eight bits are many to a word: 130,000 tiles take half as long.
    """
    apart = np.uint8(extremes[1][i] - extremes[0][i])
    level = np.uint8(extremes[0][i] + np.uint8(share * apart >> _WHOLE_BITS) + 1)
    return level if apart >= least else np.uint8(0)


def noise_gate(own: Extremes) -> float:
    """Return the difference of grey values that noise alone does not reach within nine tiles."""
    asked = own.ranges[:: 1 + own.darkest.size // _TILES_ASKED]
    ranges = cv2.calcHist([asked], [0], None, [256], [0, 256]).ravel()
    plain = int(np.searchsorted(np.cumsum(ranges, dtype=np.int64), _PLAIN_SHARE * asked.size))
    return min(max(_LEAST_GATE, _NOISE_REACH * plain), _MOST_GATE)


@njit(cache=True, nogil=True)
def tile_extremes(grey: GreyPixels) -> tuple[GreyPixels, GreyPixels]:
    """Return the darkest and the brightest value of each tile, shapes (rows, columns).

    Where the image is no multiple of a tile, the last row of tiles is moved inward, and its last
    column of pixels counts again.

    Args:
        grey: Shape (h, w), both at least 4.
    """
    height, width = grey.shape
    rows, columns = -(-height // TILE_PX), -(-width // TILE_PX)
    darkest = np.empty((rows, columns), np.uint8)
    brightest = np.empty((rows, columns), np.uint8)
    low, high = np.empty(TILE_PX * columns, np.uint8), np.empty(TILE_PX * columns, np.uint8)
    for row in range(rows):
        top = min(TILE_PX * row, height - TILE_PX)
        a, b, c, d = grey[top], grey[top + 1], grey[top + 2], grey[top + 3]
        for x in range(width):
            low[x] = min(a[x], b[x], c[x], d[x])
            high[x] = max(a[x], b[x], c[x], d[x])
        low[width:], high[width:] = low[width - 1], high[width - 1]
        _of_fours(low, high, darkest[row], brightest[row])
    return darkest, brightest


@njit(cache=True, nogil=True)
def _of_fours(
    low: GreyPixels, high: GreyPixels, darkest: GreyPixels, brightest: GreyPixels
) -> None:
    """Fill a row of tiles from the extremes of its columns of pixels, four for each tile."""
    for i in range(darkest.size):
        k = TILE_PX * i
        darkest[i] = min(low[k], low[k + 1], low[k + 2], low[k + 3])
        brightest[i] = max(high[k], high[k + 1], high[k + 2], high[k + 3])

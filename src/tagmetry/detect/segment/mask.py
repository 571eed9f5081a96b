"""The mask of dark pixels, with a rim of zeros, so that nothing that walks on it leaves it."""

import numpy as np
from numba import njit

from tagmetry.detect.segment.tiles import TILE_PX
from tagmetry.geometry.arrays import GreyPixels

RIM_PX = 1


@njit(cache=True, nogil=True)
def dark_mask(grey: GreyPixels, levels: GreyPixels) -> GreyPixels:
    """Return 1 where a pixel is darker than its tile's level, else 0.

    Args:
        grey: Shape (h, w).
        levels: Of each tile, shape (ceil(h / 4), ceil(w / 4)).

    Returns:
        Shape (h + 2, m), m a multiple of 8 and at least w + 2; pixel (0, 0) stands at (1, 1).
    """
    height, width = grey.shape
    mask = np.zeros((height + 2 * RIM_PX, -(-(width + 2 * RIM_PX) // 8) * 8), np.uint8)
    level = np.empty(TILE_PX * levels.shape[1], np.uint8)
    for row in range(height):
        if row % TILE_PX == 0:
            for column in range(level.size):
                level[column] = levels[row // TILE_PX, column // TILE_PX]
        here, into = grey[row], mask[row + RIM_PX, RIM_PX:]
        for x in range(width):
            into[x] = here[x] < level[x]
    return mask

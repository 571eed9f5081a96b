"""How squares read in a layout, one after another in a kernel: frame first, then bits and outline.

What is looked at where is `Spots`; what it is good for, `decode` says.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tagmetry.detect.reading.sample import cell_means_of, steps_of
from tagmetry.geometry.arrays import Array, GreyPixels, IntArray

LEAST_CONTRAST = 8.0  # grey values between black and white
BORDER_ERRORS = 0.2  # share of frame cells that may read wrong
_EDGE_CELLS = 0.3  # how far inside and outside a side the image must differ
_SHARPEN = 0.25  # share of the difference to each neighbour that is added


class Spots(NamedTuple):
    """Where a layout's cells are read, and what their values are weighed with.

    Attributes:
        reach: How far beside and above a cell's centre its four taps are, sides of the square.
        black: Centres of cells that are black on all markers, shape (b, 2), units of the side.
        white: Places that are white on all markers, shape (w, 2).
        bits: Centres of the cells with a bit, shape (k, 2).
        black_plane: Takes the values at black ones to a plane through them, shape (3, b).
        white_plane: The same of the white ones, shape (3, w).
        plane_terms: Takes a plane to its values at frame and bits, shape (f + k, 3).
        beside: Which cells of frame and bits touch each bit's sides, shape (k, 4); the bit itself
            where that is none of them.
        frame: How many of black and white are cells of the marker, f.
        side_cells: Along a side.
        step_up: 1 where it is brighter outside of the sides, else -1.
    """

    reach: float
    black: Array
    white: Array
    bits: Array
    black_plane: Array
    white_plane: Array
    plane_terms: Array
    beside: IntArray
    frame: int
    side_cells: float
    step_up: float


@njit(cache=True, nogil=True, error_model="numpy")
def read_each(
    grey: GreyPixels, corners_px: Array, H: Array, spots: Spots, margins: Array, measures: Array
) -> None:
    """Write how n squares read; of those without a border no bits and no outlines.

    Args:
        grey: 8-bit image.
        corners_px: Shape (n, 4, 2).
        H: From the unit square to pixels, shape (n, 3, 3).
        spots: Where to look.
        margins: For the result: those of the bits, shape (n, k).
        measures: For the result: border share, contrast, border margin, sharp outline, outline,
            shape (n, 5).
    """
    cells, middle = np.empty(len(spots.plane_terms)), np.empty(len(spots.plane_terms))
    for i in range(len(H)):
        measures[i, 1] = _contrast(grey, H[i], spots, cells, middle)
        half = measures[i, 1] / 2
        measures[i, 0], measures[i, 2] = _border(cells, middle, half, spots)
        if measures[i, 0] >= 1 - BORDER_ERRORS:
            _write_bits(grey, H[i], spots, cells, middle, half, margins[i])
            _write_outline(grey, corners_px[i], spots, half, measures[i, 3:])


@njit(cache=True, nogil=True)
def _contrast(grey: GreyPixels, H: Array, spots: Spots, cells: Array, middle: Array) -> float:
    """Write the frame's values and what is midway everywhere; return white minus black or NaN."""
    black = cell_means_of(grey, H, spots.black, spots.reach)
    white = cell_means_of(grey, H, spots.white, spots.reach)
    dark, bright = spots.black_plane @ black, spots.white_plane @ white
    middle[:] = spots.plane_terms @ ((dark + bright) / 2)
    contrast = (spots.plane_terms @ (bright - dark)).mean()
    for k in range(spots.frame):
        cells[k] = black[k] if k < black.size else white[k - black.size]
    return contrast if abs(contrast) >= LEAST_CONTRAST else np.nan


@njit(cache=True, nogil=True)
def _border(cells: Array, middle: Array, half: float, spots: Spots) -> tuple[float, float]:
    """Turn the frame's values to margins; return the share of right ones and their mean."""
    right, clear = 0, 0.0
    for k in range(spots.frame):
        cells[k] = (cells[k] - middle[k]) / half
        as_printed = -cells[k] if k < len(spots.black) else cells[k]
        right += as_printed > 0
        clear += min(max(as_printed, -1.0), 1.0)
    return right / spots.frame, clear / spots.frame


@njit(cache=True, nogil=True)
def _write_bits(
    grey: GreyPixels,
    H: Array,
    spots: Spots,
    cells: Array,
    middle: Array,
    half: float,
    margins: Array,
) -> None:
    """Write how clearly each bit reads as white, sharpened against the cells beside it."""
    values = cell_means_of(grey, H, spots.bits, spots.reach)
    for k in range(values.size):
        cells[spots.frame + k] = (values[k] - middle[spots.frame + k]) / half
    for k in range(values.size):
        own = cells[spots.frame + k]
        margins[k] = own
        for near in spots.beside[k]:
            margins[k] += _SHARPEN * (own - cells[near])


@njit(cache=True, nogil=True)
def _write_outline(
    grey: GreyPixels, square_px: Array, spots: Spots, half: float, clearness: Array
) -> None:
    """Write how clearly the image steps across a square's sides, within a pixel and a cell."""
    around_px = 0.0
    for side in range(4):
        along = square_px[side] - square_px[side - 1]
        around_px += np.sqrt(along[0] ** 2 + along[1] ** 2)
    reaches_px = (1.0, _EDGE_CELLS * around_px / 4 / spots.side_cells)
    for k in range(2):
        total, steps = 0.0, steps_of(grey, square_px, reaches_px[k])
        for step in steps:
            total += min(max(spots.step_up * step / (2 * half), 0.0), 1.0)
        clearness[k] = total / steps.size

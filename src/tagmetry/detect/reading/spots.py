"""How squares read in a layout, one after another in a kernel: frame first, then bits and outline.

What is looked at where is `Spots`; what it is good for, `decode` says.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from tagmetry.detect.reading.sample import (
    STEPS,
    Narrow,
    Room,
    new_room,
    write_means,
    write_square_to_quad,
    write_steps,
)
from tagmetry.geometry.arrays import Array, GreyPixels, IntArray

LEAST_CONTRAST = 8.0  # grey values between black and white
BORDER_ERRORS = 0.2  # share of frame cells that may read wrong
LEAST_OUTLINE = 0.3  # share of the contrast by which the image must step across the sides
_EDGE_CELLS = 0.3  # how far inside and outside a side the image must differ
_SHARPEN = 0.25  # share of the difference to each neighbour that is added


class Spots(NamedTuple):
    """Where a layout's cells are read, and what their values are weighed with.

    Attributes:
        frame_taps: Four places around the centres of cells that are black on all markers, b, then
            around places that are white on all, w; units of the side, shape (2, 4 (b + w)).
        bit_taps: The same around the centres of the cells with a bit, shape (2, 4 k).
        black_plane: Takes the values at black ones to a plane through them, shape (b, 3).
        white_plane: The same of the white ones, shape (w, 3).
        plane_terms: Takes a plane to its values at frame and bits, shape (f + k, 3).
        mean_terms: Takes it to the mean of these, shape (3,).
        beside: Which cells of frame and bits touch each bit's sides, shape (k, 4); the bit itself
            where that is none of them.
        frame: How many of black and white are cells of the marker, f.
        side_cells: Along a side.
        step_up: 1 where it is brighter outside of the sides, else -1.
    """

    frame_taps: Narrow
    bit_taps: Narrow
    black_plane: Array
    white_plane: Array
    plane_terms: Array
    mean_terms: Array
    beside: IntArray
    frame: int
    side_cells: float
    step_up: float


class _Desk(NamedTuple):
    """What is worked on for one square.

    Attributes:
        room: For places to look up.
        H: From the unit square to pixels, shape (3, 3).
        seen: Values of frame, shape (b + w,).
        cells: How clearly frame and bits are white, shape (f + k,).
        middle: What is midway between black and white at frame and bits, shape (f + k,).
        steps: Across the sides, shape (40,).
    """

    room: Room
    H: Array
    seen: Array
    cells: Array
    middle: Array
    steps: Array


@njit(cache=True, nogil=True, error_model="numpy")
def read_each(
    grey: GreyPixels, corners_px: Array, spots: Spots, margins: Array, measures: Array
) -> None:
    """Write how n squares read; of those without a border no bits and no outlines.

    Args:
        grey: 8-bit image.
        corners_px: Shape (n, 4, 2).
        spots: Where to look.
        margins: For the result: those of the bits, shape (n, k).
        measures: For the result: border share, contrast, border margin, sharp outline, outline,
            shape (n, 5).
    """
    desk = _new_desk(spots)
    for i in range(len(corners_px)):
        write_square_to_quad(corners_px[i], desk.H)
        write_means(grey, desk.H, spots.frame_taps, desk.room, desk.seen)
        measures[i, 1] = _level(desk, spots)
        half = measures[i, 1] / 2
        measures[i, 0], measures[i, 2] = _border(desk, half, spots)
        if measures[i, 0] >= 1 - BORDER_ERRORS:
            write_means(grey, desk.H, spots.bit_taps, desk.room, desk.cells[spots.frame :])
            _write_bits(desk, half, spots, margins[i])
            _write_outline(grey, corners_px[i], desk, half, spots, measures[i, 3:])


@njit(cache=True, nogil=True)
def _new_desk(spots: Spots) -> _Desk:
    places = max(spots.frame_taps.shape[1], spots.bit_taps.shape[1], 2 * STEPS)
    seen = np.empty(len(spots.black_plane) + len(spots.white_plane))
    cells, middle = np.empty(len(spots.plane_terms)), np.empty(len(spots.plane_terms))
    return _Desk(new_room(places), np.empty((3, 3)), seen, cells, middle, np.empty(STEPS))


@njit(cache=True, nogil=True)
def _level(desk: _Desk, spots: Spots) -> float:
    """Write what is midway between black and white; return white minus black, NaN if too little."""
    seen, middle, terms, mean = desk.seen, desk.middle, spots.plane_terms, spots.mean_terms
    black = _plane(seen, spots.black_plane)
    white = _plane(seen[len(spots.black_plane) :], spots.white_plane)
    a, b, c = (black[0] + white[0]) / 2, (black[1] + white[1]) / 2, (black[2] + white[2]) / 2
    for k in range(middle.size):
        middle[k] = a * terms[k, 0] + b * terms[k, 1] + c * terms[k, 2]
    contrast = 0.0
    for t in range(3):
        contrast += (white[t] - black[t]) * mean[t]
    return contrast if abs(contrast) >= LEAST_CONTRAST else np.nan


@njit(cache=True, nogil=True)
def _plane(values: Array, to_plane: Array) -> tuple[float, float, float]:
    """Return the plane through the first values."""
    a, b, c = 0.0, 0.0, 0.0
    for k in range(len(to_plane)):
        a += to_plane[k, 0] * values[k]
        b += to_plane[k, 1] * values[k]
        c += to_plane[k, 2] * values[k]
    return a, b, c


@njit(cache=True, nogil=True)
def _border(desk: _Desk, half: float, spots: Spots) -> tuple[float, float]:
    """Turn the frame's values to margins; return the share of right ones and their mean."""
    right, clear, black = 0, 0.0, len(spots.black_plane)
    for k in range(spots.frame):
        desk.cells[k] = (desk.seen[k] - desk.middle[k]) / half
        as_printed = -desk.cells[k] if k < black else desk.cells[k]
        right += as_printed > 0
        clear += min(max(as_printed, -1.0), 1.0)
    return right / spots.frame, clear / spots.frame


@njit(cache=True, nogil=True)
def _write_bits(desk: _Desk, half: float, spots: Spots, margins: Array) -> None:
    """Write how clearly each bit reads as white, sharpened against the cells beside it."""
    cells, first = desk.cells, spots.frame
    for k in range(margins.size):
        cells[first + k] = (cells[first + k] - desk.middle[first + k]) / half
    for k in range(margins.size):
        own = cells[first + k]
        margins[k] = own
        for side in range(4):
            margins[k] += _SHARPEN * (own - cells[spots.beside[k, side]])


@njit(cache=True, nogil=True)
def _write_outline(
    grey: GreyPixels, square_px: Array, desk: _Desk, half: float, spots: Spots, outlines: Array
) -> None:
    """Write how clearly the image steps across a square's sides, within a pixel and a cell.

    Where it does within a pixel, the cell is not looked at.
    """
    around_px = 0.0
    for side in range(4):
        x = square_px[side, 0] - square_px[side - 1, 0]
        y = square_px[side, 1] - square_px[side - 1, 1]
        around_px += np.sqrt(x**2 + y**2)
    outlines[0] = outlines[1] = _clearness(grey, square_px, 1.0, desk, half * spots.step_up)
    if outlines[0] < LEAST_OUTLINE:
        reach_px = _EDGE_CELLS * around_px / 4 / spots.side_cells
        outlines[1] = _clearness(grey, square_px, reach_px, desk, half * spots.step_up)


@njit(cache=True, nogil=True)
def _clearness(
    grey: GreyPixels, square_px: Array, reach_px: float, desk: _Desk, half: float
) -> float:
    """Return the mean step across the sides as a share of all the contrast, 0 to 1 each."""
    write_steps(grey, square_px, reach_px, desk.room, desk.steps)
    share, total = 0.5 / half, 0.0
    for step in desk.steps:
        total += min(max(share * step, 0.0), 1.0)
    return total / desk.steps.size

"""Find a chessboard: OpenCV's finders say about where, the fit of each corner says exactly where.

The finders see whole boards only. Corners are counted as the board counts them, the top left square
black. A board whose columns and rows add up to an odd number has one such way; an even one looks
the same upside down (a square one with even counts even on its side), and then rows run to the
picture's right.
"""

from collections.abc import Iterator

import cv2
import numpy as np

from tagmetry.calibrate.targets.corners import Guesses, refined
from tagmetry.calibrate.targets.found import Found, NotFound
from tagmetry.calibrate.targets.order import in_board_order
from tagmetry.calibrate.targets.squares import (
    first_is_black,
    is_even,
    share_alternating,
    square_greys,
)
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels, GreyPixels
from tagmetry.markers import Chessboard

_SMALL_PX = 1100  # long side of the picture in which a board is looked for first
_LARGE_PX = 4500
_SMALLEST_PX = 24  # the finders cannot look at less
_LEAST_ALTERNATING = 0.9
_LEAST_KEPT = 0.5
_CLASSIC = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE
_SECTOR = cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_EXHAUSTIVE | cv2.CALIB_CB_ACCURACY


def find_chessboard(
    grey: GreyPixels, board: Chessboard, *, thorough: bool = True
) -> Found | NotFound:
    """Return the corners of a chessboard.

    Args:
        grey: 8-bit image, shape (height, width).
        board: What to look for.
        thorough: Try the slow finder where the quick one sees nothing.
    """
    wanted = f"{board.corner_columns}x{board.corner_rows} inner corners"
    nothing = NotFound(f"no chessboard with {wanted} is seen whole")
    if min(grey.shape) < _SMALLEST_PX:
        return nothing
    for grid_px, coarse_px in _seen(grey, board, thorough=thorough):
        greys = square_greys(grey, grid_px)
        if is_even(grid_px) and share_alternating(greys) >= _LEAST_ALTERNATING:
            return _measured(grey, grid_px, coarse_px)
        nothing = NotFound(
            f"corners are seen, but not as {wanted} of one board in even rows of alternating "
            "squares",
            grid_px.reshape(-1, 2),
        )
    return nothing


def _measured(grey: GreyPixels, grid_px: Array, coarse_px: float) -> Found | NotFound:
    """Count the corners as the board does, and fit each."""
    ordered = in_board_order(grid_px, lambda one: first_is_black(square_greys(grey, one)))
    along = np.gradient(ordered, axis=1).reshape(-1, 2)
    down = np.gradient(ordered, axis=0).reshape(-1, 2)
    places_px = ordered.reshape(-1, 2)
    count = len(places_px)
    guesses = Guesses(np.arange(count), _places(*ordered.shape[:2]), places_px, along, down)
    found = refined(grey, guesses, coarse_px=coarse_px)
    if len(found.points) < _LEAST_KEPT * count:
        why = found.dropped[0].reason
        return NotFound(f"only {len(found.points)} of {count} corners are good: {why}", places_px)
    return found


def _places(rows: int, columns: int) -> Array:
    """Return x and y of corners counted from the top left, shape (n, 2), squares."""
    row, column = np.divmod(np.arange(rows * columns), columns)
    return np.stack([column, -row], axis=1).astype(np.float64)


def _seen(grey: GreyPixels, board: Chessboard, *, thorough: bool) -> Iterator[tuple[Array, float]]:
    """Give what finders see, (rows, columns, 2), good to a pixel or so of what they looked at.

    With it comes how many of the image's pixels such a pixel is.
    """
    size = (board.corner_columns, board.corner_rows)
    for picture, scale in _pictures(grey):
        found, corners = cv2.findChessboardCorners(picture, size, flags=_CLASSIC)
        if found:
            yield _full_size(corners, size, scale), scale
    if not thorough:
        return
    picture, scale = next(_pictures(grey))
    found, corners = cv2.findChessboardCornersSB(picture, size, flags=_SECTOR)
    if found:
        yield _full_size(corners, size, scale), scale


def _pictures(grey: GreyPixels) -> Iterator[tuple[GreyPixels, float]]:
    """Give the image, smaller first, each with how many pixels of the image its pixels are."""
    longest_px = max(grey.shape)
    if longest_px > _SMALL_PX:
        yield _shrunk(grey, longest_px / _SMALL_PX)
    if longest_px <= _LARGE_PX:
        yield grey, 1.0


def _shrunk(grey: GreyPixels, scale: float) -> tuple[GreyPixels, float]:
    width_px, height_px = (max(1, round(side / scale)) for side in grey.shape[::-1])
    small = cv2.resize(grey, (width_px, height_px), interpolation=cv2.INTER_AREA)
    return np.asarray(small, dtype=np.uint8), scale


def _full_size(corners: AnyPixels, size: tuple[int, int], scale: float) -> Array:
    columns, rows = size
    places = np.asarray(corners, dtype=np.float64).reshape(rows, columns, 2)
    return (places + 0.5) * scale - 0.5

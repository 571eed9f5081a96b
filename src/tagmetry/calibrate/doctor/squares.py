"""Is the chessboard the one that was asked for? Its corners are counted in the pictures."""

from collections.abc import Sequence

import numpy as np

from tagmetry.calibrate.doctor.advice import BoardAdvice
from tagmetry.calibrate.doctor.lattice import Counts, corners_as, grown, largest_lattice, voted
from tagmetry.calibrate.doctor.marked import seen_instead
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import Chessboard

_MOST, _NEARLY_ALL = 0.5, 0.8  # shares of the pictures
_FEW = 2


def check_chessboard(greys: Sequence[GreyPixels], board: Chessboard) -> list[BoardAdvice]:
    """Return what is odd about a chessboard; nothing where most pictures show it as asked for."""
    asked = (board.corner_columns, board.corner_rows)
    pairs = [(grey, corners_as(grey, asked)) for grey in greys]
    seen = [(grey, grid) for grey, grid in pairs if grid is not None]
    if len(seen) >= _MOST * len(greys):
        size, count = voted([grown(grey, grid) for grey, grid in seen])
        if sorted(size) != sorted(asked) and count > _MOST * len(seen):
            return [_part(board, size, count)]
        return _swapped(board, [grid for _, grid in seen])
    return _other_counts(greys, board, len(seen))


def _other_counts(greys: Sequence[GreyPixels], board: Chessboard, found: int) -> list[BoardAdvice]:
    """Count corners in pictures that do not show the board."""
    asked = (board.corner_columns, board.corner_rows)
    counts = [size for grey in greys if (size := largest_lattice(grey)) is not None]
    if not counts:
        return seen_instead(greys, board)
    size, votes = voted(counts)
    as_that = sum(corners_as(grey, size) is not None for grey in greys)
    if sorted(size) != sorted(asked) and as_that > found:
        return [_counted(board, _same_way(size, asked), as_that, len(greys))]
    if max(size) <= max(asked) and min(size) <= min(asked):
        return seen_instead(greys, board) or [_covered(board, counts, votes)]
    return seen_instead(greys, board)


def _counted(board: Chessboard, size: Counts, count: int, pictures: int) -> BoardAdvice:
    asked = (board.corner_columns, board.corner_rows)
    more = (asked[0] - size[0], asked[1] - size[1])
    if more == (1, 1):
        title, why = "squares counted instead of inner corners", "inner corners are one fewer"
    elif more == (-1, -1):
        title, why = "one too few in both directions", "count inner corners, not the lines between"
    else:
        title, why = "other numbers of corners", "count the inner corners"
    found = f"{_text(size)} in {count} of {pictures} pictures"
    return BoardAdvice(
        "problem", title, f"{_text(asked)} inner corners", found, why, _with(board, size)
    )


def _part(board: Chessboard, size: Counts, count: int) -> BoardAdvice:
    asked = (board.corner_columns, board.corner_rows)
    return BoardAdvice(
        "problem",
        "only a part of the board is used",
        f"{_text(asked)} inner corners",
        f"that the squares go on to {_text(size)} in {count} pictures: which part of them is "
        "found may change from picture to picture",
        "ask for the whole board",
        _with(board, _same_way(size, asked)),
    )


def _swapped(board: Chessboard, grids: Sequence[Array]) -> list[BoardAdvice]:
    """Say that boards lie on their side in nearly all pictures; they are none the worse for it."""
    asked = (board.corner_columns, board.corner_rows)
    lying = sum(map(_lies, grids))
    if asked[0] == asked[1] or lying < max(_FEW, _NEARLY_ALL * len(grids)):
        return []
    found = f"{_text(asked[::-1])} in {lying} of {len(grids)} pictures"
    harmless = (
        "it is the same board on its side, or the camera was: the camera comes out the same, and "
        "the board's x and y are as they were asked for"
    )
    instead = _with(board, asked[::-1])
    expected = f"{_text(asked)} inner corners"
    return [BoardAdvice("hint", "columns and rows swapped", expected, found, harmless, instead)]


def _lies(grid_px: Array) -> bool:
    """Return whether rows run rather down the picture than along it."""
    across, down = np.abs(np.diff(grid_px, axis=1).mean(axis=(0, 1)))
    return bool(down > across)


def _covered(board: Chessboard, counts: Sequence[Counts], votes: int) -> BoardAdvice:
    asked = (board.corner_columns, board.corner_rows)
    seen = ", ".join(sorted({_text(one) for one in counts}))
    return BoardAdvice(
        "problem",
        "board not seen whole",
        f"{_text(asked)} inner corners",
        f"{seen} in {len(counts)} pictures: it is covered or reaches out of the picture"
        + (f", or it has fewer squares ({votes} pictures agree)" if votes > 1 else ""),
        "show all of it, or take a ChArUco board, of which a part is enough",
    )


def _same_way(size: Counts, asked: Counts) -> Counts:
    """Return the counts with the longer side where it was asked for."""
    return size if (asked[0] >= asked[1]) == (size[0] >= size[1]) else size[::-1]


def _with(board: Chessboard, size: Counts) -> Chessboard:
    return Chessboard(*size, board.square_m)


def _text(counts: Counts) -> str:
    return f"{counts[0]}x{counts[1]}"

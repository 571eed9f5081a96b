"""Which of the grid's corners is the first? A finder begins where it likes.

Seen from its front a board is never mirrored, which leaves two ways to count a rectangle and four
to count a square. The board's own pattern decides between them where it can; where it looks the
same turned, the way is taken whose rows run most nearly to the picture's right.
"""

from collections.abc import Callable, Iterator

import numpy as np

from tagmetry.geometry import Array


def in_board_order(grid_px: Array, fits: Callable[[Array], bool]) -> Array:
    """Return a grid of points counted as the board counts them.

    Args:
        grid_px: Rows and columns in any order, shape (rows, columns, 2).
        fits: Whether the pattern allows a way of counting; when it allows none, all are taken as
            possible.

    Returns:
        Shape (rows, columns, 2).
    """
    facing = [grid for grid in _ways_to_count(grid_px) if handedness(grid) > 0]
    possible = [grid for grid in facing if fits(grid)] or facing or [grid_px]
    return max(possible, key=_rightward)


def handedness(grid_px: Array) -> float:
    """Return the area of the grid's mean cell, px^2; negative when it is counted mirrored."""
    along = np.diff(grid_px, axis=1).mean(axis=(0, 1))
    down = np.diff(grid_px, axis=0).mean(axis=(0, 1))
    return float(along[0] * down[1] - along[1] * down[0])


def _ways_to_count(grid_px: Array) -> Iterator[Array]:
    rows, columns = grid_px.shape[:2]
    turned = [grid_px, np.swapaxes(grid_px, 0, 1)] if rows == columns else [grid_px]
    for grid in turned:
        yield from (grid, grid[:, ::-1], grid[::-1], grid[::-1, ::-1])


def _rightward(grid_px: Array) -> float:
    along = np.diff(grid_px, axis=1).mean(axis=(0, 1))
    return float(along[0] / np.linalg.norm(along))

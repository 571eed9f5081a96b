"""All views of a board in arrays of one shape: row v is a view, column k a point of the board."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from tagmetry.calibrate.view import BoardView
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, IntArray


@dataclass(frozen=True, eq=False)
class Sightings:
    """What n views show of a board's k points.

    Attributes:
        size_px: (width, height) of the pictures.
        points: The numbers of the points that any view shows, shape (k,).
        p_board: Where the board's maker put them, shape (k, 3), metres.
        corners_px: Shape (n, k, 2); zero where a view does not show the point.
        weights: 1 / sd^2 of a corner, shape (n, k), 1 / px^2; zero where it is not to be used.
    """

    size_px: tuple[int, int]
    points: IntArray
    p_board: Array
    corners_px: Array
    weights: Array

    def __len__(self) -> int:
        """How many views."""
        return len(self.corners_px)

    @property
    def used(self) -> BoolArray:
        """Which corners count, shape (n, k)."""
        return self.weights > 0

    @property
    def corner_count(self) -> int:
        """How many corners count."""
        return int(self.used.sum())

    def only(self, views: IntArray | BoolArray) -> "Sightings":
        """Return some of the views."""
        return replace(self, corners_px=self.corners_px[views], weights=self.weights[views])

    def weighted(self, factors: Array | BoolArray) -> "Sightings":
        """Return the views with the weights multiplied by factors (n, k)."""
        return replace(self, weights=self.weights * factors)


def gather(views: Sequence[BoardView]) -> Sightings:
    """Put views of one board, of one size, in arrays.

    Raises:
        InputError: The views differ in size, or disagree on where the maker put a point.
    """
    _check_sizes(views)
    points = np.unique(np.concatenate([view.points for view in views]))
    shape = (len(views), len(points))
    corners, weights = np.zeros((*shape, 2)), np.zeros(shape)
    p_board = np.full((len(points), 3), np.nan)
    for row, view in enumerate(views):
        columns = np.searchsorted(points, view.points)
        corners[row, columns], weights[row, columns] = view.corners_px, view.sd_px**-2.0
        _check_same(p_board[columns], view)
        p_board[columns] = view.p_board
    return Sightings(views[0].size_px, points, p_board, corners, weights)


def _check_sizes(views: Sequence[BoardView]) -> None:
    for view in views:
        if view.size_px != views[0].size_px:
            (width, height), (other_width, other_height) = views[0].size_px, view.size_px
            raise InputError(
                f"expected pictures of one size, got {width}x{height} ({views[0].source}) and "
                f"{other_width}x{other_height} ({view.source}); calibrate each size by itself"
            )


def _check_same(known: Array, view: BoardView) -> None:
    """Raise InputError where a view puts a point elsewhere than the views before it."""
    apart = np.abs(known - view.p_board)
    if np.nanmax(apart, initial=0.0) > 1e-9 * np.abs(view.p_board).max(initial=0.0):
        raise InputError(
            f"{view.source or 'a view'} puts the board's points elsewhere than the views before "
            f"it; calibrate with views of one board"
        )

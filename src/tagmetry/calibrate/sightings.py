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
        whiteners: Turn errors in pixels into standard deviations, shape (n, k, 2, 2), upper
            triangular, 1 / px; zero where a corner is not to be used.
    """

    size_px: tuple[int, int]
    points: IntArray
    p_board: Array
    corners_px: Array
    whiteners: Array

    def __len__(self) -> int:
        """How many views."""
        return len(self.corners_px)

    @property
    def weights(self) -> Array:
        """What each corner tells along an axis in the mean, shape (n, k), 1 / px^2."""
        return np.asarray((self.whiteners**2).sum(axis=(2, 3)) / 2)

    @property
    def used(self) -> BoolArray:
        """Which corners count, shape (n, k)."""
        return np.asarray(self.whiteners[..., 1, 1] > 0)

    @property
    def corner_count(self) -> int:
        """How many corners count."""
        return int(self.used.sum())

    def only(self, views: IntArray | BoolArray) -> "Sightings":
        """Return some of the views."""
        return replace(self, corners_px=self.corners_px[views], whiteners=self.whiteners[views])

    def weighted(self, factors: Array | BoolArray) -> "Sightings":
        """Return the views with the weights multiplied by factors (n, k)."""
        return replace(self, whiteners=self.whiteners * np.sqrt(factors)[..., None, None])

    def whiten(self, pixels: Array) -> Array:
        """Return errors in pixels, or their derivatives, (n, k, 2, ...) in standard deviations."""
        W = self.whiteners.reshape(*self.whiteners.shape, *(1,) * (pixels.ndim - 3))
        whitened = np.empty_like(pixels)
        np.multiply(W[:, :, 0, 1], pixels[:, :, 1], out=whitened[:, :, 0])
        whitened[:, :, 0] += W[:, :, 0, 0] * pixels[:, :, 0]
        np.multiply(W[:, :, 1, 1], pixels[:, :, 1], out=whitened[:, :, 1])
        return whitened


def gather(views: Sequence[BoardView]) -> Sightings:
    """Put views of one board, of one size, in arrays.

    Raises:
        InputError: The views differ in size, or disagree on where the maker put a point.
    """
    _check_sizes(views)
    points = np.unique(np.concatenate([view.points for view in views]))
    shape = (len(views), len(points))
    corners, whiteners = np.zeros((*shape, 2)), np.zeros((*shape, 2, 2))
    p_board = np.full((len(points), 3), np.nan)
    for row, view in enumerate(views):
        columns = np.searchsorted(points, view.points)
        corners[row, columns] = view.corners_px
        whiteners[row, columns] = whitening(view.covariances_px2)
        _check_same(p_board[columns], view)
        p_board[columns] = view.p_board
    return Sightings(views[0].size_px, points, p_board, corners, whiteners)


def whitening(covariances_px2: Array) -> Array:
    """Return the upper triangular W with W^T W the inverse of each covariance (..., 2, 2)."""
    return np.asarray(np.swapaxes(np.linalg.cholesky(np.linalg.inv(covariances_px2)), -1, -2))


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

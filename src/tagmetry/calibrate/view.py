"""What one picture tells about a board: the values that finding makes and solving takes."""

from dataclasses import dataclass, field

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray


@dataclass(frozen=True, eq=False)
class BoardView:
    """The corners of a board that one picture shows.

    Attributes:
        width_px: Columns of the picture.
        height_px: Rows.
        points: Which of the board's points they are, shape (n,), rising.
        p_board: The points where the board's maker put them, shape (n, 3), metres.
        corners_px: Where the picture shows them, shape (n, 2).
        covariances_px2: Of each corner's place, shape (n, 2, 2).
        source: The picture's path or place in a video, for people.
    """

    width_px: int
    height_px: int
    points: IntArray
    p_board: Array
    corners_px: Array
    covariances_px2: Array
    source: str = ""

    def __post_init__(self) -> None:
        count = len(self.points)
        shapes = (self.p_board.shape, self.corners_px.shape, self.covariances_px2.shape)
        if shapes != ((count, 3), (count, 2), (count, 2, 2)):
            raise InputError(
                "expected points (n,), p_board (n, 3), corners_px (n, 2) and covariances_px2 "
                f"(n, 2, 2), got ({count},), {shapes[0]}, {shapes[1]} and {shapes[2]}"
            )
        if not (np.isfinite(self.p_board).all() and np.isfinite(self.corners_px).all()):
            raise InputError(f"the corners of {self.source or 'a view'} must be finite")
        if not _are_covariances(self.covariances_px2):
            raise InputError(
                f"the corners' covariances_px2 of {self.source or 'a view'} must be positive"
            )

    @property
    def size_px(self) -> tuple[int, int]:
        """(width, height) of the picture."""
        return self.width_px, self.height_px

    @property
    def sd_px(self) -> Array:
        """Standard deviation of each corner along an axis, root of the mean square, (n,)."""
        return mean_sd_px(self.covariances_px2)


def round_covariances(sd_px: Array) -> Array:
    """Return covariances (n, 2, 2) of corners as uncertain along all directions, from sd (n,)."""
    return np.asarray(np.square(sd_px)[:, None, None] * np.eye(2))


def mean_sd_px(covariances_px2: Array) -> Array:
    """Return standard deviations along an axis, root of the mean square over directions, (n,)."""
    return np.asarray(np.sqrt(np.trace(covariances_px2, axis1=1, axis2=2) / 2))


def _are_covariances(symmetric: Array) -> bool:
    if not np.isfinite(symmetric).all():
        return False
    return bool((np.linalg.eigvalsh(symmetric) > 0).all())


@dataclass(frozen=True, eq=False)
class RejectedView:
    """A picture that takes no part in a calibration, and why.

    Attributes:
        source: The picture's path or place in a video, for people.
        reason: What is wrong with it, in words.
        seen_px: Points of the board that were seen all the same, shape (n, 2).
    """

    source: str
    reason: str
    seen_px: Array = field(default_factory=lambda: np.zeros((0, 2)))

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
        sd_px: Standard deviation of each corner along an axis, shape (n,).
        source: The picture's path or place in a video, for people.
    """

    width_px: int
    height_px: int
    points: IntArray
    p_board: Array
    corners_px: Array
    sd_px: Array
    source: str = ""

    def __post_init__(self) -> None:
        count = len(self.points)
        shapes = (self.p_board.shape, self.corners_px.shape, self.sd_px.shape)
        if shapes != ((count, 3), (count, 2), (count,)):
            raise InputError(
                f"expected points (n,), p_board (n, 3), corners_px (n, 2) and sd_px (n,), got "
                f"({count},), {shapes[0]}, {shapes[1]} and {shapes[2]}"
            )
        if not (np.isfinite(self.p_board).all() and np.isfinite(self.corners_px).all()):
            raise InputError(f"the corners of {self.source or 'a view'} must be finite")
        if not (np.isfinite(self.sd_px).all() and (self.sd_px > 0).all()):
            raise InputError(f"the corners' sd_px of {self.source or 'a view'} must be positive")

    @property
    def size_px(self) -> tuple[int, int]:
        """(width, height) of the picture."""
        return self.width_px, self.height_px


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

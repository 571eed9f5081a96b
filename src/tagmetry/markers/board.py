"""What every flat board of markers and squares has in common.

Frame: `board` has its origin at the centre of the pattern, x to its right, y to its top, z out of
its face, as a marker has. Rows count from the top, columns from the left.
"""

from typing import Protocol

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.markers.bodies import MountedMarker


class Board(Protocol):
    """What printing, calibration and drawing need of any board."""

    @property
    def width_m(self) -> float:
        """Width of the pattern without margins."""

    @property
    def height_m(self) -> float:
        """Height of the pattern without margins."""

    @property
    def corners_m(self) -> Array:
        """The points that calibration uses, shape (n, 3), metres.

        Inner corners of a chessboard, rows from the top; four corners of every marker of a grid, in
        the order of `markers()`, clockwise from the marker's top left; centres of discs.
        """

    def markers(self) -> tuple[MountedMarker, ...]:
        """The markers at their places, none on a plain chessboard."""

    def black_squares_m(self) -> Array:
        """Lower left corner and side of the plain black squares, (n, 3): x, y, side."""

    def circles_m(self) -> Array:
        """The plain black discs, (n, 3): x and y of the centre, radius."""


def no_circles_m() -> Array:
    """Return the discs of a board that has none."""
    return np.zeros((0, 3))


def flat_at(x_m: float, y_m: float) -> RigidTransform:
    """Return T_board_marker of a marker that lies upright on the board."""
    return RigidTransform.from_translation([x_m, y_m, 0.0])


def check_counts(columns: int, rows: int, least: int) -> None:
    """Raise InputError for a board with too few columns or rows."""
    if columns < least or rows < least:
        raise InputError(f"a board needs at least {least}x{least}, got {columns}x{rows}")


def check_lengths(**lengths: float) -> None:
    """Raise InputError for a length that is not positive and finite, by its name."""
    for name, length in lengths.items():
        if not (np.isfinite(length) and length > 0):
            raise InputError(f"{name} must be positive, got {length}")

"""Boards of discs in rows and columns, straight or staggered."""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.markers.board import check_counts, check_lengths
from tagmetry.markers.bodies import MountedMarker


@dataclass(frozen=True)
class CircleGrid:
    """Black discs on white.

    Turned by half a turn the board looks the same, unless it is staggered with an odd number of
    rows: only then does a picture tell which disc is the first.

    Attributes:
        columns: Discs in a row.
        rows: Rows of discs.
        pitch_m: From one row to the next. Neighbours in a row are as far apart, and twice as far
            in a staggered grid.
        diameter_m: Diameter of a disc.
        asymmetric: Staggered, OpenCV's asymmetric grid: every second row, beginning with the
            second, is moved to the right by one pitch.
    """

    columns: int
    rows: int
    pitch_m: float
    diameter_m: float
    asymmetric: bool = False

    def __post_init__(self) -> None:
        check_counts(self.columns, self.rows, least=2)
        check_lengths(pitch_m=self.pitch_m, diameter_m=self.diameter_m)
        if self.diameter_m >= self.nearest_m:
            raise InputError(
                f"discs must not touch: their centres are {self.nearest_m:g} m apart, "
                f"got diameter_m {self.diameter_m:g}"
            )

    @property
    def nearest_m(self) -> float:
        """From a disc's centre to the next one's."""
        return self.pitch_m * (np.sqrt(2.0) if self.asymmetric else 1.0)

    @property
    def width_m(self) -> float:
        """Width of the pattern, from the first disc's rim to the last one's."""
        return float(np.ptp(self.corners_m[:, 0])) + self.diameter_m

    @property
    def height_m(self) -> float:
        """Height of the pattern, from rim to rim."""
        return (self.rows - 1) * self.pitch_m + self.diameter_m

    @property
    def corners_m(self) -> Array:
        """The discs' centres, rows from the top, shape (columns * rows, 3), metres."""
        row, column = np.divmod(np.arange(self.rows * self.columns), self.columns)
        step = 2 * column + row % 2 if self.asymmetric else column
        x = self.pitch_m * (step - step.max() / 2)
        y = self.pitch_m * ((self.rows - 1) / 2 - row)
        return np.stack([x, y, np.zeros(len(x))], axis=1)

    def markers(self) -> tuple[MountedMarker, ...]:
        """None: a circle grid has no markers."""
        return ()

    def black_squares_m(self) -> Array:
        """None: a circle grid has only discs."""
        return np.zeros((0, 3))

    def circles_m(self) -> Array:
        """The discs, (n, 3): x and y of the centre, radius."""
        centres = self.corners_m[:, :2]
        return np.column_stack([centres, np.full(len(centres), self.diameter_m / 2)])

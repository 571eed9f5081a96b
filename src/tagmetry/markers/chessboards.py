"""Boards of squares: the chessboard, and ChArUco with a marker in every white square."""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers.board import check_counts, check_lengths, flat_at, no_circles_m
from tagmetry.markers.bodies import MarkerBody, MountedMarker


@dataclass(frozen=True)
class Chessboard:
    """A chessboard, named by its inner corners as the field does (9x6).

    Attributes:
        corner_columns: Inner corners in a row.
        corner_rows: Rows of inner corners.
        square_m: Side of a square.
    """

    corner_columns: int
    corner_rows: int
    square_m: float

    def __post_init__(self) -> None:
        check_counts(self.corner_columns, self.corner_rows, least=2)
        check_lengths(square_m=self.square_m)

    @property
    def width_m(self) -> float:
        """Width of the pattern."""
        return (self.corner_columns + 1) * self.square_m

    @property
    def height_m(self) -> float:
        """Height of the pattern."""
        return (self.corner_rows + 1) * self.square_m

    @property
    def corners_m(self) -> Array:
        """The inner corners, rows from the top, shape (columns * rows, 3), metres."""
        return _inner_corners_m(self.corner_columns, self.corner_rows, self.square_m)

    def markers(self) -> tuple[MountedMarker, ...]:
        """None: a chessboard has no markers."""
        return ()

    def black_squares_m(self) -> Array:
        """The black squares; the top left one is black."""
        return _black_squares_m(
            self.corner_columns + 1, self.corner_rows + 1, self.square_m, first_black=True
        )

    def circles_m(self) -> Array:
        """None."""
        return no_circles_m()


@dataclass(frozen=True)
class CharucoBoard:
    """A chessboard with a marker in every white square.

    Attributes:
        columns: Squares in a row.
        rows: Rows of squares.
        square_m: Side of a square.
        size_m: Side of a marker's black square.
        family: Name of the markers' family.
        first_id: Id of the first marker; ids rise along rows, rows go down.
        legacy: The layout of OpenCV before 4.6, where a board with an even number of rows begins
            with a white square.
    """

    columns: int
    rows: int
    square_m: float
    size_m: float
    family: str = "5x5_250"
    first_id: int = 0
    legacy: bool = False

    def __post_init__(self) -> None:
        check_counts(self.columns, self.rows, least=2)
        check_lengths(square_m=self.square_m, size_m=self.size_m)
        if self.size_m >= self.square_m:
            raise InputError(
                f"a ChArUco marker must be smaller than its square, got {self.size_m} m in "
                f"{self.square_m} m"
            )

    @property
    def width_m(self) -> float:
        """Width of the pattern."""
        return self.columns * self.square_m

    @property
    def height_m(self) -> float:
        """Height of the pattern."""
        return self.rows * self.square_m

    @property
    def corners_m(self) -> Array:
        """The inner chessboard corners, rows from the top, shape (n, 3), metres."""
        return _inner_corners_m(self.columns - 1, self.rows - 1, self.square_m)

    @property
    def first_black(self) -> bool:
        """Whether the top left square is black."""
        return not (self.legacy and self.rows % 2 == 0)

    def markers(self) -> tuple[MountedMarker, ...]:
        """The markers in the white squares."""
        white = _checkered(self.columns, self.rows) != self.first_black
        rows, columns = np.nonzero(white)
        x = (columns + 0.5 - self.columns / 2) * self.square_m
        y = (self.rows / 2 - rows - 0.5) * self.square_m
        return tuple(
            MountedMarker(self.family, self.first_id + i, self.size_m, flat_at(*centre))
            for i, centre in enumerate(zip(x, y, strict=True))
        )

    def black_squares_m(self) -> Array:
        """The black squares of the chessboard."""
        return _black_squares_m(self.columns, self.rows, self.square_m, self.first_black)

    def circles_m(self) -> Array:
        """None."""
        return no_circles_m()

    def body(self) -> MarkerBody:
        """The board's markers as a rigid body."""
        return MarkerBody(f"ChArUco {self.columns}x{self.rows}", self.markers())


def _checkered(columns: int, rows: int) -> BoolArray:
    """Return a pattern that is True at the top left."""
    return np.asarray(np.add.outer(np.arange(rows), np.arange(columns)) % 2 == 0)


def _black_squares_m(columns: int, rows: int, square_m: float, first_black: bool) -> Array:
    row, column = np.nonzero(_checkered(columns, rows) == first_black)
    x = (column - columns / 2) * square_m
    y = (rows / 2 - row - 1) * square_m
    return np.stack([x, y, np.full(len(x), square_m)], axis=1)


def _inner_corners_m(columns: int, rows: int, square_m: float) -> Array:
    x = (np.arange(columns) - (columns - 1) / 2) * square_m
    y = ((rows - 1) / 2 - np.arange(rows)) * square_m
    across, up = np.meshgrid(x, y)
    return np.stack([across.ravel(), up.ravel(), np.zeros(across.size)], axis=1)

"""Flat boards of markers and squares: grid, AprilGrid, chessboard and ChArUco.

Frame: `board` has its origin at the centre of the pattern, x to its right, y to its top, z out of
its face, as a marker has. Rows count from the top, columns from the left.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers.bodies import MarkerBody, MountedMarker


class Board(Protocol):
    """What printing, calibration and drawing need of any board."""

    @property
    def width_m(self) -> float:
        """Width of the pattern without margins."""

    @property
    def height_m(self) -> float:
        """Height of the pattern without margins."""

    def markers(self) -> tuple[MountedMarker, ...]:
        """The markers at their places, none on a plain chessboard."""

    def black_squares_m(self) -> Array:
        """Lower left corner and side of the plain black squares, (n, 3): x, y, side."""


@dataclass(frozen=True)
class GridBoard:
    """Markers of one family in rows and columns.

    Attributes:
        columns: Markers in a row.
        rows: Rows of markers.
        size_m: Side of a black square.
        gap_m: White between neighbours.
        family: Name of the family.
        first_id: Id at the first place; ids rise by one along rows.
        from_bottom: The first place is the bottom left one, rows go up (Kalibr's order); otherwise
            it is the top left one, rows go down (OpenCV's order).
    """

    columns: int
    rows: int
    size_m: float
    gap_m: float
    family: str = "tag36h11"
    first_id: int = 0
    from_bottom: bool = False

    def __post_init__(self) -> None:
        _check_counts(self.columns, self.rows, least=1)
        _check_lengths(size_m=self.size_m, gap_m=self.gap_m)

    @property
    def width_m(self) -> float:
        """Width of the pattern without margins."""
        return self.columns * self.size_m + (self.columns - 1) * self.gap_m

    @property
    def height_m(self) -> float:
        """Height of the pattern without margins."""
        return self.rows * self.size_m + (self.rows - 1) * self.gap_m

    def markers(self) -> tuple[MountedMarker, ...]:
        """The markers at their places."""
        return tuple(
            MountedMarker(self.family, self.first_id + i, self.size_m, _at(x, y))
            for i, (x, y) in enumerate(self._centres_m())
        )

    def black_squares_m(self) -> Array:
        """None: a grid board has only markers."""
        return np.zeros((0, 3))

    def body(self) -> MarkerBody:
        """The board as a rigid body."""
        return MarkerBody(f"{self.columns}x{self.rows} {self.family}", self.markers())

    def _centres_m(self) -> Array:
        pitch_m = self.size_m + self.gap_m
        x = (np.arange(self.columns) - (self.columns - 1) / 2) * pitch_m
        upward = (np.arange(self.rows) - (self.rows - 1) / 2) * pitch_m
        y = upward if self.from_bottom else -upward
        return np.stack([np.tile(x, self.rows), np.repeat(y, self.columns)], axis=1)


@dataclass(frozen=True)
class AprilGrid:
    """Kalibr's board: AprilTags with a border of two cells, black squares where corners meet.

    Attributes:
        columns: Tags in a row.
        rows: Rows of tags.
        size_m: Side of a tag's black square, Kalibr's `tagSize`.
        spacing: White between neighbours as a share of size_m, Kalibr's `tagSpacing`.
        family: Name of the family, with its border.
        first_id: Id at the bottom left; ids rise along rows, rows go up.
    """

    columns: int
    rows: int
    size_m: float
    spacing: float
    family: str = "tag36h11_border2"
    first_id: int = 0

    def __post_init__(self) -> None:
        _check_counts(self.columns, self.rows, least=1)
        _check_lengths(size_m=self.size_m, spacing=self.spacing)

    @property
    def grid(self) -> GridBoard:
        """The tags without the small squares."""
        gap_m = self.size_m * self.spacing
        return GridBoard(
            self.columns, self.rows, self.size_m, gap_m, self.family, self.first_id, True
        )

    @property
    def width_m(self) -> float:
        """Width of the pattern with the outer small squares."""
        return self.grid.width_m + 2 * self.grid.gap_m

    @property
    def height_m(self) -> float:
        """Height of the pattern with the outer small squares."""
        return self.grid.height_m + 2 * self.grid.gap_m

    def markers(self) -> tuple[MountedMarker, ...]:
        """The tags at their places."""
        return self.grid.markers()

    def black_squares_m(self) -> Array:
        """The small squares at all corners of the tags."""
        gap_m, pitch_m = self.grid.gap_m, self.size_m + self.grid.gap_m
        x = -self.width_m / 2 + pitch_m * np.arange(self.columns + 1)
        y = -self.height_m / 2 + pitch_m * np.arange(self.rows + 1)
        across, up = np.meshgrid(x, y)
        return np.stack([across.ravel(), up.ravel(), np.full(across.size, gap_m)], axis=1)

    def body(self) -> MarkerBody:
        """The board as a rigid body."""
        return self.grid.body()


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
        _check_counts(self.corner_columns, self.corner_rows, least=2)
        _check_lengths(square_m=self.square_m)

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
        _check_counts(self.columns, self.rows, least=2)
        _check_lengths(square_m=self.square_m, size_m=self.size_m)
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
            MountedMarker(self.family, self.first_id + i, self.size_m, _at(*centre))
            for i, centre in enumerate(zip(x, y, strict=True))
        )

    def black_squares_m(self) -> Array:
        """The black squares of the chessboard."""
        return _black_squares_m(self.columns, self.rows, self.square_m, self.first_black)

    def body(self) -> MarkerBody:
        """The board's markers as a rigid body."""
        return MarkerBody(f"ChArUco {self.columns}x{self.rows}", self.markers())


def _at(x_m: float, y_m: float) -> RigidTransform:
    return RigidTransform.from_translation([x_m, y_m, 0.0])


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


def _check_counts(columns: int, rows: int, least: int) -> None:
    if columns < least or rows < least:
        raise InputError(f"a board needs at least {least}x{least}, got {columns}x{rows}")


def _check_lengths(**lengths: float) -> None:
    for name, length in lengths.items():
        if not (np.isfinite(length) and length > 0):
            raise InputError(f"{name} must be positive, got {length}")

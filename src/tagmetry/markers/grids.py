"""Boards of markers in rows and columns: the plain grid and Kalibr's AprilGrid."""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array
from tagmetry.markers.board import check_counts, check_lengths, flat_at, no_circles_m
from tagmetry.markers.bodies import MarkerBody, MountedMarker


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
        check_counts(self.columns, self.rows, least=1)
        check_lengths(size_m=self.size_m, gap_m=self.gap_m)

    @property
    def width_m(self) -> float:
        """Width of the pattern without margins."""
        return self.columns * self.size_m + (self.columns - 1) * self.gap_m

    @property
    def height_m(self) -> float:
        """Height of the pattern without margins."""
        return self.rows * self.size_m + (self.rows - 1) * self.gap_m

    @property
    def corners_m(self) -> Array:
        """Four corners of every marker, in the order of `markers()`, shape (4 * n, 3), metres."""
        return np.concatenate([marker.corners_m for marker in self.markers()])

    def markers(self) -> tuple[MountedMarker, ...]:
        """The markers at their places."""
        return tuple(
            MountedMarker(self.family, self.first_id + i, self.size_m, flat_at(x, y))
            for i, (x, y) in enumerate(self._centres_m())
        )

    def black_squares_m(self) -> Array:
        """None: a grid board has only markers."""
        return np.zeros((0, 3))

    def circles_m(self) -> Array:
        """None."""
        return no_circles_m()

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
        check_counts(self.columns, self.rows, least=1)
        check_lengths(size_m=self.size_m, spacing=self.spacing)

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

    @property
    def corners_m(self) -> Array:
        """Four corners of every tag, in the order of `markers()`, shape (4 * n, 3), metres."""
        return self.grid.corners_m

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

    def circles_m(self) -> Array:
        """None."""
        return no_circles_m()

    def body(self) -> MarkerBody:
        """The board as a rigid body."""
        return self.grid.body()

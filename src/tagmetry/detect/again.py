"""Where a second, thorough look is worth its time.

Markers that stand alone are found at a glance. Those of boards may touch each other or what lies
between them, so where many markers have neighbours it is looked for more around these: pictures in
borders beside them, or squares that touch their corners. Where there is no marker, or far more
pictures than markers, something about them may be hard to see: it is looked everywhere. So it is
where a marker is about the smallest that are wanted and those are too small for a glance. Of a
pattern of plain squares, a checkerboard for one, a glance is enough.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.detect.sample import side_lengths
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

_NEAR = 0.75, 1.6  # from centre to centre by the marker's side; closer is within it
_UNREAD = 2  # as many other pictures for each marker are far more
_OF_A_SIZE = 0.2, 2.5  # a neighbour's side by the marker's
_TOUCHING_FROM = 0.6  # of a marker's side, from centre to centre
_TOUCHING = 0.15  # of a marker's side, from corner to corner
_OF_BOARDS = 0.25  # so many of the markers have neighbours where there are boards
_PATTERN = 1000  # squares without a picture in any are a pattern: other looks show more of it
_AROUND = 2.0  # sides around them that are looked at again
_ENOUGH_AROUND = 1.0  # sides around them: where these were looked at, it is not done again
_SHORTEST = 0.4  # neighbours' sides, by the shortest of the markers
_SMALL = 2.0  # times the shortest side: where a marker is so small, others may be smaller


@dataclass(frozen=True)
class Box:
    """A part of an image, whole pixels, its ends left out, and what may be there.

    Attributes:
        left_px: First column.
        top_px: First row.
        right_px: Past the last column.
        bottom_px: Past the last row.
        least_px: Sides of markers there are hardly shorter than this.
    """

    left_px: int
    top_px: int
    right_px: int
    bottom_px: int
    least_px: float = 0.0

    @property
    def rows_and_columns(self) -> tuple[slice, slice]:
        """What cuts it out of an image."""
        return slice(self.top_px, self.bottom_px), slice(self.left_px, self.right_px)

    def holds(self, other: "Box") -> bool:
        """Say whether another box lies within this one."""
        return (
            self.left_px <= other.left_px
            and self.top_px <= other.top_px
            and self.right_px >= other.right_px
            and self.bottom_px >= other.bottom_px
        )


NOWHERE = Box(0, 0, 0, 0)


def again(
    markers_px: Array,
    pictures_px: Array,
    squares_px: Array,
    shape: tuple[int, int],
    least_px: float = 0.0,
    looked_at: Box = NOWHERE,
) -> Box | None:
    """Return where to look again; None when it is not worth it, or was done.

    Args:
        markers_px: Corners of the markers found so far, shape (m, 4, 2).
        pictures_px: Corners of all squares with something printed in a border, shape (k, 4, 2).
        squares_px: Corners of all squares found so far, shape (n, 4, 2).
        shape: Height and width of the image.
        least_px: Shortest side wanted, 0 where a glance sees the smallest as well as larger ones.
        looked_at: Where it was looked again already.
    """
    everywhere = Box(0, 0, shape[1], shape[0])
    if looked_at.holds(everywhere) or (not len(pictures_px) and len(squares_px) > _PATTERN):
        return None
    unread = (_apart_by_side(markers_px, pictures_px) > _NEAR[0]).all(axis=0).sum()
    if unread >= _UNREAD * len(markers_px) or (side_lengths(markers_px) < _SMALL * least_px).any():
        return everywhere
    crowded = _beside(markers_px, pictures_px) | _touched(markers_px, squares_px)
    if crowded.sum() < _OF_BOARDS * len(markers_px) or not crowded.any():
        return None
    if looked_at.holds(_around(markers_px[crowded], _ENOUGH_AROUND, shape)):
        return None
    return _around(markers_px[crowded], _AROUND, shape)


def _around(squares_px: Array, sides: float, shape: tuple[int, int]) -> Box:
    """Return what holds squares and so many of their sides around them, within the image."""
    around_px = sides * side_lengths(squares_px).mean(axis=1)[:, None]
    low = (squares_px.min(axis=1) - around_px).min(axis=0)
    high = (squares_px.max(axis=1) + around_px).max(axis=0)
    left, top = np.maximum(low, 0).astype(int).tolist()
    right, bottom = np.minimum(high + 1, [shape[1], shape[0]]).astype(int).tolist()
    return Box(left, top, right, bottom, _SHORTEST * float(side_lengths(squares_px).min()))


def _beside(markers_px: Array, pictures_px: Array) -> BoolArray:
    """Say which markers have a picture of about their size beside them, shape (m,)."""
    apart = _apart_by_side(markers_px, pictures_px)
    ratio = _ratio(markers_px, pictures_px)
    near = (apart > _NEAR[0]) & (apart < _NEAR[1])
    return np.asarray((near & (ratio > _OF_A_SIZE[0]) & (ratio < _OF_A_SIZE[1])).any(axis=1))


def _touched(markers_px: Array, squares_px: Array) -> BoolArray:
    """Say which markers touch another square's corner with one of theirs, shape (m,)."""
    outside = _apart_by_side(markers_px, squares_px) > _TOUCHING_FROM
    outside &= _ratio(markers_px, squares_px) > _OF_A_SIZE[0]
    marker, square = np.nonzero(outside & (_apart_by_side(markers_px, squares_px) < _NEAR[1]))
    between = markers_px[marker][:, :, None] - squares_px[square][:, None]
    apart_px = np.linalg.norm(between, axis=3).min(axis=(1, 2))
    touched = np.zeros(len(markers_px), dtype=bool)
    touched[marker[apart_px < _TOUCHING * side_lengths(markers_px).mean(axis=1)[marker]]] = True
    return touched


def _apart_by_side(markers_px: Array, others_px: Array) -> Array:
    """Return distances from centre to centre by the marker's side, shape (m, n)."""
    apart = others_px.mean(axis=1) - markers_px.mean(axis=1)[:, None]
    return np.asarray(
        np.linalg.norm(apart, axis=2) / side_lengths(markers_px).mean(axis=1)[:, None]
    )


def _ratio(markers_px: Array, others_px: Array) -> Array:
    """Return sides of squares by those of markers, shape (m, n)."""
    sides_px = side_lengths(markers_px).mean(axis=1)[:, None]
    return np.asarray(side_lengths(others_px).mean(axis=1) / sides_px)

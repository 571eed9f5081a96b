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

from tagmetry.detect.again.neighbours import crowded, unread
from tagmetry.detect.places import one_per_place, side_lengths
from tagmetry.geometry import Array

_UNREAD = 2  # as many other pictures for each marker are far more
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
    everywhere, pictures_px = Box(0, 0, shape[1], shape[0]), one_per_place(pictures_px)
    if looked_at.holds(everywhere) or (not len(pictures_px) and len(squares_px) > _PATTERN):
        return None
    is_small = side_lengths(markers_px) < _SMALL * least_px
    if unread(markers_px, pictures_px) >= _UNREAD * len(markers_px) or is_small.any():
        return everywhere
    is_crowded = crowded(markers_px, pictures_px, squares_px)
    if is_crowded.sum() < _OF_BOARDS * len(markers_px) or not is_crowded.any():
        return None
    if looked_at.holds(_around(markers_px[is_crowded], _ENOUGH_AROUND, shape)):
        return None
    return _around(markers_px[is_crowded], _AROUND, shape)


def _around(squares_px: Array, sides: float, shape: tuple[int, int]) -> Box:
    """Return what holds squares and so many of their sides around them, within the image."""
    around_px = sides * side_lengths(squares_px).mean(axis=1)[:, None]
    low = (squares_px.min(axis=1) - around_px).min(axis=0)
    high = (squares_px.max(axis=1) + around_px).max(axis=0)
    left, top = np.maximum(low, 0).astype(int).tolist()
    right, bottom = np.minimum(high + 1, [shape[1], shape[0]]).astype(int).tolist()
    return Box(left, top, right, bottom, _SHORTEST * float(side_lengths(squares_px).min()))

"""What looking for a board gives before it becomes a view: its points, or why there are none."""

from dataclasses import dataclass, field

import numpy as np

from tagmetry.calibrate.targets.patches import Patches
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, IntArray


@dataclass(frozen=True, eq=False)
class DroppedPoint:
    """A point of the board that was seen and not believed.

    Attributes:
        point: Which of the board's points it is.
        place_px: Where it was taken to be, shape (2,).
        reason: Why it was dropped, in words.
    """

    point: int
    place_px: Array
    reason: str


@dataclass(frozen=True, eq=False)
class Found:
    """Points of a board in a picture, as `BoardView` holds them.

    Attributes:
        points: Which of the board's points they are, shape (n,), rising.
        corners_px: Where they are, shape (n, 2).
        covariances_px2: Of each place, shape (n, 2, 2).
        dropped: Points that were not believed.
        patches: The pixels around each, where they are crossings of edges.
    """

    points: IntArray
    corners_px: Array
    covariances_px2: Array
    dropped: tuple[DroppedPoint, ...] = ()
    patches: Patches | None = None


@dataclass(frozen=True, eq=False)
class NotFound:
    """No usable board.

    Attributes:
        reason: Why, in words.
        seen_px: The points that were seen all the same, shape (n, 2).
    """

    reason: str
    seen_px: Array = field(default_factory=lambda: np.zeros((0, 2)))


def dropped(
    points: IntArray, places_px: Array, is_bad: BoolArray, reason: str
) -> tuple[DroppedPoint, ...]:
    """Return those of some points that are bad, all for the same reason."""
    bad = np.flatnonzero(is_bad)
    return tuple(DroppedPoint(int(points[i]), places_px[i], reason) for i in bad)

"""What a detector gives: markers, and on request what it turned down and why."""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry.arrays import Array


@dataclass(frozen=True, eq=False)
class Detection:
    """A marker found in an image.

    Attributes:
        family: Name of its family.
        id: Its id.
        corners_px: Clockwise from the marker's own top left, shape (4, 2), float64; an integer is a
            pixel's centre.
        corners_cov_px2: Covariance of (x0, y0, x1, y1, …), shape (8, 8).
        hamming: How many of its bits were read wrong and corrected.
        confidence: 0 to 1: how clearly its worst cell read as black or white.
        is_inverted: The marker is printed white on black.
        touches_border: A corner lies within two pixels of the image's edge.
        is_duplicate: The same family and id was found elsewhere in this image too.
    """

    family: str
    id: int
    corners_px: Array
    corners_cov_px2: Array
    hamming: int
    confidence: float
    is_inverted: bool = False
    touches_border: bool = False
    is_duplicate: bool = False

    @property
    def center_px(self) -> Array:
        """Where the diagonals cross: the image of the marker's centre, shape (2,)."""
        a, b, c, d = self.corners_px
        along, across = c - a, d - b
        normal = np.array([-across[1], across[0]])
        return np.asarray(a + along * (normal @ (b - a)) / (normal @ along))

    @property
    def side_px(self) -> float:
        """Mean length of the four sides."""
        sides = np.roll(self.corners_px, -1, axis=0) - self.corners_px
        return float(np.linalg.norm(sides, axis=1).mean())


@dataclass(frozen=True, eq=False)
class Rejection:
    """A quadrilateral that looked like a marker at first and was turned down.

    Attributes:
        corners_px: Clockwise in the image, shape (4, 2).
        reason: Why, in words.
    """

    corners_px: Array
    reason: str


@dataclass(frozen=True)
class Findings:
    """All that was seen in an image."""

    detections: tuple[Detection, ...]
    rejections: tuple[Rejection, ...]

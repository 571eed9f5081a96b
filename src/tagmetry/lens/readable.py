"""Where can a marker be read? It must be large enough, and its cells must not run together.

A point at depth z is spread over a disc whose diameter, brought back to the depth z, is

    A |1 - z / d|

when a lens of aperture A is focused at d. Bits are read while that is below a share q of a cell,
so one focus serves the depths

    d (1 - r) <= z <= d (1 + r),    r = q cell / A

whatever the zoom: a small aperture or a large marker makes the range wide.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.lens.zoom_lens import ZoomLens

BLUR_OF_CELL = 0.75  # q: measured with tag36h11 on the twin, see docs/how/lens.md
MOST_BOUND = 0.95
_LEAST_SIDE_PX = 20.0  # shortest extent of a marker that a full HD image is searched for safely
_SEARCHED_SIDE_PX = 28.0  # side of one that may be oblique
_MOST_OF_IMAGE = 0.8  # of the image's height that a marker may fill


@dataclass(frozen=True)
class MarkerKind:
    """What is known of the markers that are looked for.

    Attributes:
        size_m: Side of the black square.
        side_cells: Cells along it.
        size_sd_m: Standard deviation of the size.
    """

    size_m: float
    side_cells: int
    size_sd_m: float = 0.0

    def __post_init__(self) -> None:
        if not (np.isfinite(self.size_m) and self.size_m > 0):
            raise InputError(f"a marker's size must be positive, in metres, got {self.size_m}")
        if self.side_cells < 1:
            raise InputError(f"a marker has one cell or more along a side, got {self.side_cells}")
        if not (np.isfinite(self.size_sd_m) and self.size_sd_m >= 0):
            raise InputError(f"size_sd_m must not be negative, got {self.size_sd_m}")

    @property
    def cell_m(self) -> float:
        """Side of a cell."""
        return self.size_m / self.side_cells


@dataclass(frozen=True)
class DepthRange:
    """From a depth to another, m."""

    near_m: float
    far_m: float

    def holds(self, depth_m: float) -> bool:
        """Say whether a depth lies within."""
        return self.near_m <= depth_m <= self.far_m


def depth_of_reading(lens: ZoomLens, marker: MarkerKind, focus: float) -> DepthRange:
    """Return the depths at which a focus value leaves a marker readable."""
    focus_m, share = lens.law.depth_m(focus), readable_share(lens, marker)
    return DepthRange(focus_m * (1 - share), focus_m * (1 + share))


def readable_share(lens: ZoomLens, marker: MarkerKind) -> float:
    """Return r, by which share of the focused depth a marker may be off."""
    return min(BLUR_OF_CELL * marker.cell_m / lens.aperture_m, MOST_BOUND)


def widest_zoom_percent(lens: ZoomLens, marker: MarkerKind, depths: DepthRange) -> float:
    """Return the least zoom at which a marker is large enough at the far end of some depths.

    It is no more than what leaves the marker at the near end within the image.
    """
    needed = _SEARCHED_SIDE_PX * depths.far_m / (lens.focal_px() * marker.size_m)
    allowed = largest_zoom(lens, marker, depths.near_m)
    return lens.zoom.nearest(100 * max(min(needed, allowed), 1.0))


def largest_zoom(lens: ZoomLens, marker: MarkerKind, depth_m: float) -> float:
    """Return the magnification at which a marker fills most of the image."""
    side_px = lens.focal_px() * marker.size_m / depth_m
    return _MOST_OF_IMAGE * min(lens.size_px) / side_px


def enough_zoom(lens: ZoomLens, marker: MarkerKind, depth_m: float, tilt_rad: float) -> float:
    """Return the magnification at which a tilted marker's shorter extent is large enough."""
    foreshortened = max(float(np.cos(tilt_rad)), 0.1)
    side_px = lens.focal_px() * marker.size_m / depth_m * foreshortened
    return _LEAST_SIDE_PX / side_px

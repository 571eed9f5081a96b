"""From the markers of one image to the robots that it shows: where each is, and how sure.

A robot's centre is where its mount says it is from its marker.

The corners' noise is new in every image and is what a filter may average. The errors of the
camera's pose and of the marker's height stay the same from image to image; they are kept apart, and
no filter makes them smaller. Errors of the intrinsics are not told.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tagmetry.arena.below_squares import centred
from tagmetry.arena.on_plane import OverheadView
from tagmetry.arena.robot import Robot
from tagmetry.arena.square_fit import fit_squares
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, IntArray
from tagmetry.markers.bodies import MarkerKey


@dataclass(frozen=True, eq=False)
class Roster:
    """All robots of an arena, each in its row.

    Attributes:
        robots: Every id and every marker once.
    """

    robots: tuple[Robot, ...]

    def __post_init__(self) -> None:
        _check_unique("id", [robot.id for robot in self.robots])
        names = [f"{one.family} id {one.marker_id}" for one in self.robots]
        _check_unique("marker", names)

    def __len__(self) -> int:
        """The number of robots."""
        return len(self.robots)

    @cached_property
    def row_by_marker(self) -> Mapping[MarkerKey, int]:
        """Rows by marker."""
        return {robot.marker: row for row, robot in enumerate(self.robots)}

    @cached_property
    def mounts(self) -> Array:
        """Size, height, its standard deviation, forward, left and turn, shape (n, 6)."""
        numbers = [
            (
                robot.marker_size_m,
                robot.mount.height_m,
                robot.mount.height_sd_m,
                robot.mount.forward_m,
                robot.mount.left_m,
                robot.mount.turn_rad,
            )
            for robot in self.robots
        ]
        return np.array(numbers, dtype=np.float64).reshape(-1, 6)


@dataclass(frozen=True, eq=False)
class Sightings:
    """The robots that an image shows; one whose marker is there twice stands there twice.

    Attributes:
        rows: Of the robots in the roster, shape (n,).
        places: Centre (x, y) and heading, shape (n, 3), m and rad.
        noise: Their covariance from the corners' noise, shape (n, 3, 3).
        common: Their covariance from the camera's pose and the heights, shape (n, 3, 3).
        chi2: Of the four corners, with five degrees of freedom, shape (n,).
    """

    rows: IntArray
    places: Array
    noise: Array
    common: Array
    chi2: Array

    def __len__(self) -> int:
        """The number of sightings."""
        return len(self.rows)

    def at(self, which: IntArray | BoolArray) -> "Sightings":
        """Return some of them."""
        return Sightings(
            self.rows[which],
            self.places[which],
            self.noise[which],
            self.common[which],
            self.chi2[which],
        )


def sight(detections: Sequence[Detection], roster: Roster, view: OverheadView) -> Sightings:
    """Return the robots of the roster that an image shows.

    Args:
        detections: All markers of the image; those of no robot are passed over, and so are those
            whose numbers are unusable.
        roster: The robots.
        view: The camera over the floor.
    """
    known = roster.row_by_marker
    rows_of = [known.get(MarkerKey(one.family, one.id)) for one in detections]
    pairs = zip(rows_of, detections, strict=True)
    own = [(row, one) for row, one in pairs if row is not None and _has_corners(one)]
    rows = np.array([row for row, _ in own], dtype=np.int64)
    corners_px = np.array([one.corners_px for _, one in own]).reshape(-1, 4, 2)
    covariances_px2 = np.array([one.corners_cov_px2 for _, one in own]).reshape(-1, 8, 8)
    mounts = roster.mounts[rows]
    fits = fit_squares(view, corners_px, covariances_px2, mounts[:, 0], mounts[:, 1])
    squares = fits.places, fits.noise, fits.by_camera, fits.by_height, fits.chi2
    places, noise, common = centred(squares, mounts, np.array(view.covariance, dtype=np.float64))
    seen = Sightings(rows, places, noise, common, fits.chi2)
    is_placed = np.isfinite(places).all(axis=1) & np.isfinite(fits.chi2)
    return seen if is_placed.all() else seen.at(is_placed)


def _has_corners(detection: Detection) -> bool:
    return detection.corners_px.shape == (4, 2) and detection.corners_cov_px2.shape == (8, 8)


def _check_unique(kind: str, values: Sequence[object]) -> None:
    for value in values:
        if values.count(value) > 1:
            raise InputError(f"the {kind} {value} stands at two robots; each has its own")

"""From the markers of one image to the robots that it shows: where each is, and how sure.

A robot's centre is where its mount says it is from its marker:

    heading = f - turn,   (x, y) = (x_marker, y_marker) - R(heading) (forward, left)

The corners' noise is new in every image and is what a filter may average. The errors of the
camera's pose and of the marker's height stay the same from image to image; they are kept apart, and
no filter makes them smaller. Errors of the intrinsics are not told.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tagmetry.arena.on_plane import OverheadView
from tagmetry.arena.robot import Robot
from tagmetry.arena.square_fit import FREEDOM, SquareFits, fit_squares
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array, wrap_angle_rad
from tagmetry.geometry.arrays import BoolArray, IntArray
from tagmetry.markers.bodies import MarkerKey

_POOR_CHI2 = 20.5  # one good fit of a thousand is worse


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
    own = _usable([one for one in detections if MarkerKey(one.family, one.id) in known])
    rows = np.array([known[MarkerKey(one.family, one.id)] for one in own], dtype=np.int64)
    corners_px = np.array([one.corners_px for one in own]).reshape(-1, 4, 2)
    covariances_px2 = np.array([one.corners_cov_px2 for one in own]).reshape(-1, 8, 8)
    mounts = roster.mounts[rows]
    fits = fit_squares(view, corners_px, covariances_px2, mounts[:, 0], mounts[:, 1])
    seen = _centred(fits, rows, mounts, view)
    return seen.at(np.isfinite(seen.places).all(axis=1) & np.isfinite(seen.chi2))


def _centred(fits: SquareFits, rows: IntArray, mounts: Array, view: OverheadView) -> Sightings:
    """Return the robots below squares."""
    heading = fits.places[:, 2] - mounts[:, 5]
    to_marker = _turned(mounts[:, 3:5], heading)
    places = np.column_stack([fits.places[:, :2] - to_marker, wrap_angle_rad(heading)])
    by_marker = np.broadcast_to(np.eye(3), (len(rows), 3, 3)).copy()
    by_marker[:, 0, 2], by_marker[:, 1, 2] = to_marker[:, 1], -to_marker[:, 0]
    spread2 = np.where(fits.chi2 > _POOR_CHI2, fits.chi2 / FREEDOM, 1.0)
    by_height = fits.by_height * mounts[:, 2:3]
    common = fits.by_camera @ view.covariance @ np.swapaxes(fits.by_camera, 1, 2)
    common = common + by_height[:, :, None] * by_height[:, None, :]
    noise = _carried(by_marker, spread2[:, None, None] * fits.noise)
    return Sightings(rows, places, noise, _carried(by_marker, common), fits.chi2)


def _turned(forward_left: Array, heading: Array) -> Array:
    """Return vectors of the robots' frames in the world, shape (n, 2)."""
    cosine, sine = np.cos(heading), np.sin(heading)
    forward, left = forward_left.T
    return np.column_stack([cosine * forward - sine * left, sine * forward + cosine * left])


def _carried(jacobians: Array, covariances: Array) -> Array:
    return np.asarray(jacobians @ covariances @ np.swapaxes(jacobians, 1, 2))


def _usable(detections: Sequence[Detection]) -> list[Detection]:
    """Return those whose numbers are usable; all at once, since they nearly always are."""
    if _are_usable(detections):
        return list(detections)
    return [one for one in detections if _are_usable([one])]


def _are_usable(detections: Sequence[Detection]) -> bool:
    corners = [one.corners_px for one in detections]
    covariances = [one.corners_cov_px2 for one in detections]
    if {one.shape for one in corners} - {(4, 2)} or {one.shape for one in covariances} - {(8, 8)}:
        return False
    if not (np.isfinite(corners).all() and np.isfinite(covariances).all()):
        return False
    try:
        np.linalg.cholesky(np.reshape(covariances, (-1, 8, 8)))
    except np.linalg.LinAlgError:
        return False
    return True


def _check_unique(kind: str, values: Sequence[object]) -> None:
    for value in values:
        if values.count(value) > 1:
            raise InputError(f"the {kind} {value} stands at two robots; each has its own")

"""Pictures from seed 004's robot, localized by every method, and how far each is off.

The paper's own steps: ArUco's detector and solvePnP by OpenCV, equations 1 to 3 (with the sign of
the second put right) for every marker, then the average of the markers.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TypedDict

import cv2
import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect import Detection, Detector
from tagmetry.geometry import Array, RigidTransform, mahalanobis_squared, wrap_angle_rad
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.lab.rigs.paper_localization import solved_pose
from tagmetry.lab.rigs.robot_cameras import CAMERAS, CameraName, robot_picture
from tagmetry.lab.rigs.robot_room import (
    FAMILY,
    ROBOT,
    T_ROBOT_CAMERA,
    RobotStand,
    robot_place,
    room_map,
    room_scene,
)
from tagmetry.lab.rows import RobotPlace
from tagmetry.localize import (
    METHODS,
    Knowledge,
    Localizer,
    MarkerMap,
    PlanarPose,
    camera_on_floor,
    robot_on_floor,
)

PAPER = "paper"
PLANAR = "planar"
"""The joint solution that knows that the robot stands on the floor."""

_UNKNOWN = np.full((3, 3), np.nan)


class _Errors(TypedDict):
    x_m: float
    y_m: float
    heading_rad: float
    sd_place_m: float
    sd_heading_rad: float
    mahalanobis2: float
    markers: int


_NAN = float("nan")
_NONE: _Errors = {
    "x_m": _NAN, "y_m": _NAN, "heading_rad": _NAN, "sd_place_m": _NAN, "sd_heading_rad": _NAN,
    "mahalanobis2": _NAN, "markers": 0,
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class FoundRobot:
    """What a method says of the robot's place.

    Attributes:
        method: Its name.
        pose: Place and heading; the covariance is NaN where none is stated.
        markers: How many markers it rests on.
    """

    method: str
    pose: PlanarPose
    markers: int


def robot_methods() -> tuple[str, ...]:
    """Return the names of all methods: the paper's, then ours."""
    return (PAPER, *METHODS, PLANAR)


def robot_localized(
    name: CameraName, stand: RobotStand, repeats: int, seed: int
) -> Iterator[RobotPlace]:
    """Give how far every method is off in pictures of a stand."""
    rng = np.random.default_rng(seed)
    places, scene = room_map(stand), room_scene(stand)
    for repeat in range(repeats):
        T_world_robot = robot_place(stand, rng)
        pixels = robot_picture(name, scene, T_world_robot * T_ROBOT_CAMERA, rng)
        found = {one.method: one for one in robots(pixels, places, CAMERAS[name].camera)}
        for method in robot_methods():
            setting = (name, stand.layout, stand.size_m, stand.distance_m, stand.place)
            yield RobotPlace(
                method, *setting, stand.window, repeat, **_errors(found.get(method), T_world_robot)
            )


def robots(pixels: AnyPixels, places: MarkerMap, camera: Camera) -> Iterator[FoundRobot]:
    """Give the robot's place by every method that finds one."""
    yield from _by_the_paper(pixels, places, camera)
    found = Detector([FAMILY]).detect(pixels, camera)
    for name in METHODS:
        yield from _by(name, Localizer(places, camera, METHODS[name]), found)
    yield from _by(PLANAR, Localizer(places, camera, known=ROBOT.knowledge), found)


def _by(name: str, localizer: Localizer, found: Sequence[Detection]) -> Iterator[FoundRobot]:
    pose = localizer.locate(found, Knowledge())
    if pose.hypotheses:
        yield FoundRobot(name, robot_on_floor(pose.best, T_ROBOT_CAMERA), len(pose.used))


def _by_the_paper(pixels: AnyPixels, places: MarkerMap, camera: Camera) -> Iterator[FoundRobot]:
    seen = _aruco_corners(pixels)
    single = [
        camera_on_floor(solved_pose(seen[one.id], camera, one.size_m), one.T_world_marker)
        for one in places.markers
        if one.id in seen
    ]
    if single:
        x_m, y_m = np.mean([(one.x_m, one.y_m) for one in single], axis=0)
        turns = np.exp(1j * np.array([one.heading_rad for one in single]))
        heading_rad = float(np.angle(turns.sum()))
        pose = PlanarPose(float(x_m), float(y_m), heading_rad, _UNKNOWN)
        yield FoundRobot(PAPER, pose, len(single))


def _errors(one: FoundRobot | None, T_world_robot: RigidTransform) -> _Errors:
    if one is None:
        return _NONE
    R = T_world_robot.rotation.as_matrix()
    x_m, y_m, _ = T_world_robot.translation
    turned_rad = float(wrap_angle_rad(one.pose.heading_rad - np.arctan2(R[1, 0], R[0, 0])))
    error = np.array([one.pose.x_m - x_m, one.pose.y_m - y_m, turned_rad])
    covariance = one.pose.covariance
    variances = np.diag(covariance)
    is_stated = bool(np.isfinite(variances).all())
    return {
        "x_m": float(error[0]),
        "y_m": float(error[1]),
        "heading_rad": turned_rad,
        "sd_place_m": float(np.sqrt(variances[:2].sum())),
        "sd_heading_rad": float(np.sqrt(variances[2])),
        "mahalanobis2": float(mahalanobis_squared(error, covariance)) if is_stated else np.nan,
        "markers": one.markers,
    }


def _aruco_corners(pixels: AnyPixels) -> dict[int, Array]:
    """Return the corners of every marker that OpenCV finds by its id, (4, 2)."""
    corners, ids, _ = _aruco().detectMarkers(pixels)
    return {
        int(marker_id): np.asarray(one, dtype=np.float64).reshape(4, 2)
        for one, marker_id in zip(corners, np.ravel(ids), strict=False)  # ids: None where none is
    }


@lru_cache
def _aruco() -> "cv2.aruco.ArucoDetector":
    parameters = cv2.aruco.DetectorParameters()
    parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_ARUCO_ORIGINAL)
    return cv2.aruco.ArucoDetector(dictionary, parameters)

"""Seed 003, tables 7 to 15: how exact is a marker's position along x, y and z?

A marker is put at every position of the tables and measured with a camera calibrated just before,
by tagmetry and by the steps of the paper's program. The same corners are then measured with one
thing made wrong at a time, to see which mistake gives errors like the paper's. The paper does not
tell its marker's side; 100 mm is taken.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import cv2
import numpy as np

from tagmetry.camera import BrownLens, Camera
from tagmetry.detect import Detection, Detector
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.lab.beside.seed003_pose import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.published.seed003 import PositionTable, seed003
from tagmetry.lab.rigs.webcam import picture
from tagmetry.lab.rigs.webcam_calibration import Case, cases, solved_webcam
from tagmetry.lab.rows import Position
from tagmetry.markers import MountedMarker, marker_corners_m
from tagmetry.pose import estimate_pose
from tagmetry.twin.scenes import Still, marker_thing

SIZE_M = 0.1
MARKER = MountedMarker("aruco_original", 30, SIZE_M, RigidTransform.identity())
_MOST_LEAN_DEG = 2.0  # nobody holds a marker straight


class Reading(NamedTuple):
    """A marker's place in the camera's frame, shape (3,), and its standard deviations, m."""

    place_m: "np.ndarray[tuple[int], np.dtype[np.float64]]"
    sd_m: "np.ndarray[tuple[int], np.dtype[np.float64]]"


_NOTHING = Reading(np.full(3, np.nan), np.full(3, np.nan))


def measure(case: Case, seed: int) -> Sequence[Position]:
    """Return where every marker of tables 7 to 15 is said to be."""
    rng = np.random.default_rng(seed)
    camera = solved_webcam(case.method, rng).camera
    readings = _by_tagmetry if case.method == "tagmetry" else _by_opencv
    return [
        Position(
            case.method,
            case.repeat,
            assumed,
            table.table,
            row,
            actual_cm,
            float(100 * reading.place_m["xyz".index(table.axis)]),
            float(100 * reading.sd_m["xyz".index(table.axis)]),
        )
        for table in seed003().positions
        for row, (_, actual_cm, *_) in enumerate(table.rows)
        for assumed, reading in readings(_picture(table, actual_cm, rng), camera)
    ]


def _picture(table: PositionTable, actual_cm: float, rng: np.random.Generator) -> AnyPixels:
    """Return the picture of the marker at a position, faced by the camera but for a degree."""
    place_m = np.array([0.0, 0.0, table.distance_cm / 100])
    place_m["xyz".index(table.axis)] = actual_cm / 100
    lean_deg = rng.uniform(-_MOST_LEAN_DEG, _MOST_LEAN_DEG, 3)
    R_camera_marker = Rotation.from_euler("xyz", [180.0 + lean_deg[0], *lean_deg[1:]], degrees=True)
    T_camera_marker = RigidTransform.from_components(place_m, R_camera_marker)
    return picture(marker_thing([MARKER], Still(T_camera_marker)), rng)


def _by_tagmetry(pixels: AnyPixels, camera: Camera) -> Iterator[tuple[str, Reading]]:
    """Give the reading as it should be, and with one thing wrong at a time."""
    found = Detector([MARKER.family]).detect(pixels, camera)
    u, v = camera.center_px
    assumed = {
        "right": (camera, SIZE_M),
        "size 1 % too large": (camera, 1.01 * SIZE_M),
        "focal length 1 % too long": (
            replace(camera, focal_px=(1.01 * camera.focal_px[0], 1.01 * camera.focal_px[1])),
            SIZE_M,
        ),
        "centre half a pixel off": (replace(camera, center_px=(u + 0.5, v + 0.5)), SIZE_M),
        "no distortion": (replace(camera, lens=BrownLens(), covariance=None), SIZE_M),
    }
    for name, (taken, size_m) in assumed.items():
        yield name, _reading(found, taken, size_m)


def _reading(found: Sequence[Detection], camera: Camera, size_m: float) -> Reading:
    pose = estimate_pose(found[0], camera, size_m) if len(found) == 1 else None
    if pose is None or not pose.hypotheses:
        return _NOTHING
    sd = np.sqrt(np.diag(pose.covariance)[:3])
    return Reading(np.asarray(pose.best.T_camera_marker.translation), sd)


def _by_opencv(pixels: AnyPixels, camera: Camera) -> Iterator[tuple[str, Reading]]:
    """Give the reading of OpenCV's detector, as it stands, and its solvePnP."""
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_ARUCO_ORIGINAL)
    corners, ids, _ = cv2.aruco.ArucoDetector(dictionary).detectMarkers(
        pixels
    )  # ids: None where none is
    seen = [c for c, i in zip(corners, np.ravel(ids), strict=False) if i == MARKER.id]
    if len(seen) != 1:
        yield "right", _NOTHING
        return
    lens, own_m = np.array(camera.lens.coefficients), marker_corners_m(SIZE_M)
    _, _, place_m = cv2.solvePnP(own_m, seen[0].reshape(4, 2), camera.matrix, lens)
    yield "right", Reading(np.ravel(place_m), np.full(3, np.nan))


EXPERIMENT = Experiment(
    name="seed003-pose",
    title="How exact is a marker's position along x, y and z at 50, 70 and 100 cm?",
    source="seed 003, tables 7 to 15, figures 10 to 23",
    row=Position,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

"""Runs of seed 000's system, and of ours, on the twin's webcam.

The paper's steps: zoom 500, focus 150 and down by 15; then zoom by equation 1, focus by equation 3,
the nearest of 31 calibrations, until equations 6 or 7 hold. Its corners are those of OpenCV's
detector with its own sub-pixel refinement, in the place of the library that it used.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import cv2
import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect import Detection, Detector
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.lens import LensSetting, Measured, SeedRule, ZoomLens, seed_scan
from tagmetry.pipeline.lens import Drive, Finder, LensStep, LensTask, measure_marker
from tagmetry.pipeline.lens.twin import webcam_lens
from tagmetry.sources.controls import by_hand
from tagmetry.twin.camera import TwinCamera

By = Literal["position", "posture"]
_MOST_ITERATIONS = 60
_POSTURE_DEG = 0.05  # of the text; table 3 has 0.01
_CORNER_PX = 0.1  # what such corners are taken to be good for


class OpenCvFinder:
    """OpenCV's detector with its sub-pixel corners, as a `Finder`."""

    def __init__(self) -> None:
        """Look for tag36h11."""
        parameters = cv2.aruco.DetectorParameters()
        parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
        dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
        self._detector = cv2.aruco.ArucoDetector(dictionary, parameters)

    def detect(self, image: AnyPixels, camera: Camera | None = None) -> tuple[Detection, ...]:
        """Return the markers in an image; corners clockwise from the marker's own top left."""
        del camera  # it works on the image as it is
        corners, ids, _ = self._detector.detectMarkers(image)  # ids: None where none is
        return tuple(
            Detection(
                "tag36h11",
                int(one),
                np.asarray(found, np.float64).reshape(4, 2),
                _CORNER_PX**2 * np.eye(8),
                0,
                1.0,
            )
            for found, one in zip(corners, np.ravel(ids), strict=False)
        )


@dataclass(frozen=True, eq=False)
class NearestLens(ZoomLens):
    """A lens that takes the nearest calibration, as the paper does, instead of interpolating."""

    def camera_at(self, setting: LensSetting) -> Camera:
        """Return the calibration nearest in focus, zoomed."""
        foci = np.array([node.focus for node in self.bank.nodes])
        nearest = float(foci[np.abs(foci - setting.focus).argmin()])
        return super().camera_at(replace(setting, focus=nearest))


def paper_lens() -> NearestLens:
    """Return the webcam with 31 calibrations, of which the nearest is taken."""
    own = webcam_lens()
    return NearestLens(
        own.zoom, own.focus, own.law, own.bank, own.aperture_m, own.nearest_m, own.farthest_m,
        own.native_percent,
    )  # fmt: skip


def our_finder() -> Finder:
    """Return our detector."""
    return Detector(["tag36h11"])


def our_run(camera: TwinCamera, task: LensTask) -> Iterator[LensStep]:
    """Give the steps of our system."""
    return measure_marker(camera, task)


def paper_run(camera: TwinCamera, task: LensTask, by: By) -> Iterator[LensStep]:
    """Give the steps of the paper's system: its scan, then its iteration."""
    with by_hand(camera.controls):
        yield from _paper_steps(Drive(camera), task, by)


def _paper_steps(drive: Drive, task: LensTask, by: By) -> Iterator[LensStep]:
    found: Measured | None = None
    for setting in seed_scan(task.lens):
        drive.go(setting)
        step = _settled(drive, task, "scan")
        found = step.found
        yield step
        if found is not None:
            break
    rule = SeedRule(posture_rad=float(np.radians(_POSTURE_DEG)))
    for _ in range(_MOST_ITERATIONS if found is not None else 0):
        if found is None:
            return
        drive.go(rule.setting(found.depth_m, task.lens.zoom, task.lens.focus))
        step = _settled(drive, task, "iterate")
        is_final = step.found is not None and rule.has_settled(
            found.T_camera_marker,
            step.found.T_camera_marker,
            by_position=by == "position",
            by_posture=by == "posture",
        )
        found = step.found
        yield replace(step, is_final=is_final)
        if is_final:
            return


def _settled(drive: Drive, task: LensTask, phase: Literal["scan", "iterate"]) -> LensStep:
    """Return the first image that shows what was commanded."""
    taken = drive.take()
    while not taken.is_settled:
        taken = drive.take()
    return task.look(taken, phase)

"""The line of an image tells how sure the turn is, and whether the other pose is possible."""

import numpy as np
import pytest

from tagmetry.camera import Camera, Image
from tagmetry.cli.lens_trace import step_line
from tagmetry.detect import Detection
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.lens import LensSetting, Measured
from tagmetry.markers import marker_corners_m
from tagmetry.pipeline.lens import LensStep
from tagmetry.pose import estimate_pose

CAMERA = Camera(1920, 1080, (2200.0, 2200.0), (960.0, 540.0))
SETTING = LensSetting(200.0, 4.0)


def step_of(turn_deg: float, depth_m: float) -> LensStep:
    facing = Rotation.from_euler("yx", [turn_deg, 180], degrees=True)
    T_camera_marker = RigidTransform.from_components([0.0, 0.0, depth_m], facing)
    corners_px = CAMERA.project(T_camera_marker.apply(marker_corners_m(0.01)))
    seen = Detection("tag36h11", 7, corners_px, 0.01**2 * np.eye(8), 0, 1.0)
    pose = estimate_pose(seen, CAMERA, 0.01)
    found = Measured(SETTING, seen, seen, pose, pose.covariance, float("nan"))
    image = Image(np.zeros((2, 2), np.uint8), 0.0, sequence=3)
    return LensStep("average", image, SETTING, True, found, is_final=True)


def test_a_turn_that_hardly_tells_the_two_poses_apart_says_so() -> None:
    step = step_of(5.0, 1.05)
    assert step.found is not None
    assert step.found.pose.ambiguity > 0.05
    line = step_line(step)
    assert f"(other pose {100 * step.found.pose.ambiguity:.0f} %) final" in line
    assert step.table()["marker"]["ambiguity"] == pytest.approx(step.found.pose.ambiguity)


def test_a_clear_turn_says_how_sure_it_is_only() -> None:
    step = step_of(40.0, 0.3)
    assert step.found is not None
    line = step_line(step)
    assert line.endswith(f"turn ± {np.degrees(step.found.turn_sd_rad):.2f} degrees final")
    assert "depth   300.00 mm" in line

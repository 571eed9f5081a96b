"""The covariance of a measurement holds noise, calibration and size: by Monte Carlo."""

from dataclasses import replace

import numpy as np
import pytest
from lens_example import MARKER, camera_at, lens

from tagmetry.camera import BankNode, BrownLens, Camera, CameraBank, zoomed
from tagmetry.detect import Detection
from tagmetry.geometry import RigidTransform, pose_difference
from tagmetry.geometry.transforms import Rotation
from tagmetry.lens import LensSetting, MarkerKind, measured
from tagmetry.markers import marker_corners_m

SETTING = LensSetting(200.0, 50.0)
T_CAMERA_MARKER = RigidTransform.from_components(
    [0.01, -0.005, 0.33], Rotation.from_euler("yx", [35, 175], degrees=True)
)
NOISE_PX = 0.03


def seen(camera: Camera, size_m: float, rng: np.random.Generator) -> Detection:
    corners_px = camera.project(T_CAMERA_MARKER.apply(marker_corners_m(size_m)))
    noisy = corners_px + rng.normal(0, NOISE_PX, (4, 2))
    return Detection("tag36h11", 7, noisy, NOISE_PX**2 * np.eye(8), 0, 1.0)


def other(camera: Camera, rng: np.random.Generator) -> Camera:
    """A camera that the calibration may have come from."""
    fx, fy, cx, cy, *k = rng.multivariate_normal(
        [*camera.focal_px, *camera.center_px, *camera.lens.coefficients], camera.covariance
    )
    return replace(camera, focal_px=(fx, fy), center_px=(cx, cy), lens=BrownLens(tuple(k)))


def test_the_mean_squared_distance_is_six() -> None:
    rng = np.random.default_rng(2)
    node = camera_at(50.0, sd_share=2e-3)
    one = replace(lens(), bank=CameraBank((BankNode(node),), zoom_is_digital=True))
    marker = MarkerKind(0.01, 8, size_sd_m=3e-5)
    squares = []
    for _ in range(300):
        size_m = rng.normal(marker.size_m, marker.size_sd_m)
        found = measured(seen(zoomed(other(node, rng), 2.0), size_m, rng), one, marker, SETTING)
        off = pose_difference(found.T_camera_marker, T_CAMERA_MARKER)
        squares.append(off @ np.linalg.solve(found.covariance, off))
    assert 4.8 < np.mean(squares) < 6.9


def test_each_doubt_adds_to_the_depth_s_deviation() -> None:
    rng = np.random.default_rng(4)
    camera = lens().camera_at(SETTING)
    detection = seen(camera, 0.01, rng)
    plain = measured(detection, lens(), MARKER, SETTING)
    size = measured(detection, lens(), MarkerKind(0.01, 8, 1e-4), SETTING)
    blurred = measured(detection, lens(), MARKER, SETTING, blur_px=8.0)
    assert plain.depth_sd_m > np.sqrt(plain.pose.covariance[2, 2])  # the calibration's part
    assert size.depth_sd_m == pytest.approx(np.hypot(plain.depth_sd_m, 0.0033), rel=0.02)
    assert blurred.depth_sd_m > 20 * plain.depth_sd_m
    assert plain.depth_m == pytest.approx(0.33, rel=2e-3)
    assert np.degrees(plain.tilt_rad) == pytest.approx(36.7, abs=0.5)


def test_a_pose_that_may_be_flipped_says_so_in_its_covariance() -> None:
    rng = np.random.default_rng(5)
    far = RigidTransform.from_components(
        [0.0, 0.0, 1.0], Rotation.from_euler("yx", [3, 180], degrees=True)
    )
    setting = LensSetting(200.0, 4.0)
    corners_px = lens().camera_at(setting).project(far.apply(marker_corners_m(0.01)))
    noisy = Detection(
        "tag36h11", 7, corners_px + rng.normal(0, 0.05, (4, 2)), 0.0025 * np.eye(8), 0, 1
    )
    found = measured(noisy, lens(), MARKER, setting)
    if found.pose.alternatives:
        assert found.turn_sd_rad > np.sqrt(np.linalg.eigvalsh(found.pose.covariance[3:, 3:])[-1])


def test_corners_of_no_marker_give_nothing() -> None:
    inside_out = Detection(
        "tag36h11", 7, np.array([[0.0, 0], [0, 9], [9, 9], [9, 0]]), np.eye(8), 0, 1.0
    )
    assert measured(inside_out, lens(), MARKER, SETTING) is None

"""Poses from real pictures: a board against motion capture, a marker that is turned by hand."""

import csv
import os
from pathlib import Path

import cv2
import numpy as np
import pytest
from scipy.spatial.transform import Slerp

from tagmetry import Detector
from tagmetry.camera import BrownLens, Camera
from tagmetry.geometry.transforms import RigidTransform, Rotation
from tagmetry.markers import AprilGrid
from tagmetry.pose import estimate_body_pose, estimate_pose

ROOT = Path(__file__).parents[2]
DATA = Path(os.environ.get("TAGMETRY_DATA", ROOT / "../shared/data"))
BOARD = AprilGrid(6, 6, 0.088, 0.3).body()


def folder(name: str) -> Path:
    if not (DATA / name).is_dir():
        pytest.skip(f"no pictures {name}: set TAGMETRY_DATA to the folder that has them")
    return DATA / name


def capture(path: Path):
    """Return times (n,) in ns and poses of a motion capture file."""
    with path.open() as file:
        rows = [[float(x) for x in row[1:]] for row in list(csv.reader(file))[1:]]
    with path.open() as file:
        times = [int(row[0]) for row in list(csv.reader(file))[1:]]
    values = np.array(rows)
    return np.array(times), RigidTransform.from_components(
        values[:, :3], Rotation.from_quat(values[:, 3:])
    )


def seen_board(pictures: Path):
    """Return times and the markers of every picture."""
    detector = Detector(families=["tag36h11_border2"])
    paths = sorted((pictures / "cam0/data").glob("*.jpg"))
    images = [cv2.imread(str(path), cv2.IMREAD_GRAYSCALE) for path in paths]
    return np.array([int(p.stem) for p in paths]), [detector.detect(image) for image in images]


def calibrated(views) -> Camera:
    corners_m = BOARD.corners_m
    points = [
        np.float32(np.concatenate([corners_m[d.family, d.id] for d in seen])) for seen in views
    ]
    pixels = [np.float32(np.concatenate([d.corners_px for d in seen])) for seen in views]
    _, K, coefficients, _, _ = cv2.calibrateCamera(points, pixels, (640, 480), None, None)
    return Camera.from_matrix(640, 480, K, BrownLens(tuple(coefficients.ravel()[:5])))


def hand_eye(Ts_world_body: RigidTransform, Ts_camera_board: RigidTransform) -> RigidTransform:
    """Return T_body_camera with T_world_body T_body_camera T_camera_board the same in all images.

    For motions A of the body and B of the camera between two images it says A X = X B.
    """
    first, second = np.triu_indices(len(Ts_world_body), 1)
    A = Ts_world_body[second].inv() * Ts_world_body[first]
    B = Ts_camera_board[second] * Ts_camera_board[first].inv()
    R_X, _ = Rotation.align_vectors(A.rotation.as_rotvec(), B.rotation.as_rotvec())
    left = (A.rotation.as_matrix() - np.eye(3)).reshape(-1, 3)
    right = (R_X.apply(B.translation) - A.translation).ravel()
    t_X, *_ = np.linalg.lstsq(left, right)
    return RigidTransform.from_components(t_X, R_X)


def at_times(stamps, Ts: RigidTransform, times) -> RigidTransform:
    moved = [np.interp(times, stamps, axis) for axis in Ts.translation.T]
    turned = Slerp(stamps - stamps[0], Ts.rotation)(times - stamps[0])
    return RigidTransform.from_components(np.stack(moved, axis=1), turned)


@pytest.fixture(scope="module")
def board_poses():
    pictures = folder("mocap_aprilgrid")
    times, views = seen_board(pictures)
    camera = calibrated([seen for seen in views if len(seen) >= 6])
    return times, views, [estimate_body_pose(seen, BOARD, camera) for seen in views], camera


def test_board_poses_agree_with_motion_capture(board_poses):
    times, _, poses, camera = board_poses
    stamps, Ts_world_body = capture(folder("mocap_aprilgrid") / "body0/data.csv")
    Ts_world_body = at_times(stamps, Ts_world_body, times)
    Ts_camera_board = RigidTransform.concatenate([p.best.T_camera_marker for p in poses])
    T_body_camera = hand_eye(Ts_world_body, Ts_camera_board)
    Ts_world_board = Ts_world_body * T_body_camera * Ts_camera_board
    shifts_m = Ts_world_board.translation - np.median(Ts_world_board.translation, axis=0)
    apart_mm = 1e3 * np.linalg.norm(shifts_m, axis=1)
    turns = Ts_world_board.rotation * Ts_world_board.rotation.mean().inv()
    apart_deg = np.rad2deg(turns.magnitude())
    print(
        f"hand-eye: median {np.median(apart_mm):.2f} mm, {np.median(apart_deg):.3f} deg, "
        f"fx {camera.focal_px[0]:.1f}"
    )
    assert camera.focal_px[0] == pytest.approx(608, rel=0.02)
    assert np.median(apart_mm) < 5.0
    assert np.median(apart_deg) < 0.35


def test_board_poses_fit_their_corners_and_are_not_ambiguous(board_poses):
    _, views, poses, _ = board_poses
    assert len(poses) == 30
    for seen, pose in zip(views, poses, strict=True):
        assert len(pose.used) >= 0.9 * len(seen)
        assert pose.best.reprojection_rms_px < 1.0
        assert pose.best.probability > 0.99
    assert np.median([p.best.reprojection_rms_px for p in poses]) < 0.5


def test_a_marker_that_is_turned_is_seen_to_turn():
    pictures = folder("yaw_sweep")
    K = np.array([[329.8729619, 0, 528.0], [0, 332.9461130, 396.0], [0, 0, 1]])
    camera = Camera.from_matrix(1056, 792, K)
    detector = Detector(families=["tag36h11"])
    nominal_deg = np.arange(-70, 71, 10)
    normals = []
    for angle in nominal_deg:
        image = cv2.imread(str(pictures / f"test_image_rotation_{angle}.png"), cv2.IMREAD_GRAYSCALE)
        (seen,) = detector.detect(image)
        normals.append(estimate_pose(seen, camera, 0.065).best.T_camera_marker.as_matrix()[:3, 2])
    normals = np.array(normals)
    # the markers turn about one axis: in the plane of the normals, the angle from the middle one
    *_, axes = np.linalg.svd(normals - normals.mean(axis=0))
    across = axes[0] - (axes[0] @ normals[7]) * normals[7]
    measured_deg = np.rad2deg(
        np.arctan2(normals @ across / np.linalg.norm(across), normals @ normals[7])
    )
    measured_deg *= np.sign(measured_deg[-1])
    slope, offset_deg = np.polyfit(nominal_deg, measured_deg, 1)
    residual_deg = measured_deg - slope * nominal_deg - offset_deg
    print(f"slope {slope:.3f}, residuals rms {residual_deg.std():.2f} deg: {measured_deg.round(1)}")
    assert (np.diff(measured_deg) > 4).all()
    assert 0.9 < slope < 1.0, "the angles were set by hand"
    assert np.abs(residual_deg).max() < 5

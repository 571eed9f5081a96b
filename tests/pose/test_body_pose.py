"""Bodies and boards: one pose from all corners, calibrated, and deaf to wrong ones."""

from dataclasses import replace

import numpy as np
import pytest
from seen_markers import (
    DISTORTED,
    PINHOLE,
    body_seen,
    correlated_px2,
    facing,
    flat_board,
    posed,
)

from tagmetry.geometry import mahalanobis_squared, pose_difference
from tagmetry.geometry.transforms import RigidTransform, Rotation
from tagmetry.markers import MarkerBody, cube
from tagmetry.pose import estimate_body_pose, estimate_pose

CUBE = cube("cube", 0.08, 0.06, "tag36h11", [0, 1, 2, 3, 4, 5])
ON_EDGE = Rotation.from_euler("yx", [35, 30], degrees=True) * Rotation.from_euler(
    "x", -90, degrees=True
)
SCENES = {
    "board": (flat_board(), DISTORTED, posed(facing(25, 30, 10), -0.05, 0.02, 0.6)),
    "cube": (CUBE, DISTORTED, posed(ON_EDGE, 0.1, -0.05, 0.6)),
}
NOISE_PX2 = correlated_px2(0.1)


def noisy(name: str, rng):
    body, camera, T = SCENES[name]
    return body_seen(body, camera, T, NOISE_PX2, rng)


def with_wrong_corner(detections, corner=2, shift_px=(9.0, -6.0)):
    corners = detections[1].corners_px.copy()
    corners[corner] += shift_px
    return [detections[0], replace(detections[1], corners_px=corners), *detections[2:]]


def with_moved_marker(detections, shift_px=(7.0, 5.0)):
    moved = replace(detections[1], corners_px=detections[1].corners_px + shift_px)
    return [detections[0], moved, *detections[2:]]


def distances2(name: str, count: int, spoil=list):
    """Return the squared Mahalanobis distances of many trials, and their poses."""
    body, camera, T = SCENES[name]
    rng = np.random.default_rng(11)
    poses = [estimate_body_pose(spoil(noisy(name, rng)), body, camera) for _ in range(count)]
    errors = np.stack([pose_difference(p.best.T_camera_marker, T) for p in poses])
    return mahalanobis_squared(errors, np.stack([p.covariance for p in poses])), poses


def check_calibrated(d2, tolerance):
    assert abs(d2.mean() - 6) < tolerance


@pytest.mark.parametrize("name", SCENES)
def test_exact_corners_give_the_exact_pose(name):
    body, camera, T = SCENES[name]
    exact = body_seen(body, camera, T, np.zeros((8, 8)), np.random.default_rng(0))
    exact = [replace(d, corners_cov_px2=NOISE_PX2) for d in exact]
    pose = estimate_body_pose(exact, body, camera)
    np.testing.assert_allclose(pose_difference(pose.best.T_camera_marker, T), 0, atol=1e-7)
    assert (pose.outliers, pose.noise_scale) == ((), 1.0)
    assert len(pose.used) == len(exact) >= 3
    assert pose.best.probability > 1 - 1e-6


@pytest.mark.parametrize("name", SCENES)
def test_body_covariance_is_calibrated(name):
    d2, poses = distances2(name, 60)
    check_calibrated(d2, 4 * np.sqrt(12 / len(d2)))
    assert np.mean([p.noise_scale > 1 for p in poses]) < 0.1


@pytest.mark.slow
@pytest.mark.parametrize("spoil", [list, with_wrong_corner, with_moved_marker])
def test_board_covariance_of_many_trials(spoil):
    d2, _ = distances2("board", 2000, spoil)
    check_calibrated(d2, 0.5)


@pytest.mark.slow
def test_cube_covariance_of_two_thousand_trials():
    check_calibrated(distances2("cube", 2000)[0], 0.5)


def test_one_wrong_corner_is_found_and_does_no_harm():
    d2, poses = distances2("board", 40, with_wrong_corner)
    check_calibrated(d2, 4 * np.sqrt(12 / len(d2)))
    for pose in poses:
        assert (pose.outliers[0][0].id, pose.outliers[0][1]) == (1, 2)
        assert len(pose.outliers) == 1 or len(pose.outliers) == 2
        assert len(pose.used) == 6
        assert pose.best.reprojection_rms_px < 0.3
    assert np.mean([len(pose.outliers) for pose in poses]) < 1.1


def test_one_moved_marker_is_found_and_does_no_harm():
    d2, poses = distances2("board", 40, with_moved_marker)
    check_calibrated(d2, 4 * np.sqrt(12 / len(d2)))
    for pose in poses:
        wrong = {(key.id, corner) for key, corner in pose.outliers}
        assert {(1, 0), (1, 1), (1, 2), (1, 3)} <= wrong
        assert {key.id for key in pose.used} == {0, 2, 3, 4, 5}


def test_noise_larger_than_stated_widens_the_covariance():
    body, camera, _ = SCENES["board"]
    rng = np.random.default_rng(2)
    seen = [replace(d, corners_cov_px2=NOISE_PX2 / 9) for d in noisy("board", rng)]
    pose = estimate_body_pose(seen, body, camera)
    honest = estimate_body_pose([replace(d, corners_cov_px2=NOISE_PX2) for d in seen], body, camera)
    assert 2 < pose.noise_scale < 4
    assert honest.noise_scale == 1
    ratio = np.sqrt(np.diag(pose.covariance) / np.diag(honest.covariance))
    np.testing.assert_allclose(ratio, pose.noise_scale / 3, rtol=0.05)
    difference = pose_difference(pose.best.T_camera_marker, honest.best.T_camera_marker)
    assert difference @ np.linalg.solve(honest.covariance, difference) < 0.5


def test_a_body_of_one_marker_is_that_marker():
    board = flat_board()
    alone = MarkerBody("one", board.markers[:1])
    T = posed(facing(20), 0, 0, 1.2)
    (seen,) = body_seen(alone, PINHOLE, T, np.eye(8) * 0.09, np.random.default_rng(4))
    as_body = estimate_body_pose([seen], alone, PINHOLE)
    as_marker = estimate_pose(seen, PINHOLE, alone.markers[0].size_m)
    assert len(as_body.hypotheses) == len(as_marker.hypotheses) == 2
    for a, b in zip(as_body.hypotheses, as_marker.hypotheses, strict=True):
        np.testing.assert_allclose(
            pose_difference(a.T_camera_marker, b.T_camera_marker), 0, atol=1e-6
        )
        assert a.probability == pytest.approx(b.probability, abs=1e-6)
        assert a.reprojection_rms_px == pytest.approx(b.reprojection_rms_px, abs=1e-6)


def test_markers_in_several_planes_are_not_ambiguous_where_each_alone_is():
    body, camera, T = CUBE, PINHOLE, posed(ON_EDGE, 0, 0, 2.5)
    rng = np.random.default_rng(3)
    noise = np.eye(8) * 0.3**2
    for _ in range(10):
        seen = body_seen(body, camera, T, noise, rng)
        pose = estimate_body_pose(seen, body, camera)
        assert 1 - pose.best.probability < 1e-3
        assert np.abs(pose_difference(pose.best.T_camera_marker, T)[3:]).max() < np.deg2rad(5)
    alone = [estimate_pose(d, camera, 0.06) for d in seen]
    assert max(a.ambiguity for a in alone) > 1e-3


def test_moving_the_bodys_frame_moves_its_pose():
    body, camera, _ = SCENES["board"]
    T_new_body = RigidTransform.from_components([0.3, -0.1, 0.2], Rotation.from_rotvec([1, 2, 0.5]))
    renamed = MarkerBody(
        "same",
        tuple(replace(m, T_body_marker=T_new_body * m.T_body_marker) for m in body.markers),
    )
    seen = noisy("board", np.random.default_rng(8))
    one = estimate_body_pose(seen, body, camera).best.T_camera_marker
    other = estimate_body_pose(seen, renamed, camera).best.T_camera_marker
    np.testing.assert_allclose(pose_difference(other * T_new_body, one), 0, atol=1e-6)

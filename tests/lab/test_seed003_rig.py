"""The rig of seed 003 is the paper's: OpenCV puts the printed poses where the rig does."""

import cv2
import numpy as np
import pytest

from tagmetry.camera import distortion_reach
from tagmetry.lab.published.seed003 import seed003
from tagmetry.lab.rigs.webcam import (
    BOARD,
    CAMERA,
    PRINTED,
    VIEWS,
    board_picture,
    board_poses,
    to_tutorial,
)


@pytest.mark.parametrize("view", PRINTED)
def test_printed_poses_show_the_board_where_opencv_does(view: int) -> None:
    turn, place = (np.array(part) for part in PRINTED[view])
    columns, rows = np.meshgrid(np.arange(9.0), np.arange(6.0))
    squares = np.stack([columns, rows, 0 * rows], axis=-1).reshape(-1, 3)
    printed = seed003().calibration
    (fx, fy), (cx, cy) = printed.focal_px, printed.center_px
    K = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    expected, _ = cv2.projectPoints(squares, turn, place, K, np.array(printed.coefficients))
    T_camera_board = board_poses()[view]
    np.testing.assert_allclose(
        CAMERA.project(T_camera_board.apply(BOARD.corners_m)), expected[:, 0], atol=1e-8
    )
    np.testing.assert_allclose(to_tutorial(T_camera_board).rotation_rad, turn, atol=1e-12)
    np.testing.assert_allclose(to_tutorial(T_camera_board).translation_squares, place)


def test_every_view_shows_the_whole_board_from_its_face() -> None:
    poses = board_poses()
    assert len(poses) == VIEWS
    for T_camera_board in poses:
        pixels = CAMERA.project(T_camera_board.apply(BOARD.corners_m))
        assert ((pixels > 5) & (pixels < np.array([634, 474]))).all()
        assert T_camera_board.rotation.as_matrix()[2, 2] < 0


def test_views_lean_to_all_sides() -> None:
    normals = np.array([T.rotation.as_matrix()[:, 2] for T in board_poses()])
    assert normals[:, 0].min() < -0.4
    assert normals[:, 0].max() > 0.4
    assert normals[:, 1].min() < -0.4
    assert normals[:, 1].max() > 0.4


def test_the_printed_distortion_folds_back_as_the_remark_says() -> None:
    reach = distortion_reach(CAMERA, 129)
    assert 0.9915 < reach.covered_share < 0.9925
    assert any("0.8 % of the picture" in remark for remark in seed003().remarks)


def test_the_board_fills_the_papers_sheet() -> None:
    assert pytest.approx((0.290, 0.203)) == (BOARD.width_m, BOARD.height_m)


def test_pictures_differ_by_their_noise_alone() -> None:
    first, again, other = (
        board_picture(board_poses()[2], np.random.default_rng(seed)) for seed in (0, 0, 1)
    )
    np.testing.assert_array_equal(first, again)
    difference = first.astype(float) - other
    assert 2.0 < difference.std() < 3.5  # noise of 2 grey values, twice

"""Errors on left-out views: the measured figures of the 13 pictures, and OpenCV done by hand."""

import cv2
import numpy as np
import pytest
from opencv_calibrations import (
    CAMERA,
    board_poses,
    calibration_of,
    real_views,
    simulated_views,
    solved_by_opencv,
)

from tagmetry.calibrate.quality import hold_out
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.errors import InputError


def test_real_pictures_give_the_reference_figures() -> None:
    found = hold_out(solved_by_opencv(real_views(), 5))
    assert found.rms_px == pytest.approx(0.2012, abs=0.0015)
    assert found.alternate_rms_px == pytest.approx(0.2104, abs=0.0015)
    assert found.view_px.max() == pytest.approx(0.267, abs=0.004)
    assert hold_out(solved_by_opencv(real_views(), 4)).rms_px == pytest.approx(0.2012, abs=0.0015)


def test_windows_that_follow_the_spacing_are_better() -> None:
    found = hold_out(solved_by_opencv(real_views(0), 5))
    assert found.rms_px == pytest.approx(0.183, abs=0.002)
    assert found.alternate_rms_px == pytest.approx(0.194, abs=0.002)


def test_a_board_whose_shape_is_released_shows_left_out_views_better() -> None:
    found = hold_out(calibrate(real_views(0), "brown4", shape="free"))
    assert found.rms_px < 0.130  # 0.124 by free points of OpenCV, 0.183 flat


def test_a_left_out_view_by_opencv_alone() -> None:
    views = real_views()
    found = hold_out(solved_by_opencv(views, 5))
    for left_out, alternate in ((0, False), (5, False), (8, True)):
        others = [view for i, view in enumerate(views) if i != left_out]
        camera, own = solved_by_opencv(others, 5).camera, views[left_out]
        fitted = slice(1, None, 2) if alternate else slice(None)
        judged = slice(0, None, 2) if alternate else slice(None)
        D = np.array(camera.lens.coefficients)
        _, rvec, tvec = cv2.solvePnP(
            *(np.ascontiguousarray(a[fitted]) for a in (own.p_board, own.corners_px)),
            camera.matrix,
            D,
        )
        pixels = cv2.projectPoints(own.p_board[judged].copy(), rvec, tvec, camera.matrix, D)[0][
            :, 0
        ]
        rms_px = np.sqrt(((pixels - own.corners_px[judged]) ** 2).sum(axis=1).mean())
        ours = found.view_alternate_px if alternate else found.view_px
        assert ours[left_out] == pytest.approx(rms_px, abs=1e-3)


def test_left_out_views_are_worse_than_fitted_ones() -> None:
    few = solved_by_opencv(real_views()[:5], 5)
    assert hold_out(few).rms_px > few.rms_px * 1.1


def test_without_noise_nothing_is_left() -> None:
    poses = board_poses(6, seed=1)
    views = simulated_views(poses, 1e-9, seed=1)
    assert hold_out(calibration_of(CAMERA, views, poses)).rms_px < 1e-5


def test_many_views_are_left_out_in_groups() -> None:
    poses = board_poses(23, seed=2)
    found = hold_out(calibration_of(CAMERA, simulated_views(poses, 0.1, seed=1), poses))
    assert found.view_px.shape == (23,)
    assert found.rms_px == pytest.approx(np.sqrt(2) * 0.1, rel=0.1)


def test_refuses_three_views() -> None:
    poses = board_poses(3, seed=2)
    calibration = calibration_of(CAMERA, simulated_views(poses, 0.1, seed=1), poses)
    with pytest.raises(InputError, match="at least 4 views to leave one out, got 3"):
        hold_out(calibration)

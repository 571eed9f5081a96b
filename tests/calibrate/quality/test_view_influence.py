"""What a view decides: as OpenCV finds it when it solves without the view."""

import numpy as np
from opencv_calibrations import (
    CAMERA,
    board_poses,
    calibration_of,
    real_views,
    simulated_views,
    solved_by_opencv,
)

from tagmetry.calibrate.quality import camera_difference_px, view_influence
from tagmetry.calibrate.quality.projection import image_grid


def test_without_a_view_opencv_finds_the_camera_foretold() -> None:
    views = real_views()
    calibration = solved_by_opencv(views, 4)
    found = view_influence(calibration)
    corners_px = np.concatenate([view.corners_px for view in views])
    grid = image_grid(calibration.camera, 12, 9)
    for left_out in (0, 2, 5, 9):
        others = [view for i, view in enumerate(views) if i != left_out]
        without = solved_by_opencv(others, 4).camera
        off = camera_difference_px(calibration.camera, without, grid, corners_px)
        shift_px = np.linalg.norm(off, axis=-1)
        np.testing.assert_allclose(
            found.shift_px[left_out], np.sqrt((shift_px**2).mean()), rtol=0.2, atol=0.02
        )
        np.testing.assert_allclose(found.worst_shift_px[left_out], shift_px.max(), rtol=0.2)


def test_shares_add_up_and_a_view_twice_counts_twice() -> None:
    poses = board_poses(8, seed=5)
    views = simulated_views(poses, 0.1, seed=1)
    once = view_influence(calibration_of(CAMERA, views, poses)).information_share
    assert np.isclose(once.sum(), 1)
    assert (once > 0).all()


def test_a_wrong_view_stands_out() -> None:
    poses = board_poses(12, seed=6)
    views = list(simulated_views(poses, 0.05, seed=2))
    x = views[7].p_board[:, :1] / 0.1
    views[7].corners_px[:] += 2.0 * x**2 * [1.0, 0.3]  # the board was bent in this view alone
    found = view_influence(solved_by_opencv(views, 4))
    assert found.shift_px.argmax() == 7


def test_where_the_others_determine_nothing_the_shift_is_beyond_all_bounds() -> None:
    poses = board_poses(2, seed=7)
    found = view_influence(calibration_of(CAMERA, simulated_views(poses, 0.1, seed=2), poses))
    assert not (found.shift_px < 100).any()

"""Two halves of the views: the measured figures of the 13 pictures, and differences by hand."""

from dataclasses import replace

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

from tagmetry.calibrate.quality import camera_difference_px, split_halves
from tagmetry.calibrate.quality.projection import image_grid
from tagmetry.camera import BrownLens, Camera
from tagmetry.errors import InputError

PLAIN = Camera(640, 480, (500.0, 500.0), (319.5, 239.5), BrownLens(()))


def test_real_pictures_with_five_coefficients_disagree_at_the_corners() -> None:
    found = split_halves(solved_by_opencv(real_views(), 5))
    assert 12 < found.worst_px < 20  # 16.4 with another way to remove the turn
    assert 0.7 < found.mean_px < 1.4  # 1.15
    assert found.worst_px / found.expected_px.max() < 2
    four = split_halves(solved_by_opencv(real_views(), 4))
    assert four.worst_px < 0.4 * found.worst_px


def test_each_half_is_what_opencv_finds() -> None:
    views = real_views()
    found = split_halves(solved_by_opencv(views, 4))
    for camera, half in zip(found.cameras, (views[::2], views[1::2]), strict=True):
        expected = solved_by_opencv(half, 4).camera
        np.testing.assert_allclose(camera.focal_px, expected.focal_px, atol=0.02)
        np.testing.assert_allclose(camera.center_px, expected.center_px, atol=0.02)


def test_difference_is_as_large_as_expected_where_only_noise_is() -> None:
    poses, ratios = board_poses(16, seed=0), []
    for seed in range(12):
        found = split_halves(solved_by_opencv(simulated_views(poses, 0.1, seed=50 + seed), 4), 8, 6)
        ratios.append(found.length_px / found.expected_px)
    assert 0.75 < np.sqrt(np.mean(np.square(ratios))) < 1.4  # the whole image moves as one


def test_a_camera_does_not_differ_from_itself() -> None:
    grid = image_grid(CAMERA, 5, 4)
    found = camera_difference_px(CAMERA, CAMERA, grid, grid.reshape(-1, 2))
    np.testing.assert_allclose(found, 0, atol=1e-8)


def test_a_longer_focal_length_moves_pixels_outward() -> None:
    grid = image_grid(PLAIN, 5, 5)
    longer = replace(PLAIN, focal_px=(505.0, 505.0))
    found = camera_difference_px(PLAIN, longer, grid, grid.reshape(-1, 2))
    np.testing.assert_allclose(found, 0.01 * (grid - PLAIN.center_px), atol=1e-6)


def test_a_turn_makes_up_for_a_shift() -> None:
    middle = np.random.default_rng(0).uniform([280, 200], [360, 280], (50, 2))
    shifted = replace(PLAIN, center_px=(324.5, 239.5))
    found = camera_difference_px(PLAIN, shifted, middle, middle)
    assert np.abs(found).max() < 0.1


def test_refuses_few_views() -> None:
    poses = board_poses(5, seed=2)
    calibration = calibration_of(CAMERA, simulated_views(poses, 0.1, seed=1), poses)
    with pytest.raises(InputError, match="at least 6 views to split, got 5"):
        split_halves(calibration)

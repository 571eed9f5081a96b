"""Patterns in the errors: those put in are found, noise is none, the real board's is known."""

from dataclasses import replace

import numpy as np
import pytest
from opencv_calibrations import (
    BOARD,
    CAMERA,
    board_poses,
    calibration_of,
    real_views,
    simulated_views,
    solved_by_opencv,
)

from tagmetry.calibrate.quality import residual_field
from tagmetry.errors import InputError

POSES = board_poses(15, seed=3)
CALIBRATION = calibration_of(CAMERA, simulated_views(POSES, 0.1, seed=7), POSES)


def with_errors(errors):
    return replace(CALIBRATION, residuals_px=tuple(errors))


def test_noise_is_no_pattern() -> None:
    found = residual_field(CALIBRATION)
    assert found.noise_px == pytest.approx(0.1, rel=0.1)
    for means in (found.over_image, found.over_board, found.over_radius):
        assert not means.is_pattern


def test_errors_of_a_board_are_found_at_its_points() -> None:
    own = np.random.default_rng(0).normal(0, 0.1, (54, 2))
    found = residual_field(with_errors([e + own for e in CALIBRATION.residuals_px]))
    assert found.over_board.is_pattern
    assert np.abs(found.over_board.mean_px - own).max() < 5 * 0.1 / np.sqrt(15)
    np.testing.assert_allclose(found.over_board.places, BOARD.corners_m)
    assert (found.over_board.count == 15).all()


def test_errors_along_the_radius_are_found_in_rings() -> None:
    errors = []
    for view, error in zip(CALIBRATION.views, CALIBRATION.residuals_px, strict=True):
        arm = view.corners_px - CAMERA.center_px
        errors.append(error + 0.002 * arm)
    found = residual_field(with_errors(errors), columns=8).over_radius
    assert found.is_pattern
    full = found.count > 50
    np.testing.assert_allclose(found.mean_px[full, 0], 0.002 * found.places[full, 0], atol=0.06)
    np.testing.assert_allclose(found.mean_px[full, 1], 0, atol=0.04)


def test_errors_of_a_part_of_the_image_are_found_there() -> None:
    errors = []
    for view, error in zip(CALIBRATION.views, CALIBRATION.residuals_px, strict=True):
        here = (view.corners_px >= [319.5, 239.5]).all(axis=1)
        errors.append(error + here[:, None] * [0.3, -0.2])
    found = residual_field(with_errors(errors), 2, 2).over_image
    assert found.is_pattern
    np.testing.assert_allclose(found.mean_px[3], [0.3, -0.2], atol=0.05)
    np.testing.assert_allclose(found.mean_px[:3], 0, atol=0.05)
    np.testing.assert_allclose(found.places[3], [479.5, 359.5])
    assert found.count.sum() == 15 * 54


def test_corners_left_out_do_not_count() -> None:
    kept = tuple(np.arange(54) < 50 for _ in CALIBRATION.views)
    found = residual_field(replace(CALIBRATION, kept=kept))
    assert found.over_image.count.sum() == 15 * 50
    assert len(found.over_board.count) == 50


def test_the_real_board_is_not_as_its_maker_says() -> None:
    found = residual_field(solved_by_opencv(real_views(), 5))
    assert found.over_board.rms_px == pytest.approx(0.088, abs=0.003)
    assert found.over_board.is_pattern


def test_empty_cells_have_no_mean() -> None:
    found = residual_field(CALIBRATION, 30, 20).over_image
    assert np.isnan(found.mean_px[found.count == 0]).all()
    assert np.isfinite(found.rms_px)


def test_refuses_no_cells() -> None:
    with pytest.raises(InputError, match="at least one cell, got 0x8"):
        residual_field(CALIBRATION, 0)

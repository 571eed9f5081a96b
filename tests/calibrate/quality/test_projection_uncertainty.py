"""Uncertainty over the image: equal to the spread of many noisy solutions, by OpenCV alone."""

from dataclasses import replace

import cv2
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
from scipy.optimize import least_squares

from tagmetry.calibrate.quality import projection_uncertainty
from tagmetry.calibrate.quality.motion import implied_motion
from tagmetry.camera import BrownLens, Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform

POSES = board_poses(10, seed=4)
SD_PX = 0.1


def exact():
    """A calibration at the truth whose errors are noise of a known size."""
    return calibration_of(CAMERA, simulated_views(POSES, SD_PX, seed=5), POSES)


def project(camera: Camera, p_camera: Array) -> Array:
    """Project by OpenCV."""
    D = np.pad(camera.lens.coefficients, (0, 5 - len(camera.lens.coefficients)))
    zero = np.zeros(3)
    return cv2.projectPoints(p_camera, zero, zero, camera.matrix, D)[0][:, 0]


def rays(camera: Camera, pixels: Array) -> Array:
    """Unproject by OpenCV."""
    D = np.pad(camera.lens.coefficients, (0, 5 - len(camera.lens.coefficients)))
    criteria = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 200, 1e-13)
    xy = cv2.undistortPoints(pixels[:, None], camera.matrix, D, None, None, None, criteria)[:, 0]
    return np.column_stack([xy, np.ones(len(xy))])


def moved_as_implied(camera: Camera, Ts: RigidTransform) -> tuple[Array, Array]:
    """Return the rotation and translation after which another camera shows the boards best."""
    points = np.concatenate([T.apply(BOARD.corners_m) for T in Ts])
    seen = project(CAMERA, points)

    def errors(motion: Array) -> Array:
        R = cv2.Rodrigues(motion[3:])[0]
        return (project(camera, points @ R.T + motion[:3]) - seen).ravel()

    motion = least_squares(errors, np.zeros(6), x_scale=1e-3).x
    return cv2.Rodrigues(motion[3:])[0], motion[:3]


@pytest.mark.parametrize("distance_m", [0.6, np.inf])
def test_spread_of_noisy_solutions_is_what_is_predicted(distance_m: float) -> None:
    predicted = projection_uncertainty(exact(), 5, 4, distance_m)
    pixels = predicted.pixels.reshape(-1, 2)
    sight = rays(CAMERA, pixels)
    sight /= np.linalg.norm(sight, axis=1, keepdims=True)
    off = []
    for seed in range(60):
        solved = solved_by_opencv(simulated_views(POSES, SD_PX, seed=100 + seed), 4)
        R, t = moved_as_implied(solved.camera, POSES)
        points = sight @ R.T + (0 if np.isinf(distance_m) else t / distance_m)
        off.append(project(solved.camera, points) - pixels)
    off = np.array(off)
    found = np.sqrt((off**2).mean(axis=0))
    np.testing.assert_allclose((found / predicted.sd_xy_px.reshape(-1, 2)).mean(), 1, atol=0.12)
    covariance = predicted.covariance_px2.reshape(-1, 2, 2)
    chi2 = np.einsum("sgi,gij,sgj->sg", off, np.linalg.inv(covariance), off)
    np.testing.assert_allclose(chi2.mean(), 2, atol=0.4)


def test_a_turn_makes_up_for_most_of_a_shift_of_the_principal_point() -> None:
    far = Camera(640, 480, (2000.0, 2000.0), (320.0, 240.0), BrownLens(()))
    points = np.random.default_rng(0).uniform([-0.1, -0.1, 0.9], [0.1, 0.1, 1.5], (100, 3))
    left = implied_motion(far, points).remaining(points)[..., 2]
    assert np.abs(left).max() < 0.02


def test_remaining_change_is_that_of_finite_differences() -> None:
    points = np.random.default_rng(0).uniform([-0.2, -0.2, 0.5], [0.2, 0.2, 0.9], (50, 3))
    motion = implied_motion(CAMERA, points)
    step = np.array([0.5, -0.4, 0.3, 0.2, 1e-4, -1e-4, 1e-5, 1e-5])
    focal, center = CAMERA.focal_px + step[:2], CAMERA.center_px + step[2:4]
    lens = BrownLens(tuple(CAMERA.lens.coefficients + step[4:]))
    other = replace(CAMERA, focal_px=tuple(focal), center_px=tuple(center), lens=lens)
    by = motion.by_intrinsics @ step
    moved = points + by[:3] + np.cross(by[3:], points)
    change = other.project(moved) - CAMERA.project(points)
    np.testing.assert_allclose(motion.remaining(points) @ step, change, atol=2e-3)
    better = [
        (other.project(points + d[:3] + np.cross(d[3:], points)) - CAMERA.project(points))
        for d in by + 1e-4 * np.eye(6)
    ]
    assert all((change**2).sum() <= (one**2).sum() for one in better)


def test_order_of_views_does_not_matter() -> None:
    views = simulated_views(POSES, SD_PX, seed=5)
    order = np.random.default_rng(0).permutation(len(views))
    turned = calibration_of(CAMERA, [views[i] for i in order], POSES[order])
    np.testing.assert_allclose(
        projection_uncertainty(turned).sd_px, projection_uncertainty(exact()).sd_px, rtol=1e-6
    )


def test_four_times_the_covariance_is_twice_the_deviation() -> None:
    once = projection_uncertainty(exact())
    four = projection_uncertainty(exact(), covariance=4 * exact().camera.covariance)
    np.testing.assert_allclose(four.sd_px, 2 * once.sd_px, rtol=1e-9)
    assert (once.sd_px >= once.sd_xy_px.max(axis=-1) * (1 - 1e-9)).all()
    assert once.worst_px == once.sd_px.max()
    row, column = np.unravel_index(once.sd_px.argmax(), once.sd_px.shape)
    assert once.worst_pixel == tuple(once.pixels[row, column])


def test_grid_goes_from_corner_to_corner() -> None:
    pixels = projection_uncertainty(exact(), 3, 2).pixels
    np.testing.assert_array_equal(pixels[[0, -1], [0, -1]], [[0, 0], [639, 479]])


def test_what_the_lens_does_not_show_is_not_a_number() -> None:
    folding = replace(CAMERA, lens=BrownLens((-0.5, 0.0, 0.0, 0.0)), focal_px=(300.0, 300.0))
    calibration = calibration_of(folding, simulated_views(POSES, SD_PX, 1, folding), POSES)
    found = projection_uncertainty(calibration)
    assert np.isnan(found.sd_px[0, 0])
    assert 0 < found.unshown_share < 1
    assert np.isfinite([found.worst_px, found.middle_px]).all()


def test_real_pictures_leave_the_left_corners_open() -> None:
    five = projection_uncertainty(solved_by_opencv(real_views(), 5), 9, 7).sd_px
    assert five[3, 4] < 0.12  # mrcal's figure for the centre
    assert min(five[0, 0], five[-1, 0]) > 4.9  # mrcal: 4.9 and 5.6 with smaller errors of corners
    four = projection_uncertainty(solved_by_opencv(real_views(), 4), 9, 7).sd_px
    np.testing.assert_allclose(
        four[[0, -1], 0] / four[[0, -1], -1], 2, atol=0.25
    )  # mrcal: 2.0, 2.2


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"columns": 1}, "grid of at least 2x2, got 1x15"),
        ({"distance_m": 0.0}, "distance_m must be positive, got 0.0"),
        ({"distance_m": np.nan}, "distance_m must be positive, got nan"),
    ],
)
def test_refuses(words: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        projection_uncertainty(exact(), **words)


def test_refuses_a_camera_without_covariance() -> None:
    bare = replace(exact(), camera=CAMERA)
    with pytest.raises(InputError, match="whose camera has a covariance"):
        projection_uncertainty(bare)

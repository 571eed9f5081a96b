"""Rays meet planes where points were; covariances are those of Monte Carlo."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from overhead import CAMERA, VIEW, moved, robot, seen
from scipy.optimize import least_squares

from tagmetry.arena import Mount, OverheadView, Roster, fit_squares, point_on_plane, sight
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform, mahalanobis_squared
from tagmetry.geometry.transforms import Rotation

PLACE = np.array([0.7, -0.4, 2.0])
CAMERA_SD = np.array([3e-4, 4e-4, 5e-4, 3e-4, 2e-4, 4e-4])


@pytest.mark.parametrize("height_m", [0.0, 0.093, 0.5])
def test_a_ray_meets_the_plane_where_the_point_was(height_m: float) -> None:
    rng = np.random.default_rng(0)
    p_world = np.column_stack([rng.uniform(-0.9, 0.9, 40), rng.uniform(-0.6, 0.6, 40)])
    p_world = np.column_stack([p_world, np.full(40, height_m)])
    pixels = CAMERA.project(VIEW.T_world_camera.inv().apply(p_world))
    np.testing.assert_allclose(VIEW.points_on_plane(pixels, height_m), p_world, atol=1e-9)


def test_a_ray_that_looks_up_meets_no_floor() -> None:
    level = OverheadView(
        CAMERA,
        RigidTransform.from_components([0, 0, 1], Rotation.from_euler("x", -90, degrees=True)),
        np.zeros((6, 6)),
    )
    above_horizon, below_horizon = level.points_on_plane(np.array([[900.0, 100.0], [900.0, 900.0]]))
    assert np.isnan(above_horizon).all()
    assert below_horizon[2] == pytest.approx(0, abs=1e-12)


def test_covariance_of_a_point_is_that_of_many_trials() -> None:
    rng = np.random.default_rng(1)
    stated = OverheadView(CAMERA, VIEW.T_world_camera, np.diag(CAMERA_SD**2))
    p_world = np.array([0.8, 0.5, 0.1])
    errors, covariances = [], []
    for _ in range(400):
        height_m = 0.1 + 2e-3 * rng.standard_normal()
        true = moved(stated, CAMERA_SD * rng.standard_normal(6))
        pixel = CAMERA.project(true.T_world_camera.inv().apply([0.8, 0.5, height_m]))
        pixel = pixel + 0.1 * rng.standard_normal(2)
        found, covariance = point_on_plane(stated, pixel, 0.01 * np.eye(2), 0.1, 2e-3)
        errors.append(found - p_world[:2])
        covariances.append(covariance)
    assert mahalanobis_squared(np.array(errors), np.array(covariances)).mean() == pytest.approx(
        2.0, abs=0.3
    )


@pytest.mark.parametrize(
    "mount",
    [Mount(0.1), Mount(0.05, 0.02, -0.01, 0.4), Mount(0.3, -0.05, 0.03, -2.5)],
    ids=["plain", "turned", "high and turned"],
)
def test_a_robot_is_found_below_its_marker(mount: Mount) -> None:
    one = replace(robot(3), mount=mount)
    found = sight([seen(one, PLACE)], Roster((one,)), VIEW)
    np.testing.assert_allclose(found.places[0], PLACE, atol=1e-9)
    assert found.chi2[0] == pytest.approx(0, abs=1e-9)


def test_neglecting_the_height_is_what_makes_the_published_error() -> None:
    """A marker 93 mm above the floor under a camera at 2.5 m: 38 mm of error in the mean."""
    places = np.random.default_rng(2).uniform([-1.3, -0.75, -3], [1.3, 0.75, 3], (200, 3))
    high = robot(3, 0.093)
    detections = [seen(high, place) for place in places]
    flat = Roster((replace(high, mount=Mount(0.0)),))
    errors = [sight([d], flat, VIEW).places[0] - p for d, p in zip(detections, places, strict=True)]
    lengths_mm = 1000 * np.hypot(*np.array(errors)[:, :2].T)
    assert 30 < lengths_mm.mean() < 45
    assert 50 < lengths_mm.max() < 70


def test_noise_and_common_errors_are_as_stated() -> None:
    rng = np.random.default_rng(3)
    stated = OverheadView(CAMERA, VIEW.T_world_camera, np.diag(CAMERA_SD**2))
    one = robot(3, 0.1, forward_m=0.03, left_m=0.02, turn_rad=0.5, height_sd_m=2e-3)
    errors, covariances = [], []
    for _ in range(300):
        true_height = one.mount.height_m + one.mount.height_sd_m * rng.standard_normal()
        true = replace(one, mount=replace(one.mount, height_m=true_height))
        view = moved(stated, CAMERA_SD * rng.standard_normal(6))
        found = sight([seen(true, PLACE, view, rng)], Roster((one,)), stated)
        errors.append(found.places[0] - PLACE)
        covariances.append(found.noise[0] + found.common[0])
    assert mahalanobis_squared(np.array(errors), np.array(covariances)).mean() == pytest.approx(
        3.0, abs=0.4
    )


def test_chi2_of_a_right_mount_has_five_degrees_of_freedom() -> None:
    rng, one = np.random.default_rng(4), robot(3, 0.1, forward_m=0.03, turn_rad=0.5)
    found = sight([seen(one, PLACE, VIEW, rng) for _ in range(400)], Roster((one,)), VIEW)
    assert found.chi2.mean() == pytest.approx(5.0, abs=0.5)


def test_a_wrong_size_is_told_by_more_noise() -> None:
    one = robot(3)
    wrong = Roster((replace(one, marker_size_m=0.084),))
    right, off = (sight([seen(one, PLACE)], r, VIEW) for r in (Roster((one,)), wrong))
    assert off.chi2[0] > 100
    assert np.trace(off.noise[0]) > 20 * np.trace(right.noise[0])


def test_markers_of_no_robot_and_unusable_ones_are_passed_over() -> None:
    one = robot(3)
    good = seen(one, PLACE)
    broken = [
        replace(good, corners_px=np.full((4, 2), np.nan)),
        replace(good, corners_cov_px2=np.zeros((8, 8))),
        replace(good, corners_px=np.zeros((3, 2))),
        replace(good, corners_cov_px2=np.full((8, 8), np.inf)),
        replace(good, id=77),
        replace(good, family="tag25h9"),
    ]
    assert len(sight(broken, Roster((one,)), VIEW)) == 0
    assert len(sight([*broken, good], Roster((one,)), VIEW)) == 1
    assert len(sight([], Roster((one,)), VIEW)) == 0


def test_refuses_a_roster_with_something_twice() -> None:
    with pytest.raises(InputError, match="the id 3 stands at two robots"):
        Roster((robot(3), replace(robot(3), marker_id=4)))
    with pytest.raises(InputError, match="the marker tag36h11 id 3 stands at two robots"):
        Roster((robot(3), replace(robot(4), marker_id=3)))


@pytest.mark.parametrize(
    ("kind", "match"),
    [
        (lambda: robot(-1), "id is 0 to 65535"),
        (lambda: replace(robot(1), diameter_m=0.0), "diameter_m must be positive"),
        (lambda: replace(robot(1), marker_size_m=float("nan")), "marker_size_m must be positive"),
        (lambda: Mount(float("inf")), "height_m must be finite"),
        (lambda: Mount(0.1, height_sd_m=-1), "height_sd_m must not be negative"),
    ],
)
def test_refuses_numbers_that_no_robot_has(kind: Callable[[], object], match: str) -> None:
    with pytest.raises(InputError, match=match):
        kind()


def test_a_robots_key_is_not_shown() -> None:
    assert "secret" not in repr(replace(robot(1), key=b"secret"))


def test_a_fit_is_exact_at_the_images_corner() -> None:
    at_corner = sight([seen(robot(3), np.array([0.95, 0.6, 1.0]))], Roster((robot(3),)), VIEW)
    np.testing.assert_allclose(at_corner.places[0], [0.95, 0.6, 1.0], atol=1e-9)


def test_squares_that_cannot_be_placed_are_unknown_and_leave_the_others_alone() -> None:
    """No ray, no covariance, and a plane above the camera."""
    clean = seen(robot(3), PLACE)
    corners_px, heights_m = np.array([clean.corners_px] * 4), np.full(4, 0.1)
    covariances_px2 = np.array([clean.corners_cov_px2] * 4)
    corners_px[0, 2], covariances_px2[1], heights_m[2] = np.nan, -np.eye(8), 9.0
    sizes_m = np.full(4, robot(3).marker_size_m)
    fits = fit_squares(VIEW, corners_px, covariances_px2, sizes_m, heights_m)
    alone = fit_squares(VIEW, corners_px[3:], covariances_px2[3:], sizes_m[3:], heights_m[3:])
    for name, values in vars(fits).items():
        assert np.isnan(values[:3]).all(), name
        np.testing.assert_allclose(values[3:], getattr(alone, name), rtol=1e-6, atol=1e-9)


def test_pixels_move_with_the_camera_as_they_are_said_to() -> None:
    p_world = np.random.default_rng(6).uniform([-0.8, -0.5, 0], [0.8, 0.5, 0.3], (7, 3))
    pixels, by_point = VIEW.project(p_world)
    said = VIEW.by_camera(p_world, by_point)
    for axis, change in enumerate(1e-6 * np.eye(6)):
        found = (moved(VIEW, change).project(p_world)[0] - pixels) / 1e-6
        np.testing.assert_allclose(said[..., axis], found, atol=2e-2)  # of some 500 px / m


def test_a_fit_is_the_least_squares_of_the_corners() -> None:
    """SciPy, from another parametrization, and with a covariance that is not round."""
    rng = np.random.default_rng(7)
    root = 0.05 * (np.eye(8) + 0.3 * rng.standard_normal((8, 8)))
    one = robot(3)
    for place in rng.uniform([-0.9, -0.55, -3], [0.9, 0.55, 3], (10, 3)):
        clean = seen(one, place)
        noisy = clean.corners_px + (root @ rng.standard_normal(8)).reshape(4, 2)
        detection = replace(clean, corners_px=noisy, corners_cov_px2=root @ root.T)

        def residuals(numbers: np.ndarray, noisy: np.ndarray = noisy) -> np.ndarray:
            return np.linalg.solve(root, (seen(one, numbers).corners_px - noisy).ravel())

        best = least_squares(residuals, place, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        found = sight([detection], Roster((one,)), VIEW)
        np.testing.assert_allclose(found.places[0], best.x, atol=5e-7)
        assert found.chi2[0] == pytest.approx(2 * best.cost, rel=1e-3)
        np.testing.assert_allclose(
            found.noise[0], np.linalg.inv(best.jac.T @ best.jac), rtol=1e-2, atol=1e-9
        )

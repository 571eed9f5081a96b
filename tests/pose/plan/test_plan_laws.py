"""The parts of an error budget: each against a way of its own to find it."""

from dataclasses import replace

import numpy as np
import pytest
from planned_pictures import CAMERA, measured, planned
from scipy.stats import norm

from tagmetry.camera import BrownLens, Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array, pose_difference
from tagmetry.pose.marker import solve
from tagmetry.pose.plan import (
    Imaging,
    Setup,
    over_volume,
    predict,
    range_m,
    shortest_side_px,
    solved,
)
from tagmetry.pose.plan.predict import position_m

SETUP = Setup(CAMERA, 0.12, 2.5, tilt_deg=30.0, pixel=(400.0, 300.0))
PLAIN = Camera(640, 480, (600.0, 600.0), (319.5, 239.5))


def rms_m(errors: Array) -> float:
    return float(np.sqrt((errors[:, :3] ** 2).sum(axis=1).mean()))


def test_the_parts_add_up() -> None:
    one = predict(SETUP)
    np.testing.assert_allclose(
        one.covariance, one.by_corners + one.by_calibration + one.by_size, rtol=1e-12
    )
    parts = (one.by_corners, one.by_calibration, one.by_size)
    assert one.position_m**2 == pytest.approx(sum(position_m(part) ** 2 for part in parts))


def test_a_camera_without_covariance_adds_nothing() -> None:
    one = predict(replace(SETUP, camera=replace(CAMERA, covariance=None)))
    assert one.by_calibration is None
    np.testing.assert_allclose(one.covariance, one.by_corners + one.by_size)


def test_noise_of_corners_is_that_of_poses_solved_from_them() -> None:
    one, rng, count = predict(SETUP), np.random.default_rng(0), 800
    noise = rng.multivariate_normal(np.zeros(8), one.corners_cov_px2, count).reshape(-1, 4, 2)
    covariances = np.tile(one.corners_cov_px2, (count, 1, 1))
    found = solve(SETUP.corners_px + noise, covariances, np.full(count, SETUP.size_m), CAMERA)
    T = SETUP.T_camera_marker
    errors = np.array([pose_difference(each[0].T_camera_marker, T) for each in found])
    d2 = np.einsum("ni,ij,nj->n", errors, np.linalg.inv(one.by_corners), errors)
    assert d2.mean() == pytest.approx(6, abs=4 * np.sqrt(12 / count))


def test_errors_of_intrinsics_are_those_of_poses_solved_with_them() -> None:
    one, rng, errors = predict(SETUP), np.random.default_rng(1), []
    numbers = [*CAMERA.focal_px, *CAMERA.center_px, *CAMERA.lens.coefficients]
    for fx, fy, cx, cy, *bends in rng.multivariate_normal(numbers, CAMERA.covariance, 300).tolist():
        wrong = replace(CAMERA, focal_px=(fx, fy), center_px=(cx, cy), lens=BrownLens(tuple(bends)))
        sizes_m = np.array([SETUP.size_m])
        found = solve(SETUP.corners_px[None], one.corners_cov_px2[None], sizes_m, wrong)[0]
        errors.append(pose_difference(found[0].T_camera_marker, SETUP.T_camera_marker))
    sample = np.cov(np.array(errors).T)
    scale = np.sqrt(np.outer(np.diag(one.by_calibration), np.diag(one.by_calibration)))
    np.testing.assert_allclose(sample / scale, one.by_calibration / scale, atol=0.25)


def test_a_wrong_size_moves_the_marker_along_the_line_of_sight() -> None:
    one = predict(replace(SETUP, size_sd_m=0.0012))
    assert position_m(one.by_size) == pytest.approx(0.025)
    sight = np.asarray(SETUP.T_camera_marker.translation) / 2.5
    np.testing.assert_allclose(one.by_size[:3, :3], 0.025**2 * np.outer(sight, sight))
    assert not one.by_size[3:].any()


@pytest.mark.parametrize(("tilt_deg", "noise"), [(8.0, 40.0), (20.0, 60.0), (4.0, 15.0)])
def test_flips_are_those_of_noisy_corners(tilt_deg: float, noise: float) -> None:
    setup = Setup(PLAIN, 0.1, 1.5, tilt_deg, 20.0, imaging=Imaging(noise))
    one, count = predict(setup), 2000
    rng = np.random.default_rng(2)
    off = rng.multivariate_normal(np.zeros(8), one.corners_cov_px2, count).reshape(-1, 4, 2)
    covariances = np.tile(one.corners_cov_px2, (count, 1, 1))
    found = solve(setup.corners_px + off, covariances, np.full(count, 0.1), PLAIN)
    T = setup.T_camera_marker
    wrong = [_is_flipped([pose_difference(h.T_camera_marker, T) for h in each]) for each in found]
    assert np.mean(wrong) == pytest.approx(one.flip_probability, abs=0.03)


def _is_flipped(errors: list[Array]) -> bool:
    turns = [np.linalg.norm(error[3:]) for error in errors]
    return bool(turns[0] > min(turns))


def test_flips_follow_the_rule_of_thumb() -> None:
    """P = Q(sin(tilt) L^2 / (2 f s)) for corners that are independent."""
    setup = Setup(PLAIN, 0.1, 2.0, 12.0, imaging=Imaging(40.0))
    one = predict(setup)
    rule = norm.sf(np.sin(np.radians(12)) * 30.0**2 / (2 * 600 * one.corner_px))
    assert 0.02 < one.flip_probability < 0.4
    assert one.flip_probability == pytest.approx(rule, abs=0.1)


def test_a_square_view_of_a_large_marker_cannot_flip() -> None:
    assert predict(Setup(PLAIN, 0.1, 0.3, tilt_deg=0.0)).flip_probability == 0


@pytest.mark.parametrize("number", [0, 4, 7, 16])
def test_markers_are_found_within_the_range_and_not_far_beyond(number: int) -> None:
    setup = planned(number)
    far_m, rng = range_m(setup), np.random.default_rng(number)
    within, beyond = (replace(setup, distance_m=k * far_m) for k in (0.9, 1.6))
    assert measured(within, 40, rng).found >= 0.95
    assert measured(beyond, 20, rng).found < 0.5


def test_the_range_is_where_the_shortest_side_is_just_long_enough() -> None:
    far = replace(SETUP, distance_m=range_m(SETUP))
    assert far.short_side_px == pytest.approx(shortest_side_px(far), rel=1e-3)
    assert range_m(replace(SETUP, distance_m=9.0)) == range_m(SETUP)


def test_what_moves_too_fast_is_found_nowhere() -> None:
    fast = replace(SETUP, speed_m_s=8.0)
    assert range_m(fast) == 0
    with pytest.raises(InputError, match="found at no distance"):
        over_volume(fast)


@pytest.mark.parametrize("free", ["size", "distance", "resolution"])
def test_what_is_solved_for_is_just_enough(free: str) -> None:
    setup = Setup(replace(CAMERA, covariance=None), 0.1, 3.0, size_sd_m=1e-5)
    want_m = 0.7 * predict(setup).position_m
    answer = solved(setup, want_m, free)
    assert predict(answer).position_m == pytest.approx(want_m, rel=0.03)
    assert predict(answer).position_m <= want_m
    changed = {
        "size": answer.size_m > setup.size_m,
        "distance": answer.distance_m < setup.distance_m,
        "resolution": answer.camera.width_px > CAMERA.width_px,
    }
    assert changed[free]


def test_the_cheapest_marker_that_is_found_at_all() -> None:
    answer = solved(Setup(CAMERA, 0.1, 1.5), 1.0, "size")
    assert answer.short_side_px == pytest.approx(shortest_side_px(answer), rel=0.01)


def test_what_nothing_can_reach() -> None:
    with pytest.raises(InputError, match=r"no size gives 0\.1 mm: .* of which the calibration"):
        solved(SETUP, 1e-4, "size")
    with pytest.raises(InputError, match="want_m must be positive, got nan"):
        solved(SETUP, np.nan, "size")


def test_the_volume_is_the_same_left_and_right_and_worse_far_off() -> None:
    volume = over_volume(Setup(PLAIN, 0.1, 1.0, tilt_deg=0.0), columns=3, rows=4)
    assert volume.position_m.shape == (4, 3)
    np.testing.assert_allclose(volume.x_m[:, 0], -volume.x_m[:, 2], rtol=1e-9)
    middle = volume.position_m[:, 1]
    assert (np.diff(middle[np.isfinite(middle)]) > 0).all()
    known = np.isfinite(volume.position_m[:, 0])
    np.testing.assert_allclose(
        volume.position_m[known, 0], volume.position_m[known, 2], rtol=0.1
    )  # the picture of a marker is not symmetric


@pytest.mark.parametrize(
    ("changed", "why"),
    [
        ({"size_m": 0.0}, "size_m must be positive, got 0.0"),
        ({"distance_m": np.inf}, "distance_m must be positive, got inf"),
        ({"tilt_deg": 88.0}, "tilt_deg must be from 0 to 85 degrees"),
        ({"direction_deg": np.nan}, "direction_deg must be finite"),
        ({"speed_m_s": -1.0}, "speed_m_s must be at least 0"),
    ],
)
def test_what_cannot_be_planned(changed: dict[str, float], why: str) -> None:
    with pytest.raises(InputError, match=why):
        replace(SETUP, **changed)


def test_pictures_that_cannot_be() -> None:
    with pytest.raises(InputError, match=r"0 < black < white <= 255, got 90\.0 and 80\.0"):
        Imaging(black_grey=90.0, white_grey=80.0)
    with pytest.raises(InputError, match="noise_grey must be at least 0, got nan"):
        Imaging(noise_grey=np.nan)


def test_a_marker_that_does_not_fit() -> None:
    with pytest.raises(InputError, match=r"all of a marker of 120 mm at 0\.05 m"):
        predict(replace(SETUP, distance_m=0.05))


@pytest.mark.parametrize(
    ("changed", "why"),
    [
        ({"distance_m": 100.0}, r"120 mm at 100 m has 1.* px in the image, too few"),
        ({"size_m": 1e-9}, "too few to tell anything"),
        ({"speed_m_s": 100.0}, r"moves 408 px while the shutter is open, farther than its side"),
    ],
)
def test_a_marker_that_is_hardly_seen(changed: dict[str, float], why: str) -> None:
    with pytest.raises(InputError, match=why):
        predict(replace(SETUP, **changed))


@pytest.mark.parametrize(
    "imaging", [Imaging(0.0, blur_px=0.0), Imaging(blur_px=30.0), Imaging(1e6), Imaging(2, 99, 100)]
)
def test_pictures_however_bad_have_a_prediction(imaging: Imaging) -> None:
    one = predict(replace(SETUP, imaging=imaging))
    assert np.isfinite(one.covariance).all()
    assert 0 <= one.flip_probability <= 0.5

"""Where a distortion polynomial folds back, and how much of the image lies within."""

import numpy as np
import pytest
from example_cameras import ALL_14, CAMERAS, camera_with
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.camera import BrownLens, Camera, FisheyeLens, brown, distortion_reach
from tagmetry.camera.fold import least_positive_root

SEED_003 = (-0.11785701583978955, 1.5199508775591315, -0.016984594698011175, -0.0015, -5.275)
GOOD = (-0.28, 0.09, 0.0004, -0.0002, -0.01)


def radial_gain(r: np.ndarray, k: tuple[float, ...]) -> np.ndarray:
    k1, k2, _, _, k3, k4, k5, k6 = np.pad(k, (0, 8 - len(k)))
    return (1 + k1 * r**2 + k2 * r**4 + k3 * r**6) / (1 + k4 * r**2 + k5 * r**4 + k6 * r**6)


def fold_by_search(image_radius: np.ndarray, radius: np.ndarray) -> float:
    falls = np.flatnonzero(np.diff(image_radius) <= 0)
    return float(radius[falls[0]]) if falls.size else np.inf


def test_seed_003_folds_inside_its_own_image() -> None:
    camera = Camera(640, 480, (698.5, 698.5), (319.5, 239.5), BrownLens(SEED_003))
    reach = distortion_reach(camera)
    assert not reach.is_monotonic
    assert 0.8 < reach.covered_share < 0.999
    fold = np.tan(reach.fold_angle_rad)
    assert fold * radial_gain(fold, SEED_003) < np.hypot(320, 240) / 698.5
    assert np.isnan(camera.unproject(np.array([0.0, 0.0]))).all()
    assert np.isfinite(camera.unproject(np.array([319.5, 0.0]))).all()


@pytest.mark.parametrize("lens", [BrownLens(), BrownLens(GOOD), FisheyeLens()])
def test_a_good_lens_covers_its_image(lens: BrownLens | FisheyeLens) -> None:
    reach = distortion_reach(Camera(640, 480, (698.5, 698.5), (319.5, 239.5), lens))
    assert reach.is_monotonic
    assert reach.covered_share == 1.0


def test_the_share_counts_pixels_within_the_fold() -> None:
    lens = BrownLens((-0.5, 0.0, 0.0, 0.0))  # r - r^3 / 2 grows to r = sqrt(2 / 3)
    camera = Camera(201, 201, (100.0, 100.0), (100.0, 100.0), lens)
    edge = np.sqrt(2 / 3) * (1 - 1 / 3)
    assert distortion_reach(camera, 401).covered_share == pytest.approx(
        np.pi * edge**2 / 2.01**2, abs=0.01
    )


@given(st.lists(st.floats(-2.0, 2.0), min_size=6, max_size=6))
def test_the_fold_radius_is_where_a_search_finds_it(k: list[float]) -> None:
    coefficients = (k[0], k[1], 0.0, 0.0, *k[2:])
    radius = np.linspace(0, 3, 60_001)
    with np.errstate(divide="ignore", invalid="ignore"):
        expected = fold_by_search(radius * radial_gain(radius, coefficients), radius)
    found = np.tan(BrownLens(coefficients).fold_angle_rad)
    below = 1 + radius**2 * (k[3] + radius**2 * (k[4] + radius**2 * k[5]))
    pole = radius[np.flatnonzero(below <= 0)[:1]]
    expected = min([expected, *pole])
    assert found == pytest.approx(expected, abs=2e-3) or (found >= 2.999 and expected == np.inf)


@given(st.lists(st.floats(-0.2, 0.2), min_size=4, max_size=4))
def test_the_fold_angle_of_a_fisheye_is_where_a_search_finds_it(k: list[float]) -> None:
    angle = np.linspace(0, np.pi, 50_001)
    t2 = angle**2
    radius = angle * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))))
    expected = min(fold_by_search(radius, angle), np.pi)
    assert FisheyeLens(tuple(k)).fold_angle_rad == pytest.approx(expected, abs=2e-3)


@pytest.mark.parametrize("share", [1.001, 1.2, 3.0])
def test_a_point_beyond_the_fold_is_not_seen(share: float) -> None:
    camera = camera_with(BrownLens(SEED_003))
    fold = np.tan(camera.lens.fold_angle_rad)
    assert np.isnan(camera.project(np.array([share * fold, 0.0, 1.0]))).all()
    assert np.isfinite(camera.project(np.array([0.999 * fold, 0.0, 1.0]))).all()


def test_a_ray_beyond_a_fisheye_s_fold_is_not_seen() -> None:
    lens = FisheyeLens((-0.1, 0.0, 0.0, 0.0))  # t - t^3 / 10 grows to sqrt(10 / 3)
    assert lens.fold_angle_rad == pytest.approx(np.sqrt(10 / 3))
    angles = lens.fold_angle_rad + np.array([-0.01, 0.01])
    points = np.stack([np.sin(angles), np.zeros(2), np.cos(angles)], axis=-1)
    found = camera_with(lens).project(points)
    np.testing.assert_array_equal(np.isnan(found[:, 0]), [False, True])


def test_a_pixel_beyond_a_fisheye_s_widest_radius_has_no_ray() -> None:
    lens = FisheyeLens((-0.1, 0.0, 0.0, 0.0))
    widest = np.sqrt(10 / 3) * (1 - 1 / 3)
    rays = lens.straighten(np.array([[0.999 * widest, 0.0], [1.001 * widest, 0.0]]))
    np.testing.assert_array_equal(np.isnan(rays[:, 0]), [False, True])


@pytest.mark.parametrize("kind", CAMERAS)
def test_every_pixel_with_a_ray_is_where_that_ray_projects(kind: str) -> None:
    camera = CAMERAS[kind]
    pixels = np.stack(np.meshgrid(np.arange(0, 640, 40), np.arange(0, 480, 40)), axis=-1)
    rays = camera.unproject(pixels)
    assert np.isfinite(rays).all()
    np.testing.assert_allclose(np.linalg.norm(rays, axis=-1), 1)
    np.testing.assert_allclose(camera.project(rays), pixels, atol=1e-6)


def test_all_coefficients_together_reach_over_the_image() -> None:
    assert distortion_reach(camera_with(BrownLens(ALL_14))).is_monotonic


def test_a_ray_from_the_folded_side_is_not_given() -> None:
    """Decentring folds before the radius does: the one solution there is mirrored."""
    lens = BrownLens((0.78, -0.36, 0.1, 0.05, -0.06))
    beyond = brown.distort(np.array([0.54936176, -0.96749082]), np.pad(lens.coefficients, (0, 9)))
    assert np.isnan(lens.straighten(beyond)).all()


def test_a_step_from_a_singular_point_is_quiet() -> None:
    lens = BrownLens((0.0, 0.0, 0.0, -1 / 3))  # x' = x - x^2 is level at x = 1/2 and at most 1/4
    assert np.isnan(lens.straighten(np.array([0.5, 0.0]))).all()


@pytest.mark.parametrize("bent", [0.9, 30.0, 1e6, 1e12])
def test_a_pole_of_the_rational_gain_is_never_reached(bent: float) -> None:
    lens = BrownLens((0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0))  # r / (1 - r^2)
    ray = lens.straighten(np.array([bent, 0.0]))
    if bent < 100:
        radius = (np.hypot(1, 2 * bent) - 1) / (2 * bent)
        assert ray[0] / ray[2] == pytest.approx(radius)
    assert not np.isinf(ray).any()


@pytest.mark.parametrize(
    ("rising", "expected"),
    [
        ([1.0], np.inf),
        ([1.0, 0.5], np.inf),
        ([1.0, -0.5], 2.0),
        ([1.0, 0.0, 1.0], np.inf),
        ([1.0, -1.5, 0.5], 1.0),
        ([1.0, -1.0, 1e-200], 1.0),
        ([1.0, -1e-13], np.inf),
        ([1.0, -1e-320], np.inf),
    ],
)
def test_the_least_positive_root(rising: list[float], expected: float) -> None:
    assert least_positive_root(np.array(rising)) == pytest.approx(expected)


def test_the_share_counts_up_to_the_far_edge() -> None:
    lens = BrownLens((-0.5, 0.0, 0.0, 0.0))
    edge_px = 100 * np.sqrt(2 / 3) * (1 - 1 / 3)
    wide = Camera(401, 1, (100.0, 100.0), (0.0, 0.0), lens)
    high = Camera(1, 401, (100.0, 100.0), (0.0, 0.0), lens)
    for camera in (wide, high):
        covered = distortion_reach(camera, 801).covered_share
        assert covered == pytest.approx((edge_px + 0.5) / 401, abs=0.002)

"""A spread edge has the profile that calculus gives, wherever it lies on the grid."""

import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import ndtr

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array, FloatImage
from tagmetry.twin.optics.spread import Spread, fine_scale, gaussian_kernel, pixel_means, spread

PLACES_PX = np.random.default_rng(0).uniform(-0.5, 0.5, 40)  # of an edge, from a pixel's centre


def edge_image(width_px: int, place_px: float, fine: int) -> FloatImage:
    """Return light right of an upright edge, the exact mean of every point of the grid."""
    left_px = np.arange(width_px * fine) / fine - 0.5
    covered = np.clip((left_px + 1 / fine - place_px) * fine, 0, 1)
    return np.tile(covered.astype(np.float32), (3 * fine, 1))


def disc_edge(x_px: Array | float, radius_px: float) -> Array:
    """Return an edge under a disc, at points: the share of the disc right of the edge."""
    x = np.clip(np.asarray(x_px) / radius_px, -1, 1)
    return 1 / 2 + (x * np.sqrt(1 - x**2) + np.arcsin(x)) / np.pi


def joint_edge(x_px: Array | float, by: Spread) -> Array:
    """Return an edge under both: the Gaussian's, mean over the disc by the angle x = R cos a."""
    angles = (np.arange(200) + 0.5) / 200 * np.pi
    weights = np.sin(angles) ** 2
    places = np.asarray(x_px)[..., None] - by.disc_px * np.cos(angles)
    return ndtr(places / by.gaussian_px) @ weights / weights.sum()


def point_edge(x_px: Array, by: Spread) -> Array:
    """Return an edge at 0 under a spread, at points."""
    if by.disc_px == 0:
        return ndtr(x_px / by.gaussian_px)
    return disc_edge(x_px, by.disc_px) if by.gaussian_px == 0 else joint_edge(x_px, by)


def pixel_edge(by: Spread, first_px: float, count: int) -> Array:
    """Return what pixels see of an edge at 0: means of the profile over 1 px, shape (count,)."""
    within_px = (np.arange(100) + 0.5) / 100 - 0.5
    at_px = first_px + np.arange(count)[:, None] + within_px
    return point_edge(at_px, by).mean(axis=1)


def profile_errors(by: Spread, fine: int) -> Array:
    """Return the errors of the pixels around an edge at many places, shape (places, pixels)."""
    half = int(np.ceil(by.disc_px + 5 * by.gaussian_px)) + 2
    errors = []
    for place_px in PLACES_PX:
        image = edge_image(2 * half + 1, half + place_px, fine)
        seen = pixel_means(spread(image, fine, by), fine)[1]
        errors.append(seen - pixel_edge(by, -half - place_px, 2 * half + 1))
    return np.array(errors)


SPREADS = [
    *[Spread(gaussian_px=width) for width in (0.15, 0.3, 0.6, 1.0, 2.5)],
    *[Spread(disc_px=radius) for radius in (0.3, 0.5, 1.0, 2.2, 7.0, 20.0, 80.0)],
    Spread(0.4, 0.5),
    Spread(0.6, 2.0),
    Spread(2.0, 3.0),
]


def test_the_closed_forms_agree_with_quadrature() -> None:
    line = quad(lambda t: 2 / np.pi * np.sqrt(1 - t**2), -1, 0.3)[0]
    assert disc_edge(0.6, 2.0) == pytest.approx(line, abs=1e-10)
    both = quad(lambda t: 2 / np.pi * np.sqrt(1 - t**2) * ndtr((0.6 - 2 * t) / 0.5), -1, 1)[0]
    assert joint_edge(0.6, Spread(0.5, 2.0)) == pytest.approx(both, abs=1e-8)
    box = quad(lambda t: ndtr(t / 0.6), -0.2, 0.8)[0]
    assert pixel_edge(Spread(0.6), 0.3, 1)[0] == pytest.approx(box, abs=1e-5)


@pytest.mark.parametrize("by", SPREADS, ids=str)
def test_on_the_grid_it_asks_for_an_edge_is_exact_to_a_thousandth(by: Spread) -> None:
    assert np.abs(profile_errors(by, fine_scale(by))).max() < 1e-3


@pytest.mark.parametrize("by", [Spread(0.6), Spread(0.4, 0.5), Spread(disc_px=2.2)], ids=str)
@pytest.mark.parametrize("contrast_error", [2e-3, 4e-3])
def test_a_coarser_grid_keeps_the_error_it_was_asked_for(by: Spread, contrast_error: float) -> None:
    fine = fine_scale(by, contrast_error)
    assert fine < fine_scale(by)
    assert np.abs(profile_errors(by, fine)).max() < contrast_error


def test_on_a_coarse_grid_the_mean_over_places_is_still_right() -> None:
    by = Spread(0.6)
    places_px = (np.arange(64) + 0.5) / 64 - 0.5
    seen = [pixel_means(spread(edge_image(11, 5 + p, 2), 2, by), 2)[1] for p in places_px]
    true = [pixel_edge(by, -5 - p, 11) for p in places_px]
    bias = np.mean([a[3:8] - b[3:8] for a, b in zip(seen, true, strict=True)], axis=0)
    assert np.abs(bias).max() < 1e-3
    first = np.array([a.sum() for a in seen]) - (5.5 - places_px)
    np.testing.assert_allclose(first, 0.0, atol=1e-4)  # no edge has moved, wherever it lies


def test_an_edge_that_runs_askew_has_the_same_profile() -> None:
    by, fine, size_px, turn_rad = Spread(0.5, 1.5), 5, 20, 0.4
    normal = np.array([np.cos(turn_rad), np.sin(turn_rad)])
    at = (np.arange(size_px * fine * 16) + 0.5) / (fine * 16) - size_px / 2
    right = (normal[0] * at + normal[1] * at[:, None] > 0.13).reshape(size_px * fine, 16, -1, 16)
    seen = pixel_means(spread(right.mean(axis=(1, 3), dtype=np.float32), fine, by), fine)
    inner = (np.arange(8) + 0.5) / 8 - 0.5
    for row, column in ((10, 10), (9, 11), (12, 8), (8, 8), (11, 10)):
        x, y = column - (size_px - 1) / 2 + inner, row - (size_px - 1) / 2 + inner[:, None]
        distances = (normal[0] * x + normal[1] * y - 0.13).ravel()
        expected = np.mean([joint_edge(d, by) for d in distances])
        assert seen[row, column] == pytest.approx(expected, abs=1e-3)


@given(st.floats(0.0, 30.0))
def test_a_gaussian_kernel_has_its_deviation(deviation: float) -> None:
    kernel = gaussian_kernel(deviation)
    at = np.arange(len(kernel)) - len(kernel) // 2
    assert kernel.sum() == pytest.approx(1.0, abs=1e-12)
    assert kernel @ at**2 == pytest.approx(deviation**2, rel=2e-4, abs=1e-12)
    assert kernel.min() >= 0
    np.testing.assert_allclose(kernel, kernel[::-1], atol=1e-16)


@pytest.mark.parametrize("by", [Spread(0.8), Spread(disc_px=2.5), Spread(0.8, 2.5)], ids=str)
def test_a_point_keeps_its_light_and_its_place_and_gains_the_second_moment(by: Spread) -> None:
    fine, size = 4, 121
    point = np.zeros((size + 3, size + 3), np.float32)
    point[60, 60] = 1.0
    light = spread(point, fine, by).astype(np.float64)
    at = (np.arange(size + 3) - 60) / fine
    assert light.sum() == pytest.approx(1.0, abs=1e-5)
    assert light.sum(axis=0) @ at == pytest.approx(0.0, abs=1e-5)
    variance_px2 = by.gaussian_px**2 + by.disc_px**2 / 4
    assert light.sum(axis=0) @ at**2 == pytest.approx(variance_px2, rel=2e-3)


def test_turns_with_the_image() -> None:
    image = np.random.default_rng(1).random((24, 36), dtype=np.float32)
    by = Spread(0.7, 1.3)
    turned = spread(np.ascontiguousarray(np.rot90(image)), 2, by)
    np.testing.assert_allclose(turned, np.rot90(spread(image, 2, by)), atol=1e-6)


@pytest.mark.parametrize("by", [Spread(3.0), Spread(disc_px=80.0), Spread(1.0, 12.0)], ids=str)
def test_the_border_goes_on_as_it_ends(by: Spread) -> None:
    even = np.full((40, 60), 0.7, np.float32)
    np.testing.assert_allclose(spread(even, 2, by), 0.7, atol=2e-6)
    image = np.random.default_rng(2).random((20, 30), dtype=np.float32)
    wide = spread(np.pad(image, 400, mode="edge"), 2, by)[400:420, 400:430]
    np.testing.assert_allclose(spread(image, 2, by), wide, atol=1e-5)


def test_without_spread_the_image_is_returned_as_it_is() -> None:
    image = np.random.default_rng(3).random((8, 12), dtype=np.float32)
    assert spread(image, 4, Spread()) is image
    assert pixel_means(image, 1) is image
    assert fine_scale(Spread()) == 1


def test_pixels_are_means_of_their_points() -> None:
    image = np.random.default_rng(4).random((12, 18), dtype=np.float32)
    expected = image.reshape(4, 3, 6, 3).mean(axis=(1, 3))
    np.testing.assert_allclose(pixel_means(image, 3), expected, atol=1e-6)


def test_what_is_very_soft_needs_no_fine_grid() -> None:
    assert fine_scale(Spread(8.0)) == 1
    assert fine_scale(Spread(0.1, 80.0)) == 1
    assert fine_scale(Spread(0.6)) > fine_scale(Spread(1.2)) > 1


def test_an_image_of_one_point_stays_what_it_was() -> None:
    one = np.full((1, 1), 0.3, np.float32)
    assert spread(one, 1, Spread(2.0, 30.0))[0, 0] == pytest.approx(0.3, abs=1e-6)


def test_the_image_given_is_not_changed() -> None:
    image = np.random.default_rng(5).random((8, 12), dtype=np.float32)
    before = image.copy()
    spread(image, 2, Spread(1.0, 1.0))
    np.testing.assert_array_equal(image, before)


@pytest.mark.parametrize("width_px", [-0.1, float("nan"), float("inf"), 1e9])
def test_refuses_widths_that_are_none(width_px: float) -> None:
    with pytest.raises(InputError, match="gaussian_px must be between 0 and 500"):
        Spread(gaussian_px=width_px)
    with pytest.raises(InputError, match="disc_px must be between 0 and 500"):
        Spread(disc_px=width_px)


def test_refuses_images_that_are_no_grid_of_pixels() -> None:
    good = np.zeros((8, 12), np.float32)
    with pytest.raises(InputError, match="expected 5 points a pixel, got an image of shape"):
        spread(good, 5, Spread(1.0))
    with pytest.raises(InputError, match="fine must be at least 1, got 0"):
        pixel_means(good, 0)
    with pytest.raises(InputError, match=r"expected an image of shape \(height, width\)"):
        spread(np.zeros((0, 4), np.float32), 1, Spread(1.0))
    with pytest.raises(InputError, match="expected a float32 image, got uint8"):
        spread(good.astype(np.uint8), 1, Spread(1.0))
    with pytest.raises(InputError, match="contrast_error must be positive"):
        fine_scale(Spread(1.0), 0.0)


def test_a_large_image_is_spread_at_once(capsys: pytest.CaptureFixture) -> None:
    image = np.random.default_rng(6).random((2160, 3840), dtype=np.float32)
    start_s = time.process_time()
    pixel_means(spread(image, 2, Spread(0.6)), 2)
    spent_s = time.process_time() - start_s
    with capsys.disabled():
        print(f"\n1080p on a grid twice as fine, Gaussian: {spent_s:.3f} s of CPU")
    assert spent_s < 1

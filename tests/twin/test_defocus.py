"""Defocus that changes over the image: against the closed form of an edge, and point by point."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array, FloatImage
from tagmetry.twin.optics.defocus import spread_by_depth
from tagmetry.twin.optics.spread import Spread, pixel_means, spread

FINE = 4


def edge_right_of(place_px: float, height_px: int, width_px: int) -> FloatImage:
    left_px = np.arange(width_px * FINE) / FINE - 0.5
    covered = np.clip((left_px + 1 / FINE - place_px) * FINE, 0, 1)
    return np.tile(covered.astype(np.float32), (height_px * FINE, 1))


def disc_edge(x_px: Array, radius_px: float) -> Array:
    """Return pixels 1 px wide under an edge at 0 out of focus: means of the closed form."""
    within = (np.arange(200) + 0.5) / 200 - 0.5
    x = np.clip((x_px[:, None] + within) / radius_px, -1, 1)
    return (1 / 2 + (x * np.sqrt(1 - x**2) + np.arcsin(x)) / np.pi).mean(axis=1)


@pytest.mark.parametrize("place_px", [30.0, 29.8])
def test_an_edge_down_a_tilted_sheet_is_as_soft_as_each_row_is_out_of_focus(
    place_px: float,
) -> None:
    height_px, width_px = 200, 60
    radius_px = np.linspace(1.0, 9.0, height_px * FINE)
    radii_px = np.tile(radius_px[:, None], (1, width_px * FINE)).astype(np.float32)
    image = edge_right_of(place_px, height_px, width_px)
    seen = pixel_means(spread_by_depth(image, FINE, radii_px), FINE)
    for row in range(height_px):
        own_px = float(radius_px[row * FINE : (row + 1) * FINE].mean())
        expected = disc_edge(np.arange(width_px) - place_px, own_px)
        np.testing.assert_allclose(seen[row], expected, atol=3.5e-3)


def test_equals_the_sum_over_every_points_own_disc() -> None:
    rng = np.random.default_rng(0)
    image = edge_right_of(7.3, 16, 16) + 0.2 * (rng.random((16 * FINE, 16 * FINE)) > 0.5)
    image = image.astype(np.float32)
    radii_px = rng.choice([0.0, *np.linspace(0.25, 3, 30)], image.shape).astype(np.float32)
    seen = spread_by_depth(image, FINE, radii_px, gaussian_px=0.3)
    expected = np.empty_like(image)
    for radius_px in np.unique(radii_px):
        own = spread(image, FINE, Spread(0.3, float(radius_px)))
        expected[radii_px == radius_px] = own[radii_px == radius_px]
    np.testing.assert_allclose(seen, expected, atol=3e-3)


def test_one_radius_everywhere_is_the_plain_spread() -> None:
    image = np.random.default_rng(1).random((40, 60), dtype=np.float32)
    radii_px = np.full(image.shape, 1.7)
    np.testing.assert_array_equal(
        spread_by_depth(image, 2, radii_px, 0.5), spread(image, 2, Spread(0.5, 1.7))
    )


def test_tiles_of_an_image_fit_together() -> None:
    image = np.random.default_rng(5).random((40, 120), dtype=np.float32)
    radii_px = np.tile(np.linspace(0.0, 5.0, 120), (40, 1))
    whole = spread_by_depth(image, 2, radii_px, 0.4)
    left = spread_by_depth(image[:, :80].copy(), 2, radii_px[:, :80], 0.4)
    right = spread_by_depth(image[:, 40:].copy(), 2, radii_px[:, 40:], 0.4)
    np.testing.assert_allclose(left[:, :60], whole[:, :60], atol=1e-5)
    np.testing.assert_allclose(right[:, 20:], whole[:, 60:], atol=1e-5)


def test_in_focus_everywhere_the_image_is_returned_as_it_is() -> None:
    image = np.random.default_rng(2).random((8, 12), dtype=np.float32)
    assert spread_by_depth(image, 2, np.zeros(image.shape)) is image


@pytest.mark.parametrize("gaussian_px", [0.0, 1.5])
def test_what_is_in_focus_stays_sharp_beside_what_is_not(gaussian_px: float) -> None:
    image = np.random.default_rng(3).random((60, 80), dtype=np.float32)
    radii_px = np.zeros(image.shape, np.float32)
    radii_px[:, 40:] = 0.25 * 1.1**33  # a level of its own
    seen = spread_by_depth(image, 2, radii_px, gaussian_px)
    sharp = spread(image, 2, Spread(gaussian_px))
    np.testing.assert_allclose(seen[:, :40], sharp[:, :40], atol=1e-6)
    soft = spread(image, 2, Spread(gaussian_px, 0.25 * 1.1**33))
    np.testing.assert_allclose(seen[:, 40:], soft[:, 40:], atol=1e-5)


def test_an_even_image_stays_even() -> None:
    radii_px = np.random.default_rng(4).uniform(0, 30, (40, 60))
    even = np.full((40, 60), 0.4, np.float32)
    np.testing.assert_allclose(spread_by_depth(even, 2, radii_px, 1.0), 0.4, atol=2e-6)


def test_one_point_is_an_image_too() -> None:
    one = np.full((1, 1), 0.4, np.float32)
    assert spread_by_depth(one, 1, np.full((1, 1), 5.0))[0, 0] == pytest.approx(0.4, abs=1e-6)


def test_refuses_radii_that_do_not_belong() -> None:
    image = np.zeros((8, 12), np.float32)
    with pytest.raises(InputError, match=r"expected radii of shape \(8, 12\), got \(12, 8\)"):
        spread_by_depth(image, 1, np.zeros((12, 8)))
    for bad in (np.nan, np.inf, -1.0):
        radii_px = np.zeros((8, 12))
        radii_px[3, 4] = bad
        with pytest.raises(InputError, match="defocus radii must be finite and not negative"):
            spread_by_depth(image, 1, radii_px)

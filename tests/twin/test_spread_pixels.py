"""The one pass gives what the two steps give."""

import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.errors import InputError
from tagmetry.twin.optics.spread import Spread, pixel_means, spread
from tagmetry.twin.optics.spread_pixels import spread_pixels


@given(st.integers(1, 5), st.integers(1, 12), st.integers(1, 12), st.floats(0.0, 4.0))
def test_equals_the_pixel_means_of_the_spread_image(
    fine: int, height_px: int, width_px: int, gaussian_px: float
) -> None:
    size = (height_px * fine, width_px * fine)
    image = np.random.default_rng(height_px).random(size, dtype=np.float32)
    by = Spread(gaussian_px)
    seen = spread_pixels(image, fine, by)
    assert seen.dtype == np.float32
    assert seen.shape == (height_px, width_px)
    np.testing.assert_allclose(seen, pixel_means(spread(image, fine, by), fine), atol=2e-6)


def test_an_edge_is_where_and_as_soft_as_it_was() -> None:
    """A step at a pixel's edge under a Gaussian: pixels beside it show the mean of its integral."""
    fine, by = 8, Spread(0.6)
    image = np.zeros((3 * fine, 20 * fine), np.float32)
    image[:, 10 * fine :] = 1.0  # the edge stands at 9.5
    row = spread_pixels(image, fine, by)[1]
    # The mean of Phi(x / 0.6) for x from 0 to 1 and from 1 to 2, by tables of the normal integral.
    np.testing.assert_allclose(row[10:12], [0.772531, 0.988171], atol=1e-3)
    np.testing.assert_allclose(row[8:10], [1 - 0.988171, 1 - 0.772531], atol=1e-3)


def test_a_disc_and_no_spread_at_all_are_possible_too() -> None:
    image = np.random.default_rng(0).random((24, 36), dtype=np.float32)
    by = Spread(0.4, 1.2)
    np.testing.assert_array_equal(spread_pixels(image, 3, by), pixel_means(spread(image, 3, by), 3))
    np.testing.assert_array_equal(spread_pixels(image, 3, Spread()), pixel_means(image, 3))
    assert spread_pixels(image, 1, Spread()) is image


def test_a_view_of_a_larger_image_will_do() -> None:
    image = np.random.default_rng(1).random((40, 60), dtype=np.float32)
    window = image[4:20, 6:30]
    by = Spread(0.7)
    np.testing.assert_array_equal(spread_pixels(window, 2, by), spread_pixels(window.copy(), 2, by))


def test_refuses_what_is_no_grid() -> None:
    with pytest.raises(InputError, match="expected 5 points a pixel"):
        spread_pixels(np.zeros((8, 12), np.float32), 5, Spread(1.0))
    with pytest.raises(InputError, match="expected a float32 image, got float64"):
        spread_pixels(np.zeros((8, 12)), 2, Spread(1.0))


def test_a_large_image_is_spread_at_once(capsys: pytest.CaptureFixture) -> None:
    image = np.random.default_rng(2).random((4320, 7680), dtype=np.float32)
    spread_pixels(image[:8, :8], 4, Spread(0.6))
    start_s = time.process_time()
    spread_pixels(image, 4, Spread(0.6))
    spent_s = time.process_time() - start_s
    with capsys.disabled():
        print(f"\n1080p on a grid four times as fine, Gaussian: {spent_s:.3f} s of CPU")
    assert spent_s < 2

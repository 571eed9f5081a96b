"""What fits reckon with: medians by counting, normal equations and their inverses."""

import numpy as np
import pytest

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.noise import LEAST_NOISE, count_sizes, new_counts, noise_of
from tagmetry.detect.photometric.normal import add_products, factor, inverse_seen, solve
from tagmetry.geometry import Array


def noise_told_by(sizes: Array) -> float:
    counts = new_counts()
    count_sizes(sizes.astype(np.float32), len(sizes), 1, counts)
    return noise_of(counts)


@pytest.mark.parametrize("noise", [0.5, 2.0, 8.0, 37.0])
def test_noise_is_that_of_the_median_size(noise: float) -> None:
    sizes = np.abs(np.random.default_rng(0).normal(0, noise, 301))
    assert noise_told_by(sizes) == pytest.approx(np.median(sizes) / 0.6745, rel=0.02)


def test_a_third_of_gross_errors_does_not_make_pixels_noisy() -> None:
    sizes = np.abs(np.random.default_rng(1).normal(0, 2.0, 300))
    sizes[::3] = np.array([255.0, np.inf, np.nan] * 34)[:100]
    assert noise_told_by(sizes) < 2 * 2.0


def test_noise_is_never_less_than_that_of_rounding() -> None:
    assert noise_told_by(np.zeros(40)) == LEAST_NOISE


@pytest.mark.parametrize("count", [10, 18, 23])
def test_solves_and_inverts_what_equations_say(count: int) -> None:
    rng, lanes = np.random.default_rng(2), 3 * row.BLOCK
    equations = np.zeros((row.MOST_NUMBERS, row.LANES), dtype=np.float32)
    equations[:] = rng.normal(size=equations.shape) * rng.uniform(0.1, 100, (row.MOST_NUMBERS, 1))
    sums = np.zeros((row.MOST_NUMBERS, row.MOST_NUMBERS))
    add_products(equations.ravel(), lanes, sums, count)
    residuals, J = equations[0, :lanes].astype(float), equations[1 : count + 1, :lanes].T
    L, scale = np.zeros((count, count)), np.ones(count)
    assert factor(sums, L, scale)
    expected = np.linalg.lstsq(J.astype(float), residuals, rcond=None)[0]
    np.testing.assert_allclose(solve(L, scale, sums), expected, rtol=1e-3, atol=1e-6)
    asked = rng.normal(size=(13, count))
    covariance = asked @ np.linalg.inv(J.T.astype(float) @ J) @ asked.T
    np.testing.assert_allclose(
        inverse_seen(L, scale, asked), covariance, rtol=1e-3, atol=1e-4 * np.abs(covariance).max()
    )


def test_equations_that_say_the_same_have_no_solution() -> None:
    sums = np.ones((row.MOST_NUMBERS, row.MOST_NUMBERS))
    sums[5, 5] = -1.0
    assert not factor(sums, np.zeros((10, 10)), np.ones(10))

"""The covariance drawn between formula and sandwich: by its scores alone, which are quick to draw.

Scores are made without the solver: a view's are normal with a covariance of its own share of the
information, times what its shared errors add. The estimate's error is independent of them.
"""

import numpy as np
import pytest
from scipy import stats

from tagmetry.calibrate.covariance import drawn_to_formula
from tagmetry.geometry import Array

COUNT = 9


def parts_of(views: int, rng: np.random.Generator) -> Array:
    """Return shares of information of views near and far, that sum to the identity."""
    roots = rng.normal(size=(views, COUNT, 14)) * rng.uniform(0.5, 1.5, (views, 1, 1))
    parts = roots @ np.swapaxes(roots, 1, 2)
    L = np.linalg.inv(np.linalg.cholesky(parts.sum(axis=0)))
    return np.asarray(L @ parts @ L.T)


def covered(views: int, variances: Array, runs: int = 1500) -> tuple[float, float]:
    """Return how often the truth is inside, and the geometric mean of the stated variances."""
    rng = np.random.default_rng(3)
    limit = stats.chi2.ppf(0.95, COUNT)
    inside, sizes = [], []
    for _ in range(runs):
        parts = parts_of(views, rng)
        roots = np.linalg.cholesky(parts)
        scores = (roots @ rng.normal(size=(views, COUNT, 1)))[..., 0] * np.sqrt(variances)
        covariance = drawn_to_formula(scores, parts, 1.0)
        error = rng.normal(size=COUNT) * np.sqrt(variances)
        inside.append(error @ np.linalg.solve(covariance, error) < limit)
        sizes.append(np.linalg.slogdet(covariance)[1] / COUNT)
    return float(np.mean(inside)), float(np.exp(np.mean(sizes)))


def test_independent_corners_get_about_the_formula() -> None:
    inside, size = covered(35, np.ones(COUNT))
    assert 0.94 < inside < 0.98  # the formula itself: 0.95, with an sd of 0.006 from 1 500 runs
    assert 1.0 < size < 1.2


@pytest.mark.parametrize(
    "variances",
    [np.full(COUNT, 10.0), np.geomspace(1.0, 30.0, COUNT), np.array([20.0] * 3 + [1.0] * 6)],
    ids=["all", "graded", "some"],
)
def test_errors_that_views_share_are_covered(variances: Array) -> None:
    inside, _ = covered(35, variances)
    assert inside > 0.93


def test_few_views_err_to_the_large_side() -> None:
    inside, size = covered(10, np.full(COUNT, 10.0), runs=500)
    assert inside > 0.93
    assert size > 10


def test_no_direction_is_surer_than_the_formula() -> None:
    rng = np.random.default_rng(4)
    parts = parts_of(20, rng)
    for growth in (0.0, 0.3, 1.0, 5.0):
        scores = growth * rng.normal(size=(20, COUNT)) / np.sqrt(20)
        assert np.linalg.eigvalsh(drawn_to_formula(scores, parts, 2.0)).min() >= 2.0 * (1 - 1e-12)


def test_units_do_not_matter() -> None:
    rng = np.random.default_rng(5)
    parts, scores = parts_of(20, rng), rng.normal(size=(20, COUNT))
    here, there = drawn_to_formula(scores, parts, 1.0), drawn_to_formula(3 * scores, parts, 9.0)
    np.testing.assert_allclose(there, 9 * here)
    turn = np.linalg.qr(rng.normal(size=(COUNT, COUNT)))[0]
    turned = drawn_to_formula(scores @ turn.T, turn @ parts @ turn.T, 1.0)
    np.testing.assert_allclose(turned, turn @ here @ turn.T, atol=1e-12)

"""Views in arrays: errors in standard deviations, and what is no covariance."""

from dataclasses import replace

import numpy as np
import pytest
from seen_boards import USUAL, seen

from tagmetry.calibrate.sightings import gather, whitening
from tagmetry.calibrate.view import mean_sd_px, round_covariances
from tagmetry.errors import InputError

RNG = np.random.default_rng(4)
ROOTS = RNG.normal(0, 0.2, (54, 2, 2)) + 0.05 * np.eye(2)
SLANTED = ROOTS @ np.swapaxes(ROOTS, 1, 2)
VIEW = replace(seen(USUAL, 1, RNG)[0], covariances_px2=SLANTED)


def test_whitened_errors_have_the_covariance_of_unit_noise() -> None:
    W = whitening(SLANTED)
    np.testing.assert_allclose(W @ SLANTED @ np.swapaxes(W, 1, 2), np.eye(2) + np.zeros((54, 2, 2)),
                               atol=1e-9)  # fmt: skip
    np.testing.assert_array_equal(W[:, 1, 0], 0.0)


def test_whitened_squares_are_mahalanobis_distances() -> None:
    sightings = gather([VIEW, VIEW]).weighted(np.array([[4.0], [0.0]]))
    errors = RNG.normal(0, 1, (2, 54, 2))
    squares = (sightings.whiten(errors) ** 2).sum(axis=-1)
    expected = np.einsum("ni,nij,nj->n", errors[0], np.linalg.inv(SLANTED), errors[0])
    np.testing.assert_allclose(squares[0], 4 * expected)
    np.testing.assert_array_equal(squares[1], 0.0)
    np.testing.assert_array_equal(sightings.used, [[True] * 54, [False] * 54])


def test_derivatives_are_whitened_column_by_column() -> None:
    sightings, J = gather([VIEW]), RNG.normal(0, 1, (1, 54, 2, 6))
    each = np.stack([sightings.whiten(J[..., k]) for k in range(6)], axis=-1)
    np.testing.assert_allclose(sightings.whiten(J), each)


def test_round_covariances_weigh_as_their_deviation_says() -> None:
    sd_px = RNG.uniform(0.05, 0.5, 54)
    view = replace(VIEW, covariances_px2=round_covariances(sd_px))
    np.testing.assert_allclose(view.sd_px, sd_px)
    np.testing.assert_allclose(gather([view]).weights[0], sd_px**-2)
    np.testing.assert_allclose(mean_sd_px(SLANTED) ** 2, (SLANTED[:, 0, 0] + SLANTED[:, 1, 1]) / 2)


@pytest.mark.parametrize(
    "wrong", [np.zeros((2, 2)), [[1.0, 2.0], [2.0, 1.0]], [[np.nan, 0.0], [0.0, 1.0]], -np.eye(2)]
)
def test_what_is_no_covariance_is_refused(wrong: object) -> None:
    covariances = SLANTED.copy()
    covariances[17] = wrong
    with pytest.raises(InputError, match=r"covariances_px2 of a\.png must be positive"):
        replace(VIEW, covariances_px2=covariances, source="a.png")


def test_one_number_for_a_corner_is_refused() -> None:
    with pytest.raises(InputError, match=r"covariances_px2 \(n, 2, 2\), got"):
        replace(VIEW, covariances_px2=np.ones(54))

"""Fits that begin with how a marker looked before end where those that begin anew do."""

from dataclasses import replace

import numpy as np
import pytest
from photographed_markers import Seen, seen

from tagmetry.detect.photometric import Fitted, fit_pictures
from tagmetry.geometry import Array

NEAR_PX = 0.15  # that the tracker's first places are wrong by


def near(one: Seen, rng: np.random.Generator) -> Seen:
    """Return it with first places that are nearly right."""
    return replace(one, first_px=one.corners_px + NEAR_PX * rng.standard_normal((4, 2)))


def fitted(one: Seen, looks: Array | None) -> Fitted:
    return fit_pictures(one.grey, one.first_px[None], [one.picture], one.camera, looks=looks)


def off_in_deviations(found: Fitted, truth_px: Array) -> float:
    """Return the squared Mahalanobis distance of corners from the truth."""
    error = (found.corners_px[0] - truth_px).ravel()
    return float(error @ np.linalg.solve(found.covariances_px2[0], error))


@pytest.mark.parametrize("exponent", [1.0, 2.2])
@pytest.mark.parametrize("side_px", [24.0, 60.0])
def test_both_beginnings_end_at_the_same_corners(side_px: float, exponent: float) -> None:
    rng, apart = np.random.default_rng(5), []
    before = seen(rng, side_px, noise=4.0, exponent=exponent)
    looks = fitted(before, None).looks
    for _ in range(20):
        one = near(seen(rng, side_px, noise=4.0, exponent=exponent), rng)
        anew, again = fitted(one, None), fitted(one, looks)
        assert again.sound.all()
        deviation_px = np.sqrt(np.einsum("ii->i", anew.covariances_px2[0])).mean()
        apart.append(np.abs(again.corners_px - anew.corners_px).mean() / deviation_px)
    assert np.mean(apart) < 0.35


def test_the_covariance_holds_for_fits_that_begin_with_looks() -> None:
    rng, distances2 = np.random.default_rng(6), []
    looks = fitted(seen(rng, 40.0, noise=5.0), None).looks
    for _ in range(80):
        one = near(seen(rng, 40.0, noise=5.0, tilt_deg=rng.uniform(0, 40)), rng)
        distances2.append(off_in_deviations(fitted(one, looks), one.corners_px))
    assert 7.0 < np.mean(distances2) < 9.0


@pytest.mark.parametrize("changed", [{"blur_px": 1.6}, {"exponent": 2.2}])
def test_a_marker_that_looks_otherwise_begins_anew(changed: dict[str, float]) -> None:
    rng = np.random.default_rng(7)
    looks = fitted(seen(rng, 50.0, noise=2.0), None).looks
    one = near(seen(rng, 50.0, noise=2.0, **changed), rng)
    np.testing.assert_array_equal(fitted(one, looks).corners_px, fitted(one, None).corners_px)


def test_first_places_that_are_far_off_begin_anew() -> None:
    rng = np.random.default_rng(8)
    one = seen(rng, 50.0, noise=2.0)
    looks = fitted(one, None).looks
    one = replace(one, first_px=one.corners_px + np.array([0.9, -0.7]))
    np.testing.assert_array_equal(fitted(one, looks).corners_px, fitted(one, None).corners_px)


def test_what_was_not_explained_has_no_looks() -> None:
    rng = np.random.default_rng(9)
    one = seen(rng, 50.0)
    one = replace(one, grey=np.full_like(one.grey, 128))
    found = fitted(one, None)
    assert not found.sound.any()
    assert np.isnan(found.looks).all()

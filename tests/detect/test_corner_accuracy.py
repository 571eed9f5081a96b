"""Corners of rendered markers: how far off, and does the covariance say so?

A corner's error is compared with the Cramer-Rao bound of four blurred sides, and with its own
covariance: the squared Mahalanobis distance of eight coordinates has the mean 8, from 20 to 40 dB.
"""

import cv2
import numpy as np
import pytest
from rendered_markers import bound_px, only, scene, trials

from tagmetry.detect import Detector
from tagmetry.twin import Look

CONTRAST = 160.0


def look(noise: float, blur_px: float = 0.6) -> Look:
    return Look(black=40.0, white=40.0 + CONTRAST, noise=noise, blur_px=blur_px)


@pytest.mark.parametrize(
    ("side_px", "noise", "blur_px"),
    [
        (30.0, 16.0, 0.6),  # 20 dB
        (60.0, 16.0, 0.6),
        (60.0, 5.0, 0.4),  # 30 dB
        (60.0, 5.0, 1.2),
        (100.0, 5.0, 0.8),
        (60.0, 1.6, 0.6),  # 40 dB
    ],
)
def test_errors_are_as_large_as_the_covariance_says(
    side_px: float, noise: float, blur_px: float
) -> None:
    measured = trials(40, 1, side_px=side_px, tilt_deg=20.0, look=look(noise, blur_px))
    assert measured.missed == 0
    assert 5.5 < measured.mean_distance2 < 11.0


@pytest.mark.slow
@pytest.mark.parametrize("side_px", [20.0, 30.0, 60.0, 100.0])
@pytest.mark.parametrize("noise", [16.0, 5.0, 1.6])
@pytest.mark.parametrize("blur_px", [0.4, 0.7, 1.2])
def test_covariance_over_sizes_noise_and_blur(side_px: float, noise: float, blur_px: float) -> None:
    measured = trials(150, 2, side_px=side_px, tilt_deg=20.0, look=look(noise, blur_px))
    assert measured.missed <= 2
    assert 5.5 < measured.mean_distance2 < 11.0


@pytest.mark.parametrize("tilt_deg", [0.0, 40.0, 65.0])
def test_covariance_of_oblique_views(tilt_deg: float) -> None:
    measured = trials(30, 3, side_px=60.0, tilt_deg=tilt_deg, look=look(5.0))
    assert measured.missed == 0
    assert 5.5 < measured.mean_distance2 < 11.0


@pytest.mark.parametrize("camera_known", [False, True])
def test_covariance_through_a_strong_lens(camera_known: bool) -> None:
    measured = trials(
        20,
        4,
        side_px=100.0,
        tilt_deg=20.0,
        aside_px=200.0,
        coefficients=(-0.3, 0.0, 0.0, 0.0),
        camera_known=camera_known,
        look=look(2.0),
    )
    assert measured.missed == 0
    assert measured.rms_px < 0.02
    assert 5.5 < measured.mean_distance2 < 11.0


@pytest.mark.parametrize(("side_px", "times"), [(30.0, 1.3), (60.0, 1.3), (100.0, 1.3)])
def test_noise_moves_corners_little_more_than_it_must(side_px: float, times: float) -> None:
    """20 dB; the bound counts the four sides only, not the cells within, nor levels and blur."""
    measured = trials(40, 5, side_px=side_px, look=look(16.0))
    assert measured.rms_px < times * bound_px(side_px, 0.6, CONTRAST / 16.0)


def test_corners_are_unbiased() -> None:
    """Neither inward nor to one side: an eighth of the noise of one, over 60 of them."""
    rng, errors = np.random.default_rng(6), []
    for _ in range(60):
        shown = scene(rng, 60.0, tilt_deg=15.0, look=look(5.0))
        errors.append(only(Detector().detect(shown.grey)).corners_px - shown.corners_px)
    assert np.abs(np.mean(errors, axis=(0, 1))).max() < 0.005
    assert np.abs(np.mean(errors, axis=0)).max() < 0.015


def test_a_gamma_curve_moves_no_corner() -> None:
    """sRGB-like encoding bends each step; the pictures of whole markers tell by how much."""
    outward, rng = [], np.random.default_rng(7)
    for _ in range(12):
        shown = scene(rng, 60.0, look=Look(black=5.0, white=210.0, noise=0.0, blur_px=0.7))
        encoded = np.rint(255 * (shown.grey / 255) ** (1 / 2.2)).astype(np.uint8)
        found = only(Detector().detect(encoded))
        rays = shown.corners_px - shown.corners_px.mean(axis=0)
        outward.append(
            ((found.corners_px - shown.corners_px) * rays).sum(axis=1)
            / np.linalg.norm(rays, axis=1)
        )
    assert abs(np.mean(outward)) < 0.003


def test_light_and_contrast_leave_corners_where_they_are() -> None:
    shown = scene(np.random.default_rng(8), 60.0, look=Look(black=60.0, white=160.0, noise=1.0))
    reference = only(Detector().detect(shown.grey))
    for other in (shown.grey + 40, shown.grey - 40, 2 * shown.grey.astype(int) - 80):
        found = only(Detector().detect(np.asarray(other, dtype=np.uint8)))
        np.testing.assert_allclose(found.corners_px, reference.corners_px, atol=0.01)


def test_a_covered_corner_is_not_found_confidently() -> None:
    """A finger over a corner: nothing, half a pixel, or an uncertainty that admits the error.

    Where the finger's own outline runs along a side, that side is drawn to it by up to 0.4 px.
    """
    rng = np.random.default_rng(9)
    for _ in range(25):
        shown = scene(rng, 80.0, look=look(2.0))
        covered = shown.grey.copy()
        radius_px = int(rng.uniform(3, 25))
        centre = np.rint(shown.corners_px[rng.integers(4)] + rng.normal(0, 3, 2)).astype(int)
        cv2.circle(covered, centre.tolist(), radius_px, float(rng.choice([90, 150, 220])), -1)
        for found in Detector().detect(covered):
            error_px = np.abs(found.corners_px - shown.corners_px).ravel()
            deviation_px = np.sqrt(found.corners_cov_px2.diagonal())
            assert (error_px < np.maximum(5 * deviation_px, 0.5)).all()

"""Corners of fitted pictures: near the bound, unmoved by a gamma curve, with a true covariance.

The pictures are the twin's, whose renderer integrates cells over pixels exactly; the bound is
derived from the edges alone. Neither shares a formula with the fit.
"""

import cv2
import numpy as np
import pytest
from photographed_markers import BLACK, WHITE, encoded, errors, picture_of, seen

from tagmetry.detect.photometric import Picture, fit_pictures
from tagmetry.detect.photometric.bound import Print, corner_bound_px
from tagmetry.markers import family

FLOOR_PX = 0.004


def bound_px(side_px: float, noise: float, exponent: float, *, seed: int = 3) -> float:
    """Return the mean bound of three markers as `errors` shows them."""
    rng, bounds = np.random.default_rng(seed), []
    black, white = encoded(np.array([BLACK, WHITE]), exponent)
    for _ in range(3):
        one = seen(rng, side_px, tilt_deg=rng.uniform(0, 40))
        shown = Print(one.picture.cells, 0, black, white, 0.6, exponent)
        bounds.append(corner_bound_px(one.corners_px, shown, noise))
    return float(np.sqrt(np.mean(np.square(bounds))))


def rms(rows: np.ndarray) -> float:
    return float(np.sqrt((rows[:, :8] ** 2).mean()))


@pytest.mark.parametrize("exponent", [1.0, 2.2])
@pytest.mark.parametrize("noise", [16.0, 1.6])
@pytest.mark.parametrize("side_px", [30.0, 60.0])
def test_errors_are_near_the_least_possible(side_px: float, noise: float, exponent: float) -> None:
    """A camera is known, so no bow is sought; 20 and 40 dB."""
    rows = errors(30, 1, side_px=side_px, noise=noise, exponent=exponent, camera_known=True)
    assert rms(rows) < 1.35 * bound_px(side_px, noise, exponent) + FLOOR_PX


@pytest.mark.parametrize("exponent", [1.0, 1.6, 2.2, 0.0])
def test_a_gamma_curve_moves_no_corner(exponent: float) -> None:
    """The side fit of `detect.sides` is off by 0.1 to 0.4 px here; 0 stands for sRGB."""
    rng, outward = np.random.default_rng(2), []
    for _ in range(10):
        one = seen(rng, 60.0, noise=0.5, exponent=exponent)
        error = one.fitted().corners_px[0] - one.corners_px
        rays = one.corners_px - one.corners_px.mean(axis=0)
        outward.append((error * rays).sum(axis=1) / np.linalg.norm(rays, axis=1))
    assert abs(np.mean(outward)) < 0.004


@pytest.mark.parametrize(
    ("side_px", "noise", "exponent", "blur_px"),
    [
        (20.0, 16.0, 1.0, 0.6),
        (20.0, 5.0, 2.2, 0.6),
        (30.0, 16.0, 2.2, 0.6),
        (60.0, 16.0, 1.0, 1.5),
        (60.0, 5.0, 2.2, 0.4),
        (60.0, 1.6, 2.2, 0.6),
        (100.0, 5.0, 1.0, 0.6),
    ],
)
def test_covariance_is_that_of_the_errors(
    side_px: float, noise: float, exponent: float, blur_px: float
) -> None:
    """The mean of 60 squared distances of eight coordinates is 8 within 0.5 (a deviation)."""
    rows = errors(60, 4, side_px=side_px, noise=noise, exponent=exponent, blur_px=blur_px)
    assert 6.3 < rows[:, 8].mean() < 9.7


@pytest.mark.slow
@pytest.mark.parametrize("side_px", [20.0, 30.0, 60.0, 100.0])
@pytest.mark.parametrize("noise", [16.0, 5.0, 1.6])
@pytest.mark.parametrize("exponent", [1.0, 2.2])
@pytest.mark.parametrize("blur_px", [0.4, 0.7, 1.5])
def test_covariance_everywhere(
    side_px: float, noise: float, exponent: float, blur_px: float
) -> None:
    """From 20 to 40 dB.

    Limit: cells of 1.6 blurs at 40 dB (20 px, 1.5 px) have 1.3 times the claimed deviation, because
    what lies behind the quiet zone is only sampled.
    """
    rows = errors(100, 5, side_px=side_px, noise=noise, exponent=exponent, blur_px=blur_px)
    hard = side_px == 20.0 and blur_px == 1.5 and noise < 5
    low, high = 5.5 if noise < 5 else 6.5, 20.0 if hard else 9.9
    assert low < rows[:, 8].mean() < high


@pytest.mark.parametrize("blur_px", [0.2, 0.3])
@pytest.mark.parametrize("noise", [16.0, 1.6])
def test_covariance_of_lenses_sharper_than_their_pixels(blur_px: float, noise: float) -> None:
    """An edge is nearly the pixel's own box then, which is no bell."""
    rows = errors(60, 12, side_px=60.0, noise=noise, blur_px=blur_px, camera_known=True)
    assert 6.0 < rows[:, 8].mean() < 9.5


def test_light_that_falls_off_moves_no_corner() -> None:
    """A lens darkens what is off its axis, by a curve: 2 % less light at a marker's corners."""
    rng, errors_px, distances2 = np.random.default_rng(13), [], []
    for _ in range(12):
        one = seen(rng, 100.0, noise=0.0)
        y, x = np.mgrid[: one.grey.shape[0], : one.grey.shape[1]]
        far2 = (x - x.mean()) ** 2 + (y - y.mean()) ** 2
        light = one.grey * (1 - 0.02 * far2 / 70.0**2)
        dark = np.rint(light + rng.normal(0, 1.0, light.shape)).clip(0, 255).astype(np.uint8)
        found = fit_pictures(dark, one.first_px[None], [one.picture], one.camera)
        error = (found.corners_px[0] - one.corners_px).ravel()
        errors_px.append(error)
        distances2.append(error @ np.linalg.solve(found.covariances_px2[0], error))
    assert rms(np.array(errors_px)) < 0.0035
    assert np.mean(distances2) < 11.0


@pytest.mark.parametrize(
    ("name", "marker_id"),
    [
        ("4x4_50", 3),
        ("tag16h5", 5),
        ("tag36h11_border2", 2),
        ("aruco_mip_36h12", 9),
        ("tagStandard41h12", 5),
        ("tagCircle49h12", 5),
    ],
)
def test_other_families(name: str, marker_id: int) -> None:
    rows = errors(12, 6, side_px=60.0, noise=5.0, name=name, marker_id=marker_id)
    assert rms(rows) < 0.035
    assert 4.0 < rows[:, 8].mean() < 13.0


@pytest.mark.parametrize("tilt_deg", [0.0, 60.0])
def test_oblique_views(tilt_deg: float) -> None:
    rows = errors(20, 7, side_px=40.0, noise=1.6, tilt_deg=tilt_deg)
    assert rms(rows) < 0.012
    assert rows[:, 8].mean() < 11.0


@pytest.mark.parametrize("camera_known", [False, True])
def test_through_a_strong_lens(camera_known: bool) -> None:
    rows = errors(
        12,
        8,
        side_px=100.0,
        aside_px=300.0,
        coefficients=(-0.3, 0.0, 0.0, 0.0),
        camera_known=camera_known,
    )
    assert rms(rows) < 0.01


def test_an_inverted_marker() -> None:
    one = seen(np.random.default_rng(9))
    upside = fit_pictures(255 - one.grey, one.first_px[None], [one.picture])
    assert upside.sound.all()
    np.testing.assert_allclose(upside.corners_px[0], one.corners_px, atol=0.03)


def test_motion_blur_moves_no_corner() -> None:
    """Five pixels of motion along x: the corners stay where the middle of the exposure had them."""
    one = seen(np.random.default_rng(10), 80.0)
    moved = cv2.blur(one.grey, (5, 1)).astype(np.uint8)
    found = fit_pictures(moved, one.first_px[None], [one.picture])
    assert found.sound.all()
    np.testing.assert_allclose(found.corners_px[0], one.corners_px, atol=0.06)


def test_dirt_costs_little() -> None:
    """Three spots on the marker: pixels that do not fit count little."""
    rng = np.random.default_rng(11)
    one = seen(rng, 80.0)
    for _ in range(3):
        at = np.rint(one.corners_px.mean(axis=0) + rng.uniform(-20, 20, 2)).astype(int)
        cv2.circle(one.grey, at.tolist(), 5, 120.0, -1)
    found = one.fitted()
    assert found.sound.all()
    assert np.abs(found.corners_px[0] - one.corners_px).max() < 0.03


def test_paper_that_is_overexposed() -> None:
    """Clipped white still tells where black begins."""
    one = seen(np.random.default_rng(12), 60.0, noise=1.0)
    bright = np.clip(1.5 * one.grey.astype(float), 0, 255).astype(np.uint8)
    found = fit_pictures(bright, one.first_px[None], [one.picture])
    assert found.sound.all()
    assert np.abs(found.corners_px[0] - one.corners_px).max() < 0.05


def test_another_picture_is_not_sound_or_not_certain() -> None:
    one = seen(np.random.default_rng(13))
    other = fit_pictures(one.grey, one.first_px[None], [picture_of("tag36h11", 200)])
    right = one.fitted()
    doubt = np.trace(other.covariances_px2[0]) / np.trace(right.covariances_px2[0])
    assert not other.sound[0] or doubt > 10


@pytest.mark.parametrize("shape", [(1, 1), (2, 9), (40, 40)])
def test_nothing_there_is_no_marker_and_no_error(shape: tuple[int, int]) -> None:
    picture = Picture(family("tag36h11").picture(0))
    first = np.array([[5.0, 5], [30, 5], [30, 30], [5, 30]])
    for grey in (np.zeros(shape, np.uint8), np.full(shape, 255, np.uint8)):
        found = fit_pictures(grey, first[None], [picture])
        assert not found.sound.any()
        np.testing.assert_array_equal(found.corners_px[0], first)


@pytest.mark.parametrize(
    "first",
    [np.zeros((4, 2)), np.full((4, 2), np.nan), np.array([[0.0, 0], [9, 9], [18, 18], [27, 27]])],
)
def test_corners_that_are_no_square(first: np.ndarray) -> None:
    grey = np.random.default_rng(0).integers(0, 255, (40, 40)).astype(np.uint8)
    found = fit_pictures(grey, first[None], [Picture(family("tag36h11").picture(0))])
    assert not found.sound.any()


@pytest.mark.parametrize("side_px", [300.0, 900.0])
def test_large_markers_are_seen_as_a_whole(side_px: float) -> None:
    """Pixels are chosen all over them, however many there are: no corner is worse than others."""
    one = seen(np.random.default_rng(14), side_px, noise=5.0, name="4x4_50", marker_id=3)
    found = one.fitted()
    deviation_px = np.sqrt(np.diag(found.covariances_px2[0])).reshape(4, 2).max(axis=1)
    assert deviation_px.max() < 2.0 * deviation_px.min()
    assert np.abs(found.corners_px[0] - one.corners_px).max() < 5 * deviation_px.max()


def test_threads_change_nothing() -> None:
    one = seen(np.random.default_rng(15), 30.0)
    first = one.first_px + np.random.default_rng(16).normal(0, 0.2, (60, 4, 2))
    alone = fit_pictures(one.grey, first, 60 * [one.picture], threads=1)
    shared = fit_pictures(one.grey, first, 60 * [one.picture], threads=2)
    np.testing.assert_array_equal(alone.corners_px, shared.corners_px)
    np.testing.assert_array_equal(alone.covariances_px2, shared.covariances_px2)


def test_no_markers() -> None:
    found = fit_pictures(np.zeros((8, 8), np.uint8), np.zeros((0, 4, 2)), [])
    assert found.corners_px.shape == (0, 4, 2)
    assert found.covariances_px2.shape == (0, 8, 8)

"""The blurred picture against a plain convolution; derivatives against differences; the bound."""

import numpy as np
import pytest
from evaluated_model import evaluated
from scipy.ndimage import gaussian_filter
from scipy.special import ndtr

from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.detect.photometric.bound import Print, corner_bound_px
from tagmetry.detect.photometric.bows import believed
from tagmetry.detect.photometric.elementary import exponential, logarithm, step_and_bell
from tagmetry.detect.photometric.ink import QUIET_CELLS, printed
from tagmetry.detect.photometric.model import BLACK, BLUR, BOWS, COUNT
from tagmetry.detect.photometric.rays import rays_of
from tagmetry.detect.photometric.straight import lenses_around, straight_place
from tagmetry.geometry import apply_homography, square_to_quad
from tagmetry.markers import family

INK = printed(family("tag36h11").picture(7))


def test_elementary_functions_are_those_of_the_library() -> None:
    for x in np.linspace(-40, 40, 999, dtype=np.float32):
        assert exponential(x) == pytest.approx(np.exp(np.float64(x)), rel=4e-6)
        assert logarithm(np.exp(x)) == pytest.approx(x, rel=3e-7, abs=3e-7)
    for x in np.linspace(-4, 4, 999, dtype=np.float32):
        assert exponential(x) == pytest.approx(np.exp(np.float64(x)), rel=5e-7)
    for z in np.linspace(-6, 6, 999, dtype=np.float32):
        step, bell = step_and_bell(z)
        assert step == pytest.approx(ndtr(z), abs=3e-7)
        assert bell == pytest.approx(np.exp(-0.5 * z * z) / np.sqrt(2 * np.pi), abs=2e-7)


def whiteness(ink: np.ndarray, places: np.ndarray, blur2: np.ndarray, edges: int) -> np.ndarray:
    """Return how white places in cells are, blurred by a covariance (xx, xy, yy), cells."""
    fit = np.zeros(COUNT)
    fit[[0, 4]] = 1.0
    fit[BLACK : BLACK + 2] = 0.25, 0.75
    fit[BLUR : BLUR + 3] = blur2
    values, _ = evaluated(fit, ink, places, edges)
    return (values / 255 - 0.25) / 0.5


def test_the_blurred_picture_is_a_convolution() -> None:
    finer = 40
    fine = np.kron(INK, np.ones((finer, finer)))
    for blur, edges in ((0.08, 1), (0.25, 2), (0.6, 5)):
        smooth = gaussian_filter(fine, blur * finer, mode="nearest")
        places = np.random.default_rng(0).uniform(2, 10, (50, 2))
        column, row = (places * finer).astype(int).T
        at = (np.stack([column, row], axis=1) + 0.5) / finer
        white = whiteness(INK, at, blur**2 * np.array([1, 0, 1]), edges)
        np.testing.assert_allclose(white, smooth[row, column], atol=2e-3)


def test_a_blur_along_the_diagonal() -> None:
    """The corner of one black cell: the bivariate Gaussian's integral by many samples."""
    ink = np.ones((6, 6))
    ink[3:, 3:] = 0.0
    rng = np.random.default_rng(1)
    for correlation in (-0.4, 0.4):
        spread = [[1.0, correlation], [correlation, 1.0]]
        falls = rng.multivariate_normal([0, 0], 0.04 * np.array(spread), 200_000) + 3.05
        on_black = ((falls > 3) & (falls < 6)).all(axis=1).mean()
        blur2 = 0.04 * np.array([1.0, correlation, 1.0])
        white = whiteness(ink, np.array([[3.05, 3.05]]), blur2, 2)
        assert white == pytest.approx(1 - on_black, abs=0.006)


def test_a_sharp_edge_is_seen_by_square_pixels() -> None:
    """An edge along the rows, blur 0.3 px: the integral of a bell over a pixel, exactly."""
    half_px, blur_px = 20.0, 0.3
    ink = np.ones((6, 6))
    ink[:, 3:] = 0.0
    fit = np.zeros(COUNT)
    fit[[0, 4]] = half_px / 8  # cells of 8 px
    fit[[2, 5]] = 3.0
    fit[BLACK : BLACK + 2] = 0.25, 0.75
    fit[[BLUR, BLUR + 2]] = (blur_px**2 + 1 / 12) / half_px**2
    past_px = np.linspace(-1.2, 1.2, 49)
    places = np.stack([past_px / half_px, np.full(49, -0.2)], axis=1)

    def integral(z: np.ndarray) -> np.ndarray:
        return z * ndtr(z) + np.exp(-0.5 * z**2) / np.sqrt(2 * np.pi)

    ahead, behind = (integral((past_px + side_px) / blur_px) for side_px in (0.5, -0.5))
    expected = 1 - blur_px * (ahead - behind)
    square, bell = (
        (evaluated(fit, ink, places, 1, one_px)[0] / 255 - 0.25) / 0.5 for one_px in (half_px, 1e4)
    )
    assert np.abs(square - expected).max() < 0.004
    assert np.abs(bell - expected).max() > 0.008


def fit_of(corners: np.ndarray) -> np.ndarray:
    cells = np.array([[8.0, 0, QUIET_CELLS], [0, 8.0, QUIET_CELLS], [0, 0, 1.0]])
    G = cells @ np.linalg.inv(square_to_quad(corners))
    rest = [
        0.2,
        0.8,
        0.01,
        0.02,
        0.03,
        -0.02,
        0.4,
        9e-4,
        1e-4,
        12e-4,
        0.02,
        0.01,
        0.02,
        -0.01,
        0.01,
        -0.015,
    ]
    return np.concatenate([(G / G[2, 2]).ravel()[:8], rest])


@pytest.mark.parametrize("edges", [1, 3])
def test_derivatives_are_those_of_the_model(edges: int) -> None:
    """Compared over many pixels; where edges cross obliquely a few per cent are left out."""
    fit = fit_of(np.array([[-0.7, -0.6], [0.7, -0.5], [0.6, 0.7], [-0.7, 0.5]]))
    places = np.random.default_rng(2).uniform(-0.7, 0.7, (300, 2))
    _, found = evaluated(fit, INK, places, edges)
    wanted = np.stack([_difference(fit, k, places, edges) for k in range(COUNT)], axis=1)
    scale = np.abs(wanted).max(axis=0)
    assert (np.abs(found - wanted).max(axis=0) < 0.1 * scale).all()
    assert (np.abs(found - wanted).mean(axis=0) < 0.01 * scale).all()


def _difference(fit: np.ndarray, k: int, places: np.ndarray, edges: int) -> np.ndarray:
    shift = 2e-4 * max(abs(fit[k]), 1.0 if k >= BOWS else 1e-2)
    shift *= 20 if BLUR <= k < BOWS else 1  # values have 32 bits
    ahead, behind = fit.copy(), fit.copy()
    ahead[k] += shift
    behind[k] -= shift
    more, less = (evaluated(moved, INK, places, edges)[0] for moved in (ahead, behind))
    return (more - less) / (2 * shift)


def test_straight_places_keep_straight_lines_straight() -> None:
    """A fisheye's marker far off the axis: points of a line in space lie on a line."""
    camera = Camera(1280, 960, (400.0, 400.0), (640.0, 480.0), FisheyeLens((0.05, -0.01, 0.0, 0.0)))
    line = np.array([0.9, 0.5, 1.0]) + np.linspace(-0.1, 0.1, 9)[:, None] * [1.0, -0.4, 0.2]
    pixels = camera.project(line)
    frame = np.array([*pixels[4], 0.6 * np.linalg.norm(pixels[-1] - pixels[0])])
    lens = lenses_around(camera, frame[None])[0]
    places = np.array([straight_place(*p, lens) for p in (pixels - frame[:2]) / frame[2]])
    off = np.linalg.svd(places - places.mean(axis=0))[1][1]
    assert off * frame[2] < 0.002
    bent = (pixels - pixels.mean(axis=0)) / frame[2]
    assert np.linalg.svd(bent)[1][1] * frame[2] > 0.1


@pytest.mark.parametrize(("side_px", "least_px"), [(30, 0.0449), (60, 0.0310), (100, 0.0239)])
def test_bound_of_a_whole_tag(side_px: float, least_px: float) -> None:
    """Figures from a Fisher information by differences of renderings, tilts 0 to 40, 20 dB."""
    corners = square(side_px)
    seen = Print(family("tag36h11").picture(7), 0, 40.0, 200.0, 0.6)
    assert corner_bound_px(corners, seen, 16.0) == pytest.approx(least_px, rel=0.05)
    assert corner_bound_px(corners, seen, 1.6) == pytest.approx(0.1 * least_px, rel=0.05)


def test_bound_of_a_plain_square_is_that_of_its_sides() -> None:
    """2 sqrt(2 sqrt(pi) s / L) / SNR, for four lines each fitted alone; levels cost a little."""
    seen = Print(np.zeros((1, 1), dtype=bool), 0, 40.0, 200.0, 0.6)
    alone = 2 * np.sqrt(2 * np.sqrt(np.pi) * np.hypot(0.6, np.sqrt(1 / 12)) / 60) / 10
    assert corner_bound_px(square(60), seen, 16.0) == pytest.approx(alone, rel=0.06)


def square(side_px: float) -> np.ndarray:
    turn = np.array([[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]])
    corners = apply_homography(np.eye(3), np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]]))
    return side_px / 2 * corners @ turn.T + side_px


def test_bows_are_believed_where_the_image_bows() -> None:
    """Of 30 markers with bows of one deviation nothing is left, of ten deviations nearly all."""
    rng, half_px = np.random.default_rng(4), np.full(30, 50.0)
    J = rng.normal(size=(13, 13))
    covariance = np.tile(1e-6 * J @ J.T, (30, 1, 1))
    noise = rng.multivariate_normal(np.zeros(13), covariance[0], 30)
    corners, bows = noise[:, :8].reshape(30, 4, 2), noise[:, 8:]
    straight, left = believed(corners, covariance, half_px, bows)
    assert np.trace(left[0]) < np.trace(covariance[0, :8, :8])
    assert (straight**2).mean() < (corners**2).mean()
    strong = bows + 10 * np.sqrt(np.diag(covariance[0])[8:])
    kept, honest = believed(corners, covariance, half_px, strong)
    assert np.abs(kept - corners).max() < 0.5 * np.abs(corners).max()
    assert np.trace(honest[0]) > 0.9 * np.trace(covariance[0, :8, :8])


@pytest.mark.parametrize(
    "lens", [BrownLens((-0.3, 0.1, 0.001, 0.0005, -0.01)), FisheyeLens((0.05, -0.01, 0.0, 0.0))]
)
def test_lenses_from_the_table_are_those_of_the_formula(lens: Lens) -> None:
    """The first image of a camera uses the lens's own formula, later ones the table."""
    camera = Camera(1280, 960, (500.0, 500.0), (640.0, 480.0), lens)
    rng = np.random.default_rng(5)
    frames = np.column_stack([rng.uniform(0.06, 0.94, (30, 2)) * camera.size_px, np.full(30, 40.0)])
    exact, by_table = lenses_around(camera, frames), lenses_around(camera, frames)
    for place in rng.uniform(-1, 1, (10, 2)):
        for one, other in zip(exact, by_table, strict=True):
            off = np.subtract(straight_place(*place, one), straight_place(*place, other))
            assert np.abs(off).max() * 40 < 5e-4


def test_what_the_lens_does_not_show_is_not_in_the_table() -> None:
    """Of a fisheye whose circle ends within the image, rays outside stay unknown."""
    camera = Camera(640, 640, (120.0, 120.0), (320.0, 320.0), FisheyeLens((0.0, 0.0, 0.0, 0.0)))
    pixels = np.array([[320.0, 320.0], [1e6, 3.0], [np.nan, 4.0], [630.0, 635.0]])
    first, again = rays_of(camera, pixels), rays_of(camera, pixels)
    np.testing.assert_allclose(first, again, atol=1e-7)

"""The fit of a corner: against OpenCV's, against the bound, and where there is none."""

import cv2
import numpy as np
import pytest
from rendered_boards import picture
from scipy.optimize import least_squares
from scipy.special import erf

from tagmetry.calibrate.targets.circles import perspective_bias_px
from tagmetry.calibrate.targets.corners import Guesses, refined
from tagmetry.calibrate.targets.order import handedness, in_board_order
from tagmetry.calibrate.targets.saddles import fit_saddles
from tagmetry.calibrate.targets.squares import first_is_black, is_even, share_alternating
from tagmetry.files.board_text import parse_board
from tagmetry.geometry import Array, apply_homography

BOARD = parse_board("chessboard:9x6:25mm")
PLACES = BOARD.corners_m[:, :2]


def steps(truth_px: Array) -> tuple[Array, Array]:
    grid = truth_px.reshape(6, 9, 2)
    return np.gradient(grid, axis=1).reshape(-1, 2), np.gradient(grid, axis=0).reshape(-1, 2)


def test_a_guess_off_by_a_pixel_leads_to_the_same_corner() -> None:
    shown = picture(BOARD)
    along, down = steps(shown.truth_px)
    exact = fit_saddles(shown.pixels, shown.truth_px, along, down)
    rng = np.random.default_rng(0)
    for _ in range(3):
        off = shown.truth_px + rng.uniform(-1, 1, shown.truth_px.shape)
        fitted = fit_saddles(shown.pixels, off, along, down)
        assert fitted.is_saddle.all()
        assert np.abs(fitted.centres_px - exact.centres_px).max() < 0.02


def fitted_by_scipy(pixels: np.ndarray, guess: Array, step_px: float) -> Array:
    """Return the crossing of two edges along rows and columns, of derivatives by differences."""
    half = int(step_px / 3)
    column, row = np.rint(guess).astype(int)
    patch = pixels[row - half : row + half + 1, column - half : column + half + 1].astype(float)
    y, x = np.mgrid[-half : half + 1, -half : half + 1]

    def residuals(unknowns: Array) -> Array:
        cx, cy, turn1, turn2, blur, mean, contrast = unknowns
        edges = [
            erf(((x - cx) * np.cos(turn) + (y - cy) * np.sin(turn)) / (np.sqrt(2) * blur))
            for turn in (turn1, turn2)
        ]
        return (mean + contrast * edges[0] * edges[1] - patch).ravel()

    sign = 1.0 if patch[:half, :half].mean() > patch.mean() else -1.0
    start = [*(guess - [column, row]), np.pi / 2, 0.0, 1.0, patch.mean(), sign * 60]
    return least_squares(residuals, start).x[:2] + np.array([column, row])


def test_it_is_the_least_squares_fit_of_a_solver_that_is_not_ours() -> None:
    shown = picture(BOARD, spacing_px=28.0, tilt_deg=0.0, roll_deg=0.0, noise=3.0)
    along, down = steps(shown.truth_px)
    ours = fit_saddles(shown.pixels, shown.truth_px, along, down).centres_px
    theirs = [fitted_by_scipy(shown.pixels, guess, 28.0) for guess in shown.truth_px[::6]]
    assert np.abs(ours[::6] - theirs).max() < 0.01  # the windows differ by a row of pixels


def test_steps_that_span_no_window_give_no_corner() -> None:
    shown = picture(BOARD)
    step = np.array([[20.0, 5.0]])
    for other in (step, 2 * step, 0 * step):
        assert not fit_saddles(shown.pixels, shown.truth_px[:1], step, other).is_saddle.any()


def test_it_is_closer_than_opencv_s() -> None:
    shown = picture(BOARD, noise=5.0)
    along, down = steps(shown.truth_px)
    ours = fit_saddles(shown.pixels, shown.truth_px, along, down).centres_px
    guess = shown.truth_px.astype(np.float32, order="C").reshape(-1, 1, 2)
    stop = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 50, 1e-4)
    theirs = cv2.cornerSubPix(shown.pixels, guess, (7, 7), (-1, -1), stop)[:, 0]
    rms_ours, rms_theirs = (np.sqrt(((c - shown.truth_px) ** 2).mean()) for c in (ours, theirs))
    assert rms_ours < 0.8 * rms_theirs


def test_blur_contrast_and_noise_are_those_of_the_picture() -> None:
    shown = picture(BOARD, blur_px=1.2, noise=3.0)
    along, down = steps(shown.truth_px)
    fitted = fit_saddles(shown.pixels, shown.truth_px, along, down)
    assert np.median(fitted.blur_px) == pytest.approx(np.hypot(1.2, 0.29), rel=0.05)
    assert np.median(fitted.contrast) == pytest.approx(0.79 * 255, rel=0.03)
    assert np.median(fitted.noise) == pytest.approx(3.0, rel=0.15)


def test_slanted_edges_leave_no_more_than_the_noise() -> None:
    shown = picture(BOARD, spacing_px=40.0, tilt_deg=60.0, axis_deg=45.0, noise=1.0)
    along, down = steps(shown.truth_px)
    slant = (along * down).sum(axis=1) / np.prod(
        [np.linalg.norm(step, axis=1) for step in (along, down)], axis=0
    )
    assert np.abs(slant).max() > 0.5
    fitted = fit_saddles(shown.pixels, shown.truth_px, along, down, bends=np.zeros((54, 2)))
    assert np.median(fitted.noise) == pytest.approx(np.hypot(1.0, 0.29), rel=0.15)


def test_there_is_no_corner_on_an_edge_in_noise_or_on_grey() -> None:
    edge = np.tile(np.repeat(np.array([20, 220], np.uint8), 40), (80, 1))
    noise = np.random.default_rng(0).integers(0, 256, (80, 80), dtype=np.uint8)
    plain = np.full((80, 80), 90, np.uint8)
    step = np.array([[24.0, 0.0]]), np.array([[0.0, 24.0]])
    for pixels in (noise, plain):
        assert not fit_saddles(pixels, np.array([[40.0, 40.0]]), *step).is_saddle.any()
    on_edge = fit_saddles(edge, np.array([[39.5, 40.0]]), *step)
    assert not on_edge.is_saddle.any() or on_edge.sd_px[0] > 1.0


def test_pixels_outside_the_picture_are_not_used() -> None:
    shown = picture(BOARD, noise=1.0)
    along, down = steps(shown.truth_px)
    low = np.floor(shown.truth_px.min(axis=0)).astype(int) - 3
    cut = np.ascontiguousarray(shown.pixels[low[1] :, low[0] :])
    fitted = fit_saddles(cut, shown.truth_px - low, along, down)
    good = fitted.is_saddle
    assert good.mean() > 0.9
    assert np.abs(fitted.centres_px + low - shown.truth_px)[good].max() < 0.05


def test_what_is_not_believed_is_dropped_with_its_reason() -> None:
    shown = picture(BOARD)
    along, down = steps(shown.truth_px)
    guesses = shown.truth_px.copy()
    guesses[3] += [2.5, 1.0]
    guesses[20] = [8.0, 10.0]
    guesses[30] = [-5.0, 10.0]
    guesses[31] = [np.nan, 10.0]
    found = refined(shown.pixels, Guesses(np.arange(54), PLACES, guesses, along, down))
    reasons = {lost.point: lost.reason for lost in found.dropped}
    assert set(reasons) == {3, 20, 30, 31}
    assert "moved 2." in reasons[3]
    assert reasons[20] == "no crossing of two edges"
    assert "at the picture's edge" in reasons[30]
    kept = np.setdiff1d(np.arange(54), list(reasons))
    np.testing.assert_array_equal(found.points, kept)
    assert np.abs(found.corners_px - shown.truth_px[kept]).max() < 0.05


def test_nothing_to_fit_gives_nothing() -> None:
    none = np.zeros((0, 2))
    nothing = Guesses(np.zeros(0, np.int64), none, none, none, none)
    found = refined(np.zeros((50, 50), np.uint8), nothing)
    assert found.points.shape == (0,)
    assert found.corners_px.shape == (0, 2)


GRID = np.stack(np.meshgrid(np.arange(4.0), np.arange(3.0)), axis=-1) * 10


def test_a_mirrored_count_is_put_right_and_the_pattern_decides_the_rest() -> None:
    wanted = GRID @ np.array([[0.9, 0.3], [-0.3, 0.9]])
    assert handedness(wanted) > 0
    for seen in (wanted, wanted[:, ::-1], wanted[::-1], wanted[::-1, ::-1]):
        found = in_board_order(seen, lambda grid: bool(np.allclose(grid[0, 0], wanted[0, 0])))
        np.testing.assert_array_equal(found, wanted)
        upright = in_board_order(seen, lambda _: False)
        np.testing.assert_array_equal(upright, wanted)


def test_a_square_may_lie_on_its_side() -> None:
    wanted = GRID[:, :3]
    lying = np.swapaxes(wanted, 0, 1)
    found = in_board_order(lying, lambda grid: bool(grid[0, 0, 0] == 0 and grid[0, 0, 1] == 0))
    np.testing.assert_array_equal(found, wanted)


def test_rows_are_even_until_a_corner_is_out_of_place() -> None:
    assert is_even(GRID)
    broken = GRID.copy()
    broken[1, 1] += [9.0, 0.0]
    assert not is_even(broken)


def test_squares_alternate_and_the_first_is_dark() -> None:
    greys = np.where(np.indices((3, 4)).sum(axis=0) % 2 == 0, 20.0, 200.0)
    assert share_alternating(greys) == 1
    assert first_is_black(greys)
    assert not first_is_black(220 - greys)
    assert share_alternating(np.full((3, 4), 7.0) + np.arange(4)) < 0.6


def test_the_bias_of_an_ellipse_s_centre_is_that_of_its_rim() -> None:
    """The rim's picture, fitted as an ellipse by OpenCV."""
    H = np.array([[900.0, 60.0, 320.0], [-40.0, 850.0, 240.0], [0.9, -1.4, 1.0]])
    disc = np.array([[0.06, -0.04, 0.02]])
    angle = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    rim = disc[0, :2] + disc[0, 2] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    seen = (apply_homography(H, rim) * 16).astype(np.float32)
    (x, y), *_ = cv2.fitEllipseDirect(seen)
    expected = np.array([x, y]) / 16 - apply_homography(H, disc[:, :2])[0]
    found = perspective_bias_px(disc, H)[0]
    assert np.linalg.norm(found) > 0.1
    np.testing.assert_allclose(found, expected, atol=2e-3)


def test_corners_share_the_noise_that_a_few_pixels_cannot_tell() -> None:
    shown = picture(BOARD, spacing_px=20.0, tilt_deg=0.0, noise=3.0)
    pixels = shown.pixels.copy()
    x, y = np.rint(shown.truth_px[30]).astype(int)
    dirt = np.random.default_rng(1).normal(0, 25, (15, 15))
    around = np.s_[y - 7 : y + 8, x - 7 : x + 8]
    pixels[around] = np.clip(pixels[around] + dirt, 0, 255).astype(np.uint8)
    fitted = fit_saddles(pixels, shown.truth_px, *steps(shown.truth_px), bends=np.zeros((54, 2)))
    clean = np.arange(54) != 30
    assert fitted.noise[clean].std() > 0.05 * fitted.noise[clean].mean()
    assert fitted.sd_px[clean].std() < 0.02 * fitted.sd_px[clean].mean()
    assert fitted.sd_px[30] > 3 * fitted.sd_px[clean].mean()

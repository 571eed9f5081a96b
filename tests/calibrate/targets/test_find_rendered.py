"""Boards found in rendered pictures: where the truth is, with a stated error that is true."""

import re
from functools import cache

import numpy as np
import pytest
from rendered_boards import Picture, picture

from tagmetry.calibrate.targets import RejectedView, find_board
from tagmetry.calibrate.view import BoardView
from tagmetry.files.board_text import parse_board
from tagmetry.geometry import Array

BOARDS = {
    "chessboard": parse_board("chessboard:9x6:25mm"),
    "charuco": parse_board("charuco:8x6:30mm:20mm:5x5_100"),
    "legacy": parse_board("charuco:8x6:30mm:20mm:5x5_100:legacy"),
    "grid": parse_board("grid:4x3:50mm:14mm:6x6_250"),
    "aprilgrid": parse_board("aprilgrid:4x3:50mm:0.3"),
    "circles": parse_board("circles:7x5:30mm:16mm"),
    "staggered": parse_board("asymmetric-circles:4x9:20mm:14mm"),
}
SPACING_PX = {"grid": 46.0, "aprilgrid": 17.0, "charuco": 32.0, "legacy": 32.0}
WORST_PX = {"grid": 0.06}  # the detector's; a fitted corner is better
every_board = pytest.mark.parametrize("name", BOARDS)
SADDLES = pytest.mark.parametrize("name", ["chessboard", "charuco", "aprilgrid"])


@cache
def taken(name: str, seed: int = 0, **wanted: object) -> Picture:
    return picture(BOARDS[name], seed, spacing_px=SPACING_PX.get(name, 28.0), **wanted)


def found(name: str, pixels: np.ndarray, **wanted: object) -> BoardView:
    view = find_board(pixels, BOARDS[name], source="rendered", **wanted)
    assert isinstance(view, BoardView), view.reason
    return view


def rms(errors: Array) -> float:
    return float(np.sqrt((errors**2).mean()))


@every_board
def test_every_point_is_where_it_truly_is(name: str) -> None:
    shown = taken(name)
    view = found(name, shown.pixels)
    np.testing.assert_array_equal(view.points, np.arange(len(BOARDS[name].corners_m)))
    np.testing.assert_array_equal(view.p_board, BOARDS[name].corners_m)
    assert (view.size_px, view.source) == ((480, 400), "rendered")
    assert rms(shown.errors_px(view)) < WORST_PX.get(name, 0.02)


@every_board
@pytest.mark.parametrize("tilt_deg", [0.0, 50.0])
def test_points_are_found_at_any_tilt(name: str, tilt_deg: float) -> None:
    shown = taken(name, tilt_deg=tilt_deg, axis_deg=70.0)
    view = found(name, shown.pixels)
    assert rms(shown.errors_px(view)) < WORST_PX.get(name, 0.02)


@pytest.mark.parametrize(
    ("name", "roll_deg"),
    [
        pytest.param(name, roll, marks=[] if roll in short else [pytest.mark.slow])
        for name, short in (
            ("chessboard", (-135.0, 180.0)),
            ("charuco", (90.0,)),
            ("grid", (-90.0,)),
            ("aprilgrid", (180.0,)),
            ("staggered", (-135.0, 90.0)),
        )
        for roll in (-135.0, -90.0, 90.0, 180.0)
    ],
)
def test_a_turned_board_is_counted_from_its_own_first_point(name: str, roll_deg: float) -> None:
    shown = taken(name, roll_deg=roll_deg)
    view = found(name, shown.pixels)
    assert np.abs(shown.errors_px(view)).max() < 0.3


@pytest.mark.parametrize("text", ["circles:7x5:30mm:16mm", "chessboard:7x5:25mm"])
def test_a_board_that_looks_the_same_turned_is_counted_to_the_right(text: str) -> None:
    board = parse_board(text)
    shown = picture(board, spacing_px=28.0, roll_deg=200.0)
    view = find_board(shown.pixels, board)
    assert isinstance(view, BoardView)
    assert view.corners_px[1, 0] > view.corners_px[0, 0]
    turned = view.corners_px - shown.truth_px[::-1][view.points]
    assert rms(turned) < 0.02


def test_a_square_board_of_odd_counts_stands_upright() -> None:
    board = parse_board("chessboard:5x5:25mm")
    shown = picture(board, spacing_px=28.0, roll_deg=30.0)
    view = find_board(shown.pixels, board)
    assert isinstance(view, BoardView)
    assert rms(shown.errors_px(view)) < 0.02


STATED = [("chessboard", 4.0), ("charuco", 4.0), ("aprilgrid", 10.0), ("staggered", 4.0)]
NOISES = [(name, noise) for noise in (1.0, 4.0, 10.0) for name, _ in STATED]
BLURS = [(name, blur) for blur in (0.35, 1.0, 2.0) for name in ("chessboard", "aprilgrid")]
BLURS += [("staggered", blur) for blur in (0.35, 1.0, 2.0)]
SHORT = [*STATED, ("chessboard", 0.35), ("chessboard", 2.0), ("staggered", 1.0)]


def short_and_slow(cases: list[tuple[str, float]]) -> list[object]:
    """Return all cases, those marked as slow that the short run can do without."""
    return [pytest.param(*one, marks=[] if one in SHORT else [pytest.mark.slow]) for one in cases]


@pytest.mark.parametrize(("name", "noise"), short_and_slow(NOISES))
def test_the_stated_error_is_the_true_one_at_any_noise(name: str, noise: float) -> None:
    assert_stated_is_true(name, noise=noise, blur_px=0.5)


@pytest.mark.parametrize(("name", "blur_px"), short_and_slow(BLURS))
def test_the_stated_error_is_the_true_one_at_any_blur(name: str, blur_px: float) -> None:
    assert_stated_is_true(name, noise=5.0, blur_px=blur_px)


def assert_stated_is_true(name: str, **look: float) -> None:
    rng, whitened = np.random.default_rng(3), []
    for seed in range(4):
        pose = {"roll_deg": rng.uniform(-40, 40), "axis_deg": rng.uniform(0, 360)}
        aside_px = tuple(rng.uniform(-2, 2, 2))
        shown = taken(name, seed, aside_px=aside_px, **pose, **look)
        view = found(name, shown.pixels)
        whitened.append(shown.errors_px(view) / view.sd_px[:, None])
    assert rms(np.concatenate(whitened)) == pytest.approx(1.0, abs=0.25)


@SADDLES
def test_ink_that_spread_does_not_move_a_corner(name: str) -> None:
    """Every black edge grown outward, as a gamma curve and spread ink do."""
    shown = taken(name, noise=0.5)
    curved = np.rint(255 * (shown.pixels / 255) ** 0.45).astype(np.uint8)
    view = found(name, curved)
    assert rms(shown.errors_px(view)) < 0.02


@pytest.mark.parametrize("name", ["circles", "staggered"])
def test_a_tilted_disc_s_centre_is_that_of_the_disc_not_of_the_ellipse(name: str) -> None:
    shown = taken(name, tilt_deg=55.0, axis_deg=90.0, noise=0.5, size_px=(500, 500))
    view = found(name, shown.pixels)
    assert np.abs(shown.errors_px(view).mean(axis=0)).max() < 0.01


@pytest.mark.parametrize("name", ["charuco", "grid", "aprilgrid"])
def test_a_board_seen_in_part_gives_what_is_seen(name: str) -> None:
    shown = taken(name, aside_px=(150.0, 60.0))
    view = found(name, shown.pixels)
    assert 6 <= len(view.points) < len(BOARDS[name].corners_m)
    assert rms(shown.errors_px(view)) < 0.06


@SADDLES
def test_colour_and_16_bits_give_the_same_points(name: str) -> None:
    grey = found(name, taken(name).pixels)
    colour = found(name, np.repeat(taken(name).pixels[..., None], 3, axis=2))
    np.testing.assert_allclose(colour.corners_px, grey.corners_px, atol=1e-6)
    deep = taken(name, bits=16, noise=2.0 * 257)
    assert deep.pixels.dtype == np.uint16
    assert rms(deep.errors_px(found(name, deep.pixels))) < 0.02


@SADDLES
def test_a_lens_distortion_does_not_lose_corners(name: str) -> None:
    shown = taken(name, coefficients=(-0.35, 0.1, 0.0, 0.0))
    view = found(name, shown.pixels)
    assert len(view.points) >= 0.95 * len(BOARDS[name].corners_m)
    assert rms(shown.errors_px(view)) < 0.03


@pytest.mark.parametrize("name", ["charuco", "grid"])
def test_a_board_printed_white_on_black_is_found(name: str) -> None:
    shown = taken(name)
    view = found(name, 255 - shown.pixels)
    assert rms(shown.errors_px(view)) < WORST_PX.get(name, 0.02)


@pytest.mark.parametrize(
    ("shown_name", "asked", "reason"),
    [
        ("charuco", "charuco:8x6:30mm:20mm:5x5_100:legacy", r"fit the new layout \(not legacy\)"),
        ("legacy", "charuco:8x6:30mm:20mm:5x5_100", r"fit the old layout \(legacy\)"),
        ("charuco", "charuco:6x8:30mm:20mm:5x5_100", "check columns, rows and the first id"),
        ("charuco", "charuco:8x6:30mm:20mm:4x4_50", "none of the board's 24 markers"),
        ("grid", "grid:4x3:50mm:14mm:4x4_50", r"none of the board's 12 markers \(4x4_50\)"),
        ("chessboard", "chessboard:11x8:25mm", "no chessboard with 11x8 inner corners"),
        ("circles", "circles:9x9:30mm:16mm", "no grid of 9x9 discs"),
    ],
)
def test_another_board_is_told_from_the_one_asked_for(
    shown_name: str, asked: str, reason: str
) -> None:
    result = find_board(taken(shown_name).pixels, parse_board(asked), source="left.png")
    assert isinstance(result, RejectedView)
    assert result.source == "left.png"
    assert re.search(reason, result.reason)

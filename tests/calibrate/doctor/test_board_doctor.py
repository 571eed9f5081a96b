"""Boards that are not what was asked for are named, on rendered pictures of the real ones."""

from functools import cache

import cv2
import numpy as np
import pytest

from tagmetry.calibrate.doctor import BoardAdvice, diagnose_board
from tagmetry.camera import BrownLens, Camera
from tagmetry.files.board_text import board_text, parse_board
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin import Optics, Scene, Shot, photograph
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.scenes import Still, board_thing

CAMERA = Camera(640, 480, (700.0, 700.0), (319.5, 239.5), BrownLens((-0.1, 0.03, 0.0, 0.0)))
TILTS = ((25, 40, 10), (20, 160, -15))

CHESS = "chessboard:9x6:25mm"
CHARUCO = "charuco:7x6:30mm:22mm:5x5_100"
APRIL = "aprilgrid:5x4:30mm:0.3"
GRID = "grid:5x4:30mm:8mm:4x4_50"


@cache
def pictures(text: str) -> tuple[np.ndarray, ...]:
    """Return two pictures of a board that fills most of them."""
    board = parse_board(text)
    away_m = 1.35 * max(board.width_m / 640, board.height_m / 480) * 700
    shots = []
    for seed, (tilt, axis, roll) in enumerate(TILTS):
        about = np.radians(tilt) * np.array([np.cos(np.radians(axis)), np.sin(np.radians(axis)), 0])
        turn = Rotation.from_rotvec(about) * Rotation.from_euler("xz", [180, roll], degrees=True)
        path = Still(RigidTransform.from_components([0, 0, away_m], turn))
        scene = Scene((board_thing(board, path, margin_m=0.02),))
        still = Still(RigidTransform.identity())
        shot = Shot(CAMERA, still, optics=Optics(blur_px=0.6), sensor=Sensor(noise_grey=2.0))
        shots.append(photograph(scene, shot, np.random.default_rng(seed)))
    return tuple(shots)


def told(shown: str, asked: str) -> tuple[BoardAdvice, ...]:
    return diagnose_board(pictures(shown), parse_board(asked))


def slowly(*values: object) -> object:
    """Return a case that is left to the long run; a like one is in the short run."""
    return pytest.param(*values, marks=pytest.mark.slow)


@pytest.mark.parametrize("text", [CHESS, CHARUCO, slowly(APRIL), GRID, slowly(f"{CHARUCO}:legacy")])
def test_nothing_is_said_of_the_right_board(text: str) -> None:
    assert told(text, text) == ()


def test_a_chessboard_asked_for_turned_is_named_and_harmless() -> None:
    (advice,) = told(CHESS, "chessboard:6x9:25mm")
    assert advice.severity == "hint"
    assert advice.title == "columns and rows swapped"
    assert "the camera comes out the same" in str(advice)
    assert board_text(advice.board) == CHESS


def test_one_picture_of_a_board_on_its_side_says_nothing() -> None:
    assert diagnose_board(pictures(CHESS)[:1], parse_board("chessboard:6x9:25mm")) == ()


@pytest.mark.parametrize(
    ("shown", "asked", "title", "instead"),
    [
        (CHESS, "chessboard:10x7:25mm", "squares counted instead of inner corners", CHESS),
        slowly(CHESS, "chessboard:8x5:25mm", "one too few in both directions", CHESS),
        slowly(CHESS, "chessboard:7x10:25mm", "squares counted", "chessboard:6x9:25mm"),
        slowly(CHARUCO, f"{CHARUCO}:legacy", "not the legacy layout", CHARUCO),
        (f"{CHARUCO}:legacy", CHARUCO, "legacy layout", f"{CHARUCO}:legacy"),
        (CHARUCO, "charuco:6x7:30mm:22mm:5x5_100", "columns and rows swapped", CHARUCO),
        (CHARUCO, "charuco:6x5:30mm:22mm:5x5_100", "inner corners counted", CHARUCO),
        slowly(CHARUCO, "charuco:8x7:30mm:22mm:5x5_100", "one too many in both", CHARUCO),
        (CHARUCO, f"{CHARUCO}:10", "ids from 0", CHARUCO),
        slowly(f"{CHARUCO}:20", CHARUCO, "ids from 20", f"{CHARUCO}:20"),
        slowly(CHARUCO, "charuco:7x5:30mm:22mm:5x5_100", "only a part of the board", CHARUCO),
        (CHARUCO, "grid:4x5:22mm:8mm:5x5_100", "another kind of board", CHARUCO),
        slowly(APRIL, "aprilgrid:4x5:30mm:0.3", "columns and rows swapped", APRIL),
        slowly(APRIL, "grid:5x4:30mm:9mm:tag36h11_border2", "rows counted from the other", None),
        slowly(GRID, "grid:4x5:30mm:8mm:4x4_50", "columns and rows swapped", GRID),
        (GRID, f"{GRID}:from-bottom", "rows counted from the other side", GRID),
    ],
)
def test_another_board_is_named(shown: str, asked: str, title: str, instead: str | None) -> None:
    advice = told(shown, asked)[0]
    assert title in advice.title
    assert advice.board is not None
    if instead is not None:
        assert board_text(advice.board) == board_text(parse_board(instead))


@pytest.mark.parametrize("asked", ["chessboard:8x6:25mm", slowly("chessboard:7x6:25mm")])
def test_a_chessboard_with_more_corners_than_asked_for_is_counted(asked: str) -> None:
    advice = told(CHESS, asked)[0]
    assert advice.title in ("other numbers of corners", "only a part of the board is used")
    assert board_text(advice.board) == CHESS


@pytest.mark.slow
def test_few_rows_tell_the_layout_by_the_few_markers_that_wrap() -> None:
    board = "charuco:9x4:30mm:22mm:4x4_100"
    advice = told(f"{board}:legacy", board)[0]
    assert advice.title == "legacy layout"
    assert board_text(advice.board) == f"{board}:legacy"


def test_another_family_is_named_and_the_layout_beside() -> None:
    family, layout = told(f"{CHARUCO}:legacy", "charuco:7x6:30mm:22mm:4x4_50")
    assert family.title == "another family of markers"
    assert layout.title == "legacy layout"
    assert board_text(family.board) == "charuco:7x6:30mm:22mm:5x5_50:legacy"


def test_a_border_of_another_width_is_another_family() -> None:
    advice = told(APRIL, "aprilgrid:5x4:30mm:0.3:tag36h11")[0]
    assert advice.title == "another family of markers"
    assert advice.board.family == "tag36h11_border2"


@pytest.mark.parametrize(
    ("shown", "asked", "size_m"),
    [(CHARUCO, "charuco:7x6:30mm:18mm:5x5_100", 0.022), (GRID, "grid:5x4:25mm:13mm:4x4_50", 0.03)],
)
def test_another_size_of_markers_is_measured(shown: str, asked: str, size_m: float) -> None:
    advice = told(shown, asked)[0]
    assert advice.title == "another size of markers"
    assert advice.board.size_m == pytest.approx(size_m, rel=0.01)


def test_a_plain_chessboard_is_told_from_a_board_of_markers() -> None:
    advice = told(CHESS, CHARUCO)[0]
    assert advice.title == "a plain chessboard is seen"
    assert board_text(advice.board) == "chessboard:9x6:30mm"


def test_a_board_of_markers_is_told_from_one_of_circles() -> None:
    circles = told(CHARUCO, "circles:7x5:30mm:15mm")[0]
    assert circles.title == "a board of markers is seen"
    assert (circles.board.columns, circles.board.rows) == (7, 6)


def test_white_on_black_is_a_hint() -> None:
    inverted = [255 - one for one in pictures(CHARUCO)]
    (advice,) = diagnose_board(inverted, parse_board(CHARUCO))
    assert (advice.severity, advice.title) == ("hint", "printed white on black")


def test_a_covered_chessboard_is_named() -> None:
    covered = [one.copy() for one in pictures(CHESS)]
    for grey in covered:
        cv2.rectangle(grey, (0, 0), (250, 480), 128, -1)
    (advice,) = diagnose_board(covered, parse_board(CHESS))
    assert advice.title in ("board not seen whole", "other numbers of corners")


@pytest.mark.slow
def test_the_grid_of_circles_that_is_seen_is_counted() -> None:
    advice = told("circles:7x5:30mm:15mm", "circles:8x6:30mm:15mm")[0]
    assert board_text(advice.board) == "circles:7x5:30mm:15mm"


@pytest.mark.parametrize("text", [CHESS, CHARUCO, slowly(APRIL), slowly("circles:7x5:30mm:15mm")])
def test_pictures_without_any_board_lead_to_no_advice(text: str) -> None:
    noise = np.random.default_rng(0).integers(0, 256, (120, 160), dtype=np.uint8)
    flat, tiny = np.full((120, 160), 128, np.uint8), np.zeros((1, 1), np.uint8)
    assert diagnose_board([noise, flat, tiny], parse_board(text)) == ()
    assert diagnose_board([], parse_board(text)) == ()

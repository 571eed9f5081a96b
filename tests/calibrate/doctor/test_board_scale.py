"""What a ruler says of a print, and what the camera says of its aspect."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.calibrate.doctor import check_measured, check_print_aspect
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.view import BoardView, round_covariances
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.files.board_text import parse_board
from tagmetry.geometry import Array
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Chessboard

BOARD = Chessboard(9, 6, 0.025)  # 250 by 175 mm


def test_a_print_at_its_size_is_well() -> None:
    assert check_measured(BOARD, {"width": 0.2502, "height": 0.1751, "square": 0.025}) == ()


@pytest.mark.parametrize("scale", [0.94, 1.03])
def test_another_scale_is_named_with_the_board_at_that_scale(scale: float) -> None:
    (advice,) = check_measured(BOARD, {"width": 0.25 * scale})
    assert advice.title == "printed at another scale"
    assert f"{scale - 1:+.1%}" in advice.remedy
    assert advice.board.square_m == pytest.approx(0.025 * scale, abs=6e-6)


@pytest.mark.parametrize(
    ("text", "name", "length_m"),
    [
        ("charuco:7x5:30mm:22mm:5x5_100", "marker", 0.022),
        ("aprilgrid:6x6:88mm:0.3", "marker", 0.088),
        ("grid:4x5:37.5mm:5mm:6x6_250", "width", 4 * 0.0375 + 3 * 0.005),
        ("circles:7x5:30mm:15mm", "width", None),
    ],
)
def test_every_board_is_rescaled_as_a_whole(text: str, name: str, length_m: float | None) -> None:
    board = parse_board(text)
    (advice,) = check_measured(board, {name: 0.9 * (length_m or board.width_m)})
    assert advice.board.width_m == pytest.approx(0.9 * board.width_m, rel=1e-3)
    assert advice.board.height_m == pytest.approx(0.9 * board.height_m, rel=1e-3)


def test_a_print_longer_one_way_is_named() -> None:
    (advice,) = check_measured(BOARD, {"width": 0.25, "height": 0.17})
    assert advice.title == "printed longer one way than the other"
    assert advice.board is None


def test_lengths_of_another_board_are_named() -> None:
    (advice,) = check_measured(BOARD, {"width": 0.25, "square": 0.03})
    assert advice.title == "lengths that do not go together"


@pytest.mark.parametrize("name", ["marker", "length", ""])
def test_a_length_that_the_board_does_not_have_is_refused(name: str) -> None:
    with pytest.raises(InputError, match="expected a measured length of width"):
        check_measured(BOARD, {name: 0.1})


def seen_by(focal_px: tuple[float, float], stretch: float) -> Calibration:
    """Calibrate from noisy views of a board whose real print is longer in x by a factor."""
    rng, p_board = np.random.default_rng(1), BOARD.corners_m
    camera = Camera(1280, 960, focal_px, (639.5, 479.5))
    views: list[BoardView] = []
    while len(views) < 12:
        pixels = camera.project(_placed(p_board * [stretch, 1, 1], rng))
        if not camera.contains(pixels).all():
            continue
        pixels = pixels + rng.normal(0, 0.05, pixels.shape)
        covariances_px2 = round_covariances(np.full(len(pixels), 0.05))
        views.append(BoardView(1280, 960, np.arange(len(pixels)), p_board, pixels, covariances_px2))
    return calibrate(views, "brown2")


def _placed(p_board: Array, rng: np.random.Generator) -> Array:
    """Hold the board upright, tilted by up to 40 degrees, never turned in its plane."""
    tilt = Rotation.from_rotvec([*np.radians(rng.uniform(-40, 40, 2)), 0.0])
    turned = (tilt * Rotation.from_euler("x", 180, degrees=True)).apply(p_board)
    aside = np.array([*rng.uniform(-0.06, 0.06, 2), rng.uniform(0.3, 0.5)])
    return turned + aside


def test_square_pixels_and_a_true_print_are_well() -> None:
    assert check_print_aspect(seen_by((1000.0, 1000.0), 1.0)) == ()


@pytest.mark.parametrize(("fx", "stretch"), [(1030.0, 1.0), (1000.0, 1.03)])
def test_pixels_or_print_that_are_not_square_are_named_and_not_told_apart(
    fx: float, stretch: float
) -> None:
    (advice,) = check_print_aspect(seen_by((fx, 1000.0), stretch))
    assert advice.severity == "hint"
    assert "fx / fy = 1.0" in advice.found
    assert "ruler" in advice.remedy


def test_without_a_covariance_nothing_is_said() -> None:
    solved = seen_by((1030.0, 1000.0), 1.0)
    without = replace(solved, camera=replace(solved.camera, covariance=None))
    assert check_print_aspect(without) == ()

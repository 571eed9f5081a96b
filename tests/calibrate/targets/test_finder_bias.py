"""What a corner finder does to all views alike: no noise averages that out, so it must be none.

The pictures have only so much noise as takes the steps out of whole grey values.
"""

import numpy as np
import pytest
from rendered_boards import Picture, picture

from tagmetry.calibrate.targets import find_board
from tagmetry.calibrate.targets.bends import line_bends
from tagmetry.calibrate.targets.saddles import fit_saddles
from tagmetry.calibrate.view import BoardView
from tagmetry.files.board_text import parse_board
from tagmetry.geometry import Array
from tagmetry.markers import Board

CHESSBOARD = parse_board("chessboard:9x6:25mm")
CHARUCO = parse_board("charuco:9x7:30mm:20mm:5x5_100")
BARREL, PINCUSHION = (-0.35, 0.1, 0.0, 0.0), (0.3, 0.1, 0.0, 0.0)


def curved(board: Board, coefficients: tuple[float, ...], **wanted: float) -> Picture:
    look = {"spacing_px": 44.0, "noise": 0.5, "size_px": (560, 480), **wanted}
    return picture(board, coefficients=coefficients, **look)


def inward_px(board: Board, shown: Picture, errors_px: Array) -> float:
    """Return how far corners are off, on average, to the inside of the curves through them.

    Where a curve turns to y from x, its inside lies to that side of the step.
    """
    truth_px = shown.truth_px
    bends = line_bends(board.corners_m[:, :2], truth_px).values
    grid_px = truth_px.reshape(6, -1, 2)
    inward = 0.0
    for axis, bend in ((1, bends[:, 0]), (0, bends[:, 1])):
        along = np.gradient(grid_px, axis=axis).reshape(-1, 2)
        aside = along @ np.array([[0.0, 1.0], [-1.0, 0.0]])
        unit = aside / np.linalg.norm(aside, axis=1, keepdims=True)
        inward += np.average((errors_px * unit).sum(axis=1) * np.sign(bend), weights=np.abs(bend))
    return float(inward / 2)


@pytest.mark.parametrize("board", [CHESSBOARD, CHARUCO], ids=["chessboard", "charuco"])
@pytest.mark.parametrize("lens", [BARREL, PINCUSHION], ids=["barrel", "pincushion"])
def test_bent_edges_pull_no_corner_to_their_inside(board: Board, lens: tuple[float, ...]) -> None:
    shown = curved(board, lens)
    view = find_board(shown.pixels, board)
    assert isinstance(view, BoardView)
    assert len(view.points) == len(board.corners_m)
    errors_px = shown.errors_px(view)
    assert abs(inward_px(board, shown, errors_px)) < 3e-4
    assert np.sqrt((errors_px**2).mean()) < 2e-3


def test_taken_for_straight_they_would() -> None:
    shown = curved(CHESSBOARD, BARREL)
    grid = shown.truth_px.reshape(6, 9, 2)
    steps = [np.gradient(grid, axis=axis).reshape(-1, 2) for axis in (1, 0)]
    straight = fit_saddles(shown.pixels, shown.truth_px, *steps)
    errors_px = straight.centres_px - shown.truth_px
    assert inward_px(CHESSBOARD, shown, errors_px) > 3e-3


def test_light_that_falls_off_pulls_no_corner_to_the_brighter_side() -> None:
    shown = curved(CHESSBOARD, ())
    light = 1 - 0.3 * np.arange(shown.pixels.shape[1]) / shown.pixels.shape[1]
    shaded = np.rint(shown.pixels * light).astype(np.uint8)
    view = find_board(shaded, CHESSBOARD)
    assert isinstance(view, BoardView)
    assert np.abs(shown.errors_px(view).mean(axis=0)).max() < 3e-4
    assert np.sqrt((shown.errors_px(view) ** 2).mean()) < 2e-3


@pytest.mark.parametrize("gamma", [0.45, 2.2])
def test_a_gamma_curve_pulls_no_corner(gamma: float) -> None:
    shown = curved(CHESSBOARD, BARREL)
    coded = np.rint(255 * (shown.pixels / 255) ** gamma).astype(np.uint8)
    view = find_board(coded, CHESSBOARD)
    assert isinstance(view, BoardView)
    assert abs(inward_px(CHESSBOARD, shown, shown.errors_px(view))) < 5e-4

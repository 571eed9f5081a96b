"""Circle grids and the calibration points of every board."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.markers import AprilGrid, Board, CharucoBoard, Chessboard, CircleGrid, GridBoard

BOARDS = [
    Chessboard(9, 6, 0.025),
    CharucoBoard(7, 5, 0.03, 0.02),
    GridBoard(3, 2, 0.05, 0.02),
    AprilGrid(3, 2, 0.05, 0.3),
    CircleGrid(4, 3, 0.03, 0.02),
    CircleGrid(4, 11, 0.02, 0.015, asymmetric=True),
]


@pytest.mark.parametrize("rows", [10, 11])
def test_a_staggered_grid_is_opencv_s(rows: int) -> None:
    """OpenCV's tutorial: x = (2 column + row % 2) pitch, y = row pitch, y down."""
    board = CircleGrid(4, rows, 0.02, 0.01, asymmetric=True)
    theirs = np.array([(2 * j + i % 2, -i, 0) for i in range(rows) for j in range(4)]) * 0.02
    np.testing.assert_allclose(board.corners_m - board.corners_m[0], theirs, atol=1e-12)


def test_a_straight_grid_s_neighbours_are_a_pitch_apart() -> None:
    expected = [[-0.03, 0.015], [0, 0.015], [0.03, 0.015], [-0.03, -0.015], [0, -0.015],
                [0.03, -0.015]]  # fmt: skip
    found = CircleGrid(3, 2, 0.03, 0.01).corners_m
    np.testing.assert_allclose(found[:, :2], expected, atol=1e-12)


@pytest.mark.parametrize("board", BOARDS[4:])
def test_discs_reach_from_side_to_side(board: CircleGrid) -> None:
    x, y, radius = board.circles_m().T
    assert (x + radius).max() == pytest.approx(board.width_m / 2)
    assert (x - radius).min() == pytest.approx(-board.width_m / 2)
    assert (y + radius).max() == pytest.approx(board.height_m / 2)
    assert (y - radius).min() == pytest.approx(-board.height_m / 2)


@pytest.mark.parametrize("board", BOARDS)
def test_calibration_points_are_flat_distinct_and_within_the_board(board: Board) -> None:
    points = board.corners_m
    assert points.shape[1] == 3
    assert len(np.unique(points.round(9), axis=0)) == len(points)
    assert (np.abs(points) <= [board.width_m / 2 + 1e-12, board.height_m / 2 + 1e-12, 0]).all()


@pytest.mark.parametrize("board", BOARDS[2:4])
def test_a_grid_s_points_are_its_markers_corners_in_order(board: Board) -> None:
    for place, marker in enumerate(board.markers()):
        np.testing.assert_array_equal(board.corners_m[4 * place : 4 * place + 4], marker.corners_m)


@pytest.mark.parametrize("board", BOARDS[:4])
def test_only_circle_grids_have_discs(board: Board) -> None:
    assert board.circles_m().shape == (0, 3)
    assert BOARDS[4].markers() == ()
    assert BOARDS[4].black_squares_m().shape == (0, 3)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: CircleGrid(1, 3, 0.03, 0.01), "at least 2x2, got 1x3"),
        (lambda: CircleGrid(3, 3, 0.0, 0.01), "pitch_m must be positive"),
        (lambda: CircleGrid(3, 3, 0.03, np.nan), "diameter_m must be positive"),
        (lambda: CircleGrid(3, 3, 0.03, 0.03), r"centres are 0.03 m apart, got diameter_m 0.03"),
        (lambda: CircleGrid(3, 3, 0.03, 0.043, asymmetric=True), "centres are 0.0424264 m apart"),
    ],
)
def test_refuses_a_grid_that_cannot_be(make: object, text: str) -> None:
    with pytest.raises(InputError, match=text):
        make()

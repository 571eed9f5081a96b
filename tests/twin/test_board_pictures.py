"""Every square and disc of a board's picture is where the formulas say, and as large."""

import itertools

import numpy as np
import pytest
from board_squares import squares_m
from edge_measuring import darkness, outline_corners
from lens_formulas import project_px
from tilted_squares import LENSES, camera, sides_px, tilted

from tagmetry.geometry import Array, RigidTransform
from tagmetry.markers import CharucoBoard, Chessboard, CircleGrid
from tagmetry.twin import Optics, Scene, Shot, exposed
from tagmetry.twin.scenes import Still, board_thing

AT_CAMERA = Still(RigidTransform.identity())


def disc_px(disc: Array, T_camera_board: RigidTransform, lens: str) -> tuple[float, Array]:
    """The area and centroid of a disc's picture, by many points of its rim."""
    angle = np.linspace(0, 2 * np.pi, 4001)[:-1]
    rim = disc[:2] + disc[2] * np.column_stack([np.cos(angle), np.sin(angle)])
    p_camera = T_camera_board.apply(np.column_stack([rim, np.zeros(len(rim))]))
    here = project_px(p_camera, camera(LENSES[lens]))
    middle = here.mean(axis=0)
    x, y = (here - middle).T
    next_x, next_y = np.roll(x, -1), np.roll(y, -1)
    cross = x * next_y - next_x * y
    area = cross.sum() / 2
    moment = np.array([((x + next_x) * cross).sum(), ((y + next_y) * cross).sum()]) / (6 * area)
    return abs(float(area)), middle + moment


@pytest.mark.parametrize(
    "lens",
    ["none", "fisheye", *(pytest.param(name, marks=pytest.mark.slow) for name in ("5", "14"))],
)
@pytest.mark.parametrize(
    "board",
    [
        pytest.param(Chessboard(4, 3, 0.1), id="chessboard"),
        pytest.param(CharucoBoard(5, 4, 0.1, 0.07), id="charuco"),
    ],
)
def test_squares_are_true(board: Chessboard | CharucoBoard, lens: str) -> None:
    seer, T_camera_board = camera(LENSES[lens]), tilted(35, 0.3)
    picture = exposed(Scene((board_thing(board, Still(T_camera_board)),)), Shot(seer, AT_CAMERA))
    squares = squares_m(board)
    sides = [sides_px(corners, T_camera_board, seer) for corners in squares]
    for i, corners in enumerate(squares):
        beside = list(itertools.chain(*sides[:i], *sides[i + 1 :]))
        degree = 1 if lens == "none" else 3
        found = outline_corners(picture, sides[i], degree, beside_px=beside)
        true = project_px(T_camera_board.apply(corners), seer)
        np.testing.assert_allclose(found, true, atol=0.001)


@pytest.mark.parametrize(
    "lens",
    ["none", "fisheye", *(pytest.param(name, marks=pytest.mark.slow) for name in ("5", "14"))],
)
@pytest.mark.parametrize("tilt_deg", [0, 35, 45])
def test_discs_are_true(tilt_deg: float, lens: str) -> None:
    """The centroid of the picture of a disc, which is not the picture of its centre.

    Blurred, because the centroid over whole pixels of a sharp disc is itself off by 0.001 px.
    """
    board = CircleGrid(4, 3, 0.12, 0.05)
    seer, T_camera_board = camera(LENSES[lens]), tilted(tilt_deg, 0.3)
    thing = board_thing(board, Still(T_camera_board), margin_m=0.1)
    picture = exposed(Scene((thing,)), Shot(seer, AT_CAMERA, optics=Optics(blur_px=0.7)))
    for disc in board.circles_m():
        true_px2, true_px = disc_px(disc, T_camera_board, lens)
        found_px2, found_px = darkness(picture, true_px, 20)
        assert found_px2 == pytest.approx(true_px2, rel=1e-4)
        np.testing.assert_allclose(found_px, true_px, atol=0.0003)

"""Edges agree with an independent ray tracer's, POV-Ray's, within 0.01 px.

Both pictures are measured alike, from the light (`edge_measuring`). POV-Ray has no lens with
distortion: that is proven against formulas (`test_corner_truth`).
"""

import itertools
from pathlib import Path

import numpy as np
import pytest
from board_squares import squares_m
from edge_measuring import darkness, outline_corners
from lens_formulas import project_px
from povray_scene import traced

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import CharucoBoard, Chessboard, CircleGrid, MountedMarker
from tagmetry.twin import Scene, Shot, Thing, exposed
from tagmetry.twin.scenes import Sheet, Still, board_thing, marker_thing

pytestmark = pytest.mark.slow
CAMERA = Camera(320, 240, (310.0, 305.0), (157.3, 122.4))
SHOT = Shot(CAMERA, Still(RigidTransform.identity()))
AGREE_PX = 0.01


def at(x_m: float, y_m: float, z_m: float, tilt_deg: float, turn_deg: float) -> RigidTransform:
    turn = Rotation.from_euler("XZX", [180, turn_deg, tilt_deg], degrees=True)
    turn *= Rotation.from_euler("z", 13, degrees=True)
    return RigidTransform.from_components([x_m, y_m, z_m], turn)


def sides_px(corners_m: Array, T_camera_sheet: RigidTransform) -> list[Array]:
    share = np.linspace(0, 1, 101)[:, None]
    pairs = zip(corners_m, np.roll(corners_m, -1, axis=0), strict=True)
    return [project_px(T_camera_sheet.apply(a + share * (b - a)), CAMERA) for a, b in pairs]


def both(scene: Scene, folder: Path) -> tuple[Array, Array]:
    """The twin's picture and POV-Ray's, which must have the same light all over."""
    ours, theirs = exposed(scene, SHOT).astype(np.float64), traced(scene, CAMERA, folder)
    assert np.abs(ours - theirs).max() < 0.06  # 16 x 16 rays at a level edge err by 1/16 at most
    assert np.sqrt(np.mean((ours - theirs) ** 2)) < 0.005
    assert ours.mean() == pytest.approx(theirs.mean(), abs=2e-5)
    return ours, theirs


def agree(
    ours: Array, theirs: Array, sides: list[Array], beside: list[Array] | None = None
) -> None:
    """Corners of a quadrilateral measured in both; with both ends an edge is the same all along."""
    our_px, their_px = (outline_corners(p, sides, beside_px=beside) for p in (ours, theirs))
    np.testing.assert_allclose(our_px, their_px, atol=AGREE_PX)


@pytest.mark.parametrize("tilt_deg", [5, 40, 65])
def test_a_marker(tilt_deg: float, tmp_path: Path) -> None:
    T_camera_marker = at(0.05, -0.03, 1.0, tilt_deg, 31)
    marker = MountedMarker("tag36h11", 7, 0.36, RigidTransform.identity())
    ours, theirs = both(Scene((marker_thing([marker], Still(T_camera_marker)),)), tmp_path)
    black = Sheet(0.36, 0.36).corners_m
    agree(ours, theirs, sides_px(black, T_camera_marker))
    agree(ours, theirs, sides_px(1.25 * black, T_camera_marker))


def test_one_sheet_over_another(tmp_path: Path) -> None:
    T_far, T_near = at(0.0, 0.0, 1.2, 30, -20), at(-0.1, 0.05, 0.8, 50, 40)
    far, near = Sheet(0.7, 0.6, paper=0.9), Sheet(0.25, 0.25, paper=0.1)
    things = (
        Thing("near", (near,), path=Still(T_near)),
        Thing("far", (far,), path=Still(T_far)),
    )
    ours, theirs = both(Scene(things), tmp_path)
    on_near, on_far = sides_px(near.corners_m, T_near), sides_px(far.corners_m, T_far)
    agree(ours, theirs, on_near, beside=on_far)
    middle = np.mean(on_near, axis=(0, 1))
    covered = [
        middle + share * (side - middle) for share in np.linspace(0, 1, 50) for side in on_near
    ]
    agree(ours, theirs, on_far, beside=covered)


@pytest.mark.parametrize(
    "board",
    [
        pytest.param(Chessboard(5, 4, 0.1), id="chessboard"),
        pytest.param(CharucoBoard(6, 5, 0.1, 0.07), id="charuco"),
    ],
)
def test_a_boards_squares(board: Chessboard | CharucoBoard, tmp_path: Path) -> None:
    T_camera_board = at(0.0, 0.02, 0.95, 35, 25)
    ours, theirs = both(Scene((board_thing(board, Still(T_camera_board)),)), tmp_path)
    squares = squares_m(board)
    assert len(squares) == 15
    sides = [sides_px(corners, T_camera_board) for corners in squares]
    for i, own in enumerate(sides):
        agree(ours, theirs, own, beside=list(itertools.chain(*sides[:i], *sides[i + 1 :])))


@pytest.mark.parametrize("asymmetric", [False, True])
def test_a_circle_grid(asymmetric: bool, tmp_path: Path) -> None:
    pitch_m = 0.07 if asymmetric else 0.12
    board = CircleGrid(5, 5, pitch_m, 0.06, asymmetric)
    T_camera_board = at(0.0, 0.02, 0.95, 35, 25)
    thing = board_thing(board, Still(T_camera_board), margin_m=0.05)
    ours, theirs = both(Scene((thing,)), tmp_path)
    for middle_px in project_px(T_camera_board.apply(board.corners_m), CAMERA):
        (our_px2, our_px), (their_px2, their_px) = (
            darkness(picture, middle_px, 12) for picture in (ours, theirs)
        )
        np.testing.assert_allclose(our_px, their_px, atol=AGREE_PX)
        assert our_px2 == pytest.approx(their_px2, rel=1e-3)

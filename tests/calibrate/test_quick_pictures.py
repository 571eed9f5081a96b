"""The study's quick pictures beside those of the twin, which takes every pixel's exact mean."""

import numpy as np
import pytest
from quick_pictures import QuickCamera

from tagmetry.calibrate.targets.saddles import fit_saddles
from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.files.board_text import parse_board
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin import Optics, Scene, Shot, exposed
from tagmetry.twin.scenes import Still, board_thing

BOARD = parse_board("chessboard:9x6:25mm")
BLUR_PX = 0.8
LENSES = [BrownLens((-0.25, 0.08, 0.001, -0.0005)), FisheyeLens((0.02, -0.01, 0.003, -0.001))]


@pytest.mark.parametrize("lens", LENSES, ids=["brown", "fisheye"])
def test_their_light_and_their_corners_are_the_twin_s(lens: BrownLens | FisheyeLens) -> None:
    camera = Camera(320, 240, (300.0, 300.0), (161.2, 118.7), lens)
    turn = Rotation.from_rotvec([0.5, -0.3, 0.1]) * Rotation.from_euler("x", 180, degrees=True)
    T_camera_board = RigidTransform.from_components([0.01, 0.0, 0.32], turn)
    shot = Shot(camera, Still(RigidTransform.identity()), optics=Optics(BLUR_PX))
    paper = board_thing(BOARD, Still(T_camera_board), margin_m=0.5)
    exact = exposed(Scene((paper,)), shot)
    quick = QuickCamera.of(camera).light(BOARD, T_camera_board, BLUR_PX)
    assert np.abs(quick - exact).max() < 0.005
    truth_px = camera.project(T_camera_board.apply(BOARD.corners_m))
    grid = truth_px.reshape(6, 9, 2)
    steps = [np.gradient(grid, axis=axis).reshape(-1, 2) for axis in (1, 0)]
    found = [
        fit_saddles(np.rint(250 * light).astype(np.uint8), truth_px, *steps).centres_px
        for light in (quick, exact)
    ]
    apart_px = found[0] - found[1]
    assert np.abs(apart_px.mean(axis=0)).max() < 3e-4
    assert np.sqrt((apart_px**2).mean()) < 2e-3

"""Rendered boards whose points are known, in any pose, lens, blur and noise."""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.view import BoardView
from tagmetry.camera import BrownLens, Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Board
from tagmetry.twin import Optics, Scene, Shot, photograph
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.scenes import Still, board_thing

FOCAL_PX = 700.0


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture of a board, the camera that took it, where the board and its points truly are."""

    pixels: np.ndarray
    camera: Camera
    truth_px: Array
    T_camera_board: RigidTransform

    def errors_px(self, view: BoardView) -> Array:
        """Return found minus true, shape (n, 2)."""
        return view.corners_px - self.truth_px[view.points]


def picture(
    board: Board,
    seed: int = 0,
    *,
    spacing_px: float = 24.0,
    tilt_deg: float = 25.0,
    axis_deg: float = 40.0,
    roll_deg: float = 10.0,
    aside_px: tuple[float, float] = (0.0, 0.0),
    size_px: tuple[int, int] = (480, 400),
    coefficients: tuple[float, ...] = (),
    blur_px: float = 0.6,
    noise: float = 2.0,
    brightness: float = 1.0,
    bits: int = 8,
) -> Picture:
    """Photograph a board about the picture's middle; `spacing_px` is that of `spacing_m`."""
    width_px, height_px = size_px
    center_px = ((width_px - 1) / 2, (height_px - 1) / 2)
    camera = Camera(width_px, height_px, (FOCAL_PX, FOCAL_PX), center_px, BrownLens(coefficients))
    distance_m = FOCAL_PX * spacing_m(board) / spacing_px
    place = np.array([*(np.array(aside_px) * distance_m / FOCAL_PX), distance_m])
    T_camera_board = RigidTransform.from_components(place, facing(tilt_deg, axis_deg, roll_deg))
    shot = Shot(
        camera,
        Still(RigidTransform.identity()),
        optics=Optics(blur_px=blur_px),
        sensor=Sensor(noise_grey=noise, bits=bits),
        brightness=brightness,
    )
    scene = Scene((board_thing(board, Still(T_camera_board), margin_m=spacing_m(board)),))
    pixels = photograph(scene, shot, np.random.default_rng(seed))
    truth_px = camera.project(T_camera_board.apply(board.corners_m))
    return Picture(pixels, camera, truth_px, T_camera_board)


def facing(tilt_deg: float, axis_deg: float, roll_deg: float) -> Rotation:
    """Return R_camera_board of a board that faces the camera, turned, then tilted."""
    axis = np.radians(axis_deg)
    tilt = Rotation.from_rotvec(np.radians(tilt_deg) * np.array([np.cos(axis), np.sin(axis), 0]))
    return tilt * Rotation.from_euler("xz", [180, roll_deg], degrees=True)


def spacing_m(board: Board) -> float:
    """Return the distance between neighbouring points."""
    between = np.linalg.norm(board.corners_m[1:] - board.corners_m[0], axis=1)
    return float(between.min())

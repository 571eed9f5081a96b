"""A board held up in many ways, to calibrate a camera."""

import numpy as np

from tagmetry.errors import InputError
from tagmetry.files.board_text import parse_board
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Board
from tagmetry.twin.optics.rays import Rays
from tagmetry.twin.recipe import Recipe
from tagmetry.twin.rendering.shot import Shot
from tagmetry.twin.scenes.furniture import clutter
from tagmetry.twin.scenes.held import Held
from tagmetry.twin.scenes.light import Lamp, Light
from tagmetry.twin.scenes.path import Still, looking
from tagmetry.twin.scenes.ready.building import facing, plaster
from tagmetry.twin.scenes.ready.photographer import webcam
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.scenes.thing import board_thing

_RATE_HZ = 1.0
_FACING = Rotation.from_euler("x", 180, degrees=True)
_MARGIN_PX = 12
_TRIES = 2000
_HEIGHT_M = 1.2


def board_sweep(
    board: str = "chessboard:9x6:25mm",
    images: int = 35,
    most_tilt_deg: float = 40.0,
    seed: int = 0,
) -> Recipe:
    """A board is held up in front of a webcam, near and far, tilted, in every part of the image.

    Args:
        board: As `chessboard:9x6:25mm`.
        images: How many ways it is held, one in a second.
        most_tilt_deg: Of the board against the image.
        seed: Of the poses, of what stands behind, and of the noise.
    """
    rng = np.random.default_rng(seed)
    held = parse_board(board)
    T_world_camera = looking(np.array([0.0, 0.0, _HEIGHT_M]), np.array([0.0, 1.0, _HEIGHT_M]))
    shot = webcam(Still(T_world_camera))
    poses = [_pose(held, shot, np.radians(most_tilt_deg), rng) for _ in range(images)]
    path = Held(T_world_camera * RigidTransform.concatenate(poses), _RATE_HZ)
    behind_m = 2.5 + 4 * max(held.width_m, held.height_m)
    wall = facing((0.0, behind_m, _HEIGHT_M), (0.0, -1.0, 0.0))
    scattered = facing((0.0, behind_m - 0.4, _HEIGHT_M), (0.0, -1.0, 0.0))
    things = (
        plaster("wall", (2 * behind_m, 1.5 * behind_m), wall, rng, 0.45),
        clutter("clutter", 12, (behind_m, 0.7 * behind_m, 0.3), 0.3, rng, Still(scattered)),
        board_thing(held, path),
    )
    light = Light(0.75, (Lamp(np.array([-0.8, -0.3, 2.2]), 0.5),))
    return Recipe(Scene(things, light), shot, images, _RATE_HZ, seed)


def _pose(
    held: Board, shot: Shot, most_tilt_rad: float, rng: np.random.Generator
) -> RigidTransform:
    """Return T_camera_board of one way to hold a board so that all of it is in the picture."""
    for _ in range(_TRIES):
        T_camera_board = _tried(held, shot, most_tilt_rad, rng)
        if _fits(T_camera_board.apply(_rim_m(held)), shot):
            return T_camera_board
    raise InputError(
        f"a board tilted by up to {np.degrees(most_tilt_rad):g} degrees does not fit the picture"
    )


def _tried(
    held: Board, shot: Shot, most_tilt_rad: float, rng: np.random.Generator
) -> RigidTransform:
    """Return a random pose: any tilt, any part of the image, a third to all of it."""
    camera = shot.camera
    share = rng.uniform(0.35, 0.9)
    depth_m = max(
        held.width_m * camera.focal_px[0] / (share * camera.width_px),
        held.height_m * camera.focal_px[1] / (share * camera.height_px),
    )
    u, v = rng.uniform(0.1, 0.9, 2) * camera.size_px
    place = Rays(camera).look(np.array([u]), np.array([v]))[0] * depth_m
    way = rng.uniform(0, 2 * np.pi)
    tilt = rng.uniform(0.1, 1.0) * most_tilt_rad * np.array([np.cos(way), np.sin(way), 0.0])
    roll = Rotation.from_euler("z", rng.normal(0, 15), degrees=True)
    return RigidTransform.from_components(place, Rotation.from_rotvec(tilt) * roll * _FACING)


def _fits(p_camera: Array, shot: Shot) -> bool:
    pixels = Rays(shot.camera).see(p_camera)
    low, high = _MARGIN_PX, np.array(shot.camera.size_px) - _MARGIN_PX
    return bool(((pixels > low) & (pixels < high)).all())


def _rim_m(held: Board) -> Array:
    """Return the corners of a board's pattern, shape (4, 3)."""
    signs = np.array([[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]]) / 2
    flat = signs * [held.width_m, held.height_m]
    return np.column_stack([flat, np.zeros(4)])

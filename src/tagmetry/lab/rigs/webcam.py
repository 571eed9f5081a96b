"""The webcam, the chessboard and the 35 views of seed 003.

The camera that the paper found (its tables 3 and 4) is here the true one. Its distortion folds
back in the outermost corners, 0.8 % of the picture, where nothing is shown; boards and markers stay
clear. The 10x7 squares fill the paper of 210 x 290 mm when they have 29 mm. Three of the 35 poses
are printed (tables 5 and 6: rotation vector, and translation of the first corner in squares, with
the board's y down as OpenCV's tutorial has it); the other 32 are spread over places and tilts.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera import BrownLens, Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Chessboard
from tagmetry.twin import Optics, Scene, Shot, photograph
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.scenes import Still, Thing, board_thing

CAMERA = Camera(
    640,
    480,
    (698.5167477, 698.0543131),
    (322.7119836, 236.2582937),
    BrownLens(
        (
            -0.11785701583978955,
            1.5199508775591315,
            -0.016984594698011175,
            -0.0014976151455554812,
            -5.275252972815059,
        )
    ),
)
BOARD = Chessboard(9, 6, 0.029)
VIEWS = 35
PRINTED = {
    0: (
        (0.11857564984538077, -0.01741652085423842, 0.011824271435988583),
        (-6.145302070997344, -5.739821204416082, 28.84203665605388),
    ),
    1: (
        (0.11920255053169126, -0.01810630272594103, 0.011752351712174236),
        (-8.011859774771649, -2.7335036717816075, 30.459382441788545),
    ),
    34: (
        (-0.5300666165992208, -0.016183223270571596, -0.04777238388228286),
        (-5.37787608030147, -4.472781953410902, 32.6486636145591),
    ),
}
"""By view: rotation vector and translation of tables 5 and 6, in the tutorial's frame."""

_OPTICS = Optics(blur_px=0.6)
_SENSOR = Sensor(noise_grey=2.0)
_HERE = Still(RigidTransform.identity())
_BEHIND = Rotation.from_euler("x", 180, degrees=True)  # the tutorial's board has y down, z behind
_TILTS_DEG = (-40.0, -25.0, 25.0, 40.0)
_HALF_VIEW = np.array([0.5 * CAMERA.width_px, 0.5 * CAMERA.height_px]) / CAMERA.focal_px
_MARGIN_PX = 8.0
_PLACES = np.array([(x, y) for y in (-1, 0, 1) for x in (-1, 0, 1)])


@dataclass(frozen=True, eq=False)
class TutorialPose:
    """A board's pose as OpenCV's tutorial prints it.

    Attributes:
        rotation_rad: Rotation vector, shape (3,).
        translation_squares: Of the first corner, in squares, shape (3,).
    """

    rotation_rad: Array
    translation_squares: Array


def board_poses() -> tuple[RigidTransform, ...]:
    """Return T_camera_board of the 35 views: the three printed ones at their numbers."""
    others = iter(_spread(VIEWS - len(PRINTED)))
    return tuple(
        from_tutorial(*PRINTED[view]) if view in PRINTED else next(others) for view in range(VIEWS)
    )


def from_tutorial(
    rotation_rad: tuple[float, ...], translation_squares: tuple[float, ...]
) -> RigidTransform:
    """Return T_camera_board of a pose that the paper prints."""
    R_camera_tutorial = Rotation.from_rotvec(rotation_rad)
    first_corner = np.array(translation_squares) * BOARD.square_m
    R_camera_board = R_camera_tutorial * _BEHIND
    return RigidTransform.from_components(
        first_corner - R_camera_board.apply(BOARD.corners_m[0]), R_camera_board
    )


def to_tutorial(T_camera_board: RigidTransform) -> TutorialPose:
    """Return a pose as the paper prints it."""
    first_corner = T_camera_board.apply(BOARD.corners_m[0])
    return TutorialPose(
        (T_camera_board.rotation * _BEHIND).as_rotvec(), first_corner / BOARD.square_m
    )


def board_picture(T_camera_board: RigidTransform, rng: np.random.Generator) -> AnyPixels:
    """Return the webcam's picture of the board."""
    return picture(board_thing(BOARD, Still(T_camera_board), margin_m=0.5 * BOARD.square_m), rng)


def picture(thing: Thing, rng: np.random.Generator) -> AnyPixels:
    """Return the webcam's picture of a thing whose path is in the camera's frame."""
    shot = Shot(CAMERA, _HERE, optics=_OPTICS, sensor=_SENSOR)
    return photograph(Scene((thing,)), shot, rng)


def _spread(count: int) -> list[RigidTransform]:
    """Return poses over the picture's nine places, near and far, tilted to all sides."""
    return [
        _placed(
            _facing(_TILTS_DEG[n % 4], 47.0 * n, 13.0 * n % 60 - 30),
            _PLACES[(5 * n) % 9],
            (0.42, 0.5, 0.65)[n % 3],
        )
        for n in range(count)
    ]


def _placed(R_camera_board: Rotation, toward: Array, depth_m: float) -> RigidTransform:
    """Return the pose as far toward a side as the whole board is seen; farther off if need be."""
    while True:
        for share in np.linspace(1.0, 0.0, 21):
            place = depth_m * np.array([*(share * toward * _HALF_VIEW), 1.0])
            T_camera_board = RigidTransform.from_components(place, R_camera_board)
            if _is_whole(T_camera_board):
                return T_camera_board
        depth_m *= 1.05


def _is_whole(T_camera_board: RigidTransform) -> bool:
    """Say whether the board with its outermost squares lies in the picture."""
    across, up = BOARD.width_m / 2, BOARD.height_m / 2
    outline = np.array([[x, y, 0.0] for x in (-across, 0.0, across) for y in (-up, 0.0, up)])
    pixels = CAMERA.project(T_camera_board.apply(outline))
    size_px = np.array([CAMERA.width_px, CAMERA.height_px])
    return bool(((pixels > _MARGIN_PX) & (pixels < size_px - 1 - _MARGIN_PX)).all())


def _facing(tilt_deg: float, axis_deg: float, roll_deg: float) -> Rotation:
    """Return R_camera_board of a board that faces the camera, turned, then tilted."""
    axis = np.radians(axis_deg)
    tilt = np.radians(tilt_deg) * np.array([np.cos(axis), np.sin(axis), 0.0])
    return Rotation.from_rotvec(tilt) * Rotation.from_euler("xz", [180, roll_deg], degrees=True)

"""The testbed of seed 001: a full HD camera over a floor, boards before it, markers below it.

The camera that the paper found (its equation 8) is here the true one, with the centre where a
sensor has it. World: z up, its origin on the floor below the camera. The camera hangs so high that
24 x 15 markers, 68 mm apart, fill its image; it hangs a little askew, as cameras do.
"""

from collections.abc import Sequence

import numpy as np

from tagmetry.arena import AuditGrid
from tagmetry.camera import BrownLens, Camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.lab.published.seed001 import seed001
from tagmetry.markers import CharucoBoard, MountedMarker
from tagmetry.twin import Optics, Scene, Shot, Shutter, photograph
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.scenes import Still, Thing, board_thing, marker_thing

FAMILY = "tag36h11"
GRID = AuditGrid(24, 15, seed001().error_map.step_m, 0.05, FAMILY)
BOARD = CharucoBoard(11, 8, 0.05, 0.037, "5x5_250")
FLOOR_SIZE_M = 0.12
FLOOR_IDS = (500, 501, 502, 503, 504)
FLOOR_PLACES = ((0.0, 0.0, 0.2), (0.62, 0.33, 1.0), (-0.6, 0.3, 2.4), (-0.63, -0.34, -2.0),
                (0.6, -0.32, -0.7))  # fmt: skip

_printed = seed001().camera
CAMERA = Camera(
    _printed.size_px[0],
    _printed.size_px[1],
    (_printed.focal_px[0], _printed.focal_px[1]),
    (951.3, 546.8),
    BrownLens(tuple(_printed.coefficients)),
)
HEIGHT_M = 1.3
_HANGING = Rotation.from_euler("xyz", [181.0, 0.7, 1.5], degrees=True)
T_WORLD_CAMERA = RigidTransform.from_components([0.01, -0.06, HEIGHT_M], _HANGING)

_OPTICS = Optics(blur_px=0.6)
_SENSOR = Sensor(noise_grey=2.0)
_TILTS_DEG = (0.0, -30.0, 30.0, -20.0, 35.0)
_DEPTHS_M = (0.55, 0.75, 1.0)
_PLACES = np.array([(x, y) for y in (-1, 0, 1) for x in (-1, 0, 1)])
_MARGIN_PX = 6.0


def photographed(
    things: Sequence[Thing],
    rng: np.random.Generator,
    time_s: float = 0.0,
    shutter: Shutter | None = None,
) -> AnyPixels:
    """Return what the camera under the ceiling sees."""
    shot = Shot(
        CAMERA,
        Still(T_WORLD_CAMERA),
        time_s,
        optics=_OPTICS,
        shutter=shutter or Shutter(),
        sensor=_SENSOR,
    )
    return photograph(Scene(tuple(things)), shot, rng)


def floor_thing() -> Thing:
    """Return the floor markers."""
    return marker_thing(
        [
            MountedMarker(FAMILY, number, FLOOR_SIZE_M, _lying(*place))
            for number, place in zip(FLOOR_IDS, FLOOR_PLACES, strict=True)
        ]
    )


def grid_thing() -> Thing:
    """Return the 360 markers, their grid's frame being the world's."""
    return marker_thing(
        [
            MountedMarker(
                FAMILY, GRID.first_id + n, GRID.size_m, RigidTransform.from_translation([*at, 0.0])
            )
            for n, at in enumerate(GRID.places_m.tolist())
        ],
        quiet_cells=1.0,
    )


def board_pictures(count: int, rng: np.random.Generator) -> list[AnyPixels]:
    """Return pictures of the board, held at places all over the image."""
    shot = Shot(CAMERA, Still(RigidTransform.identity()), optics=_OPTICS, sensor=_SENSOR)
    margin_m = 0.5 * BOARD.square_m
    things = [board_thing(BOARD, Still(_held(n, rng)), margin_m=margin_m) for n in range(count)]
    return [photograph(Scene((thing,)), shot, rng) for thing in things]


def _lying(x_m: float, y_m: float, turn_rad: float) -> RigidTransform:
    return RigidTransform.from_components([x_m, y_m, 0.0], Rotation.from_euler("z", turn_rad))


def _held(number: int, rng: np.random.Generator) -> RigidTransform:
    """Return T_camera_board: near or far, tilted, and as far to a side as it is seen whole."""
    tilt_deg = _TILTS_DEG[number % 5]
    axis = rng.uniform(0, 2 * np.pi)
    tilt = np.radians(tilt_deg) * np.array([np.cos(axis), np.sin(axis), 0.0])
    facing = Rotation.from_euler("xz", [180, rng.uniform(-20, 20)], degrees=True)
    turn = Rotation.from_rotvec(tilt) * facing
    depth_m = _DEPTHS_M[number % 3]
    while True:
        found = _whole(turn, _PLACES[(5 * number) % 9], depth_m)
        if found is not None:
            return found
        depth_m *= 1.05


def _whole(turn: Rotation, toward: np.ndarray, depth_m: float) -> RigidTransform | None:
    """Return the place farthest to a side where all of the board is seen; None where none is."""
    half_view = np.array(CAMERA.size_px) / 2 / np.array(CAMERA.focal_px)
    across, up = BOARD.width_m / 2, BOARD.height_m / 2
    outline = np.array([[x, y, 0.0] for x in (-across, 0.0, across) for y in (-up, 0.0, up)])
    size_px = np.array(CAMERA.size_px)
    for share in np.linspace(1.0, 0.0, 21):
        place = depth_m * np.array([*(share * toward * half_view), 1.0])
        T_camera_board = RigidTransform.from_components(place, turn)
        pixels = CAMERA.project(T_camera_board.apply(outline))
        if ((pixels > _MARGIN_PX) & (pixels < size_px - 1 - _MARGIN_PX)).all():
            return T_camera_board
    return None

"""A ready-made scene for demonstrations: markers on a wall and a cube in front of it.

Frames: `wall` has its origin in the middle, x right, y up, z into the room.
"""

from collections.abc import Sequence

import numpy as np

from tagmetry.camera import BrownLens, Camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, cube
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.vignetting import Vignetting
from tagmetry.twin.rendering import Optics, Shot
from tagmetry.twin.scenes import Lamp, Light, Scene, Still, marker_thing
from tagmetry.twin.scenes.furniture import box
from tagmetry.twin.scenes.ready.building import plaster

CAMERA = Camera(
    1280,
    720,
    (1100.0, 1100.0),
    (639.5, 359.5),
    BrownLens((-0.18, 0.06, 0.0, 0.0)),
    name="showcase",
    provenance="the simulated camera of the demonstration",
)
FAMILY = "tag36h11"
SIZE_M = 0.12
CUBE_IDS = (10, 11, 12, 13, 14, None)
T_camera_wall = RigidTransform.from_components(
    [0.0, 0.0, 1.15], Rotation.from_euler("xy", [200, -12], degrees=True)
)

T_wall_cube = RigidTransform.from_components(
    [0.12, -0.04, 0.2], Rotation.from_euler("xyx", [-90, 22, 28], degrees=True)
)
_CUBE_SIDE_M = 0.15
_IN_THE_WALL = RigidTransform.from_translation([0.0, 0.0, -0.001])

_ON_WALL = ((0, -0.44, 0.16, 10), (1, -0.16, 0.18, -25), (2, 0.46, 0.2, 45), (3, -0.36, -0.14, 80))


def markers() -> tuple[MountedMarker, ...]:
    """Return all markers in the frame of the wall."""
    return (*_on_wall(_ON_WALL), *_on_cube())


def scene() -> Scene:
    """Return the markers on a plastered wall and on a grey cube, under a lamp at the upper left."""
    wall = plaster("wall", (2.4, 1.6), _IN_THE_WALL, np.random.default_rng(1), brightness=0.65)
    block = box("cube", (_CUBE_SIDE_M - 1e-4,) * 3, Still(T_wall_cube), brightness=0.5)
    light = Light(0.7, (Lamp(np.array([-0.8, 0.9, 1.1]), 0.7),))
    return Scene((wall, block, marker_thing(markers())), light)


def shot() -> Shot:
    """Return how it is photographed: by a machine camera, linear, a little dark at the corners."""
    return Shot(
        CAMERA,
        Still(T_camera_wall.inv()),
        optics=Optics(0.6, vignetting=Vignetting(0.6)),
        sensor=Sensor(full_well_e=12_000, read_noise_e=12),
        brightness=0.95,
    )


def _on_wall(places: Sequence[tuple[int, float, float, float]]) -> list[MountedMarker]:
    return [
        MountedMarker(
            FAMILY,
            marker_id,
            SIZE_M,
            RigidTransform.from_components(
                [x_m, y_m, 0.0], Rotation.from_euler("z", turn_deg, degrees=True)
            ),
        )
        for marker_id, x_m, y_m, turn_deg in places
    ]


def _on_cube() -> list[MountedMarker]:
    standing = cube("cube", _CUBE_SIDE_M, SIZE_M, FAMILY, CUBE_IDS)
    return [
        MountedMarker(m.family, m.id, m.size_m, T_wall_cube * m.T_body_marker)
        for m in standing.markers
    ]

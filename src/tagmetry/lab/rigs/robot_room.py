"""Where seed 004's markers hang and where its robot stands.

World: z up, the floor at z = 0. The camera is level, at the height of the markers' middles, and is
the robot: x forward in the robot's frame, along the camera's axis. Markers are ArUco's own, 7x7
cells with the border.

Before a wall the robot looks along the world's x at markers in the plane x = 0 (figures 7, 8, 10).
In the corner of a room two markers hang on one wall and a third on the perpendicular one (figure
11, whose distances are not told: the robot is 1.3 to 2.1 m from the markers).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap, PlanarRobot
from tagmetry.markers import MountedMarker
from tagmetry.twin import Scene, Thing
from tagmetry.twin.scenes import Still, marker_thing, surface

LayoutName = Literal["one", "two", "corner"]

FAMILY = "aruco_original"
HEIGHT_M = 0.3
APART_M = 0.2  # between the middles of two markers, as figure 9 has it

_R_ROBOT_CAMERA = Rotation.from_matrix([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])
T_ROBOT_CAMERA = RigidTransform.from_components([0.0, 0.0, HEIGHT_M], _R_ROBOT_CAMERA)
ROBOT = PlanarRobot(T_ROBOT_CAMERA)

PLACES = ((0.0, 0.0, 90.0), (0.6, -0.1, 82.0), (-0.4, 0.7, 74.0), (0.0, 0.0, 90.0))
"""In the corner: x and y in metres, and the heading in degrees; the fourth is the first again."""

_IDS = (101, 222, 333)
_ON_WALLS = ((-0.3, 2.0, -90.0), (0.3, 2.0, -90.0), (1.2, 1.2, 180.0))  # x, y, where they face
_JITTER_M, _JITTER_DEG = 0.005, 0.5
_WALL = 0.5  # reflectance
_PAPER = 0.85
_PILLAR = 3.0  # as wide as so many markers


@dataclass(frozen=True)
class RobotStand:
    """What is set up.

    Attributes:
        layout: Which markers hang there.
        size_m: Their side.
        distance_m: From the robot to the wall; 0 in the corner of the room.
        place: In the corner: which of `PLACES`; -1 before a wall.
        window: How many times brighter than paper the windows beside the marker are; 0 is none.
    """

    layout: LayoutName
    size_m: float
    distance_m: float = 0.0
    place: int = -1
    window: float = 0.0


def room_map(stand: RobotStand) -> MarkerMap:
    """Return the markers at their places."""
    return MarkerMap(
        tuple(
            MapMarker(FAMILY, number, stand.size_m, _hung(*place))
            for number, place in zip(_IDS, _hangings(stand), strict=False)
        )
    )


def robot_place(stand: RobotStand, rng: np.random.Generator) -> RigidTransform:
    """Return T_world_robot, off by some millimetres, so that pixels fall elsewhere every time."""
    x_m, y_m, heading_deg = PLACES[stand.place] if stand.place >= 0 else (-stand.distance_m, 0, 0)
    off = rng.uniform(-1, 1, 3) * [_JITTER_M, _JITTER_M, _JITTER_DEG]
    turn = Rotation.from_euler("z", heading_deg + off[2], degrees=True)
    return RigidTransform.from_components([x_m + off[0], y_m + off[1], 0.0], turn)


def room_scene(stand: RobotStand) -> Scene:
    """Return what there is to see: the markers, and behind them a wall, or windows."""
    mounted = [
        MountedMarker(one.family, one.id, one.size_m, one.T_world_marker)
        for one in room_map(stand).markers
    ]
    return Scene((*_behind(stand), marker_thing(mounted)), background=_WALL)


def _behind(stand: RobotStand) -> tuple[Thing, ...]:
    """Return the windows to both sides of the pillar on which a marker hangs, beyond the view."""
    if stand.window == 0:
        return ()
    glow, wide_m = stand.window * _PAPER, 2 * stand.distance_m
    aside_m = _PILLAR * stand.size_m / 2 + wide_m / 2
    return tuple(
        surface("window", wide_m, wide_m, Still(_hung(0.01, y_m, 180.0)), brightness=0.0, glow=glow)
        for y_m in (-aside_m, aside_m)
    )


def _hangings(stand: RobotStand) -> Sequence[tuple[float, float, float]]:
    if stand.layout == "corner":
        return _ON_WALLS
    if stand.layout == "two":
        return [(0.0, APART_M / 2, 180.0), (0.0, -APART_M / 2, 180.0)]
    return [(0.0, 0.0, 180.0)]


def _hung(x_m: float, y_m: float, faces_deg: float) -> RigidTransform:
    """Return T_world_marker of an upright marker whose face points to a direction in the plane."""
    upright = Rotation.from_matrix([[0, 0, 1], [1, 0, 0], [0, 1, 0]])  # z along the world's x
    turn = Rotation.from_euler("z", faces_deg, degrees=True)
    return RigidTransform.from_components([x_m, y_m, HEIGHT_M], turn * upright)

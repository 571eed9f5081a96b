"""A room with markers on its walls."""

import numpy as np

from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin.recipe import Recipe
from tagmetry.twin.scenes.furniture import box, clutter
from tagmetry.twin.scenes.light import Lamp, Light
from tagmetry.twin.scenes.path import Still, Waypoints, looking
from tagmetry.twin.scenes.ready.building import UP, concrete, facing, hung, plaster
from tagmetry.twin.scenes.ready.photographer import webcam
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.scenes.thing import Thing, marker_thing

_HEIGHT_M = 2.6
_EYE_M = 1.45
_NORMALS = ((0.0, -1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))


def room(
    width_m: float = 5.0,
    depth_m: float = 4.0,
    per_wall: int = 3,
    family: str = "tag36h11",
    size_m: float = 0.2,
    images: int = 60,
    seed: int = 0,
) -> Recipe:
    """A camera is carried round a room with markers on all walls and furniture.

    Args:
        width_m: Of the room, along the world's x; its middle is at x = y = 0.
        depth_m: Along y.
        per_wall: Markers on each wall; ids count from 0 clockwise, from the wall at +y.
        family: Of the markers.
        size_m: Side of their black squares.
        images: How many, 30 in a second.
        seed: Of the walls, of what stands around, and of the noise.
    """
    rng = np.random.default_rng(seed)
    walls = [_wall(normal, width_m, depth_m) for normal in _NORMALS]
    things: list[Thing] = [
        concrete("floor", (width_m, depth_m), facing((0.0, 0.0, 0.0), UP), rng, 0.28),
        plaster("ceiling", (width_m, depth_m), facing((0, 0, _HEIGHT_M), (0, 0, -1)), rng, 0.75),
    ]
    for number, (T_world_wall, length_m) in enumerate(walls):
        things += _dressed(number, T_world_wall, length_m, per_wall, family, size_m, rng)
    things += _boxes(width_m, depth_m)
    lamps = (Lamp(np.array([-1.0, 0.5, 2.5]), 1.3), Lamp(np.array([1.2, -0.4, 2.5]), 1.3))
    path = _round(width_m, depth_m, images / 30)
    shot = webcam(path, brightness=0.75)
    return Recipe(Scene(tuple(things), Light(0.4, lamps)), shot, images, seed=seed)


def _wall(
    normal: tuple[float, float, float], width_m: float, depth_m: float
) -> tuple[RigidTransform, float]:
    """Return where a wall is, and its length."""
    x, y, _ = normal
    middle = (-x * width_m / 2, -y * depth_m / 2, _HEIGHT_M / 2)
    return facing(middle, normal), abs(x) * depth_m + abs(y) * width_m


def _dressed(
    number: int,
    T_world_wall: RigidTransform,
    length_m: float,
    per_wall: int,
    family: str,
    size_m: float,
    rng: np.random.Generator,
) -> list[Thing]:
    """Return a wall with its markers."""
    along_m = ((np.arange(per_wall) + 0.5) / per_wall - 0.5) * length_m
    height_m = _EYE_M - _HEIGHT_M / 2 + rng.uniform(-0.2, 0.2, per_wall)
    places = np.column_stack([along_m + rng.uniform(-0.1, 0.1, per_wall), height_m])
    ids = range(number * per_wall, (number + 1) * per_wall)
    markers = hung(family, ids, size_m, places, rng.uniform(-4, 4, per_wall))
    return [
        plaster(f"wall {number}", (length_m, _HEIGHT_M), T_world_wall, rng),
        marker_thing(markers, Still(T_world_wall), name=f"markers {number}"),
    ]


def _boxes(width_m: float, depth_m: float) -> list[Thing]:
    """Return a table, a cupboard and what lies on the table."""
    table = facing((0.25 * width_m, 0.3 * depth_m, 0.36), UP)
    papers = facing((0.25 * width_m, 0.3 * depth_m, 0.8), UP)
    rng = np.random.default_rng(0)
    return [
        box("table", (1.2, 0.7, 0.72), Still(table), brightness=0.35),
        clutter("papers", 6, (0.9, 0.5, 0.05), 0.15, rng, Still(papers)),
        box("cupboard", (0.8, 0.5, 1.1), Still(_standing(-0.38 * width_m, 0.35 * depth_m, 0.55))),
    ]


def _standing(x_m: float, y_m: float, z_m: float) -> RigidTransform:
    turn = Rotation.from_euler("z", 25, degrees=True)
    return RigidTransform.from_components([x_m, y_m, z_m], turn)


def _round(width_m: float, depth_m: float, duration_s: float) -> Waypoints:
    """Return a walk through the room's middle that looks at three walls in turn."""
    at = np.array([[-0.15, -0.4, 1.5], [0.12, -0.3, 1.45], [0.0, -0.1, 1.6]])
    to = np.array([[0.05, 0.5, 1.3], [0.35, 0.45, 1.3], [-0.5, 0.3, 1.35]])
    scale = np.array([width_m, depth_m, 1.0])
    poses = [looking(a, b) for a, b in zip(at * scale, to * scale, strict=True)]
    times_s = np.linspace(0.0, max(duration_s, 1.0), len(poses))
    return Waypoints(times_s, RigidTransform.concatenate(poses))

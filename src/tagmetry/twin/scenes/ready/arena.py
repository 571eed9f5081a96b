"""Robots on a floor under a ceiling camera."""

from dataclasses import replace

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker
from tagmetry.markers import family as family_of
from tagmetry.twin.recipe import Recipe
from tagmetry.twin.scenes.furniture import box
from tagmetry.twin.scenes.light import Lamp, Light
from tagmetry.twin.scenes.path import Path, Still, looking
from tagmetry.twin.scenes.ready.building import UP, concrete, facing, hung
from tagmetry.twin.scenes.ready.circling import Circling
from tagmetry.twin.scenes.ready.photographer import machine_camera
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.scenes.thing import Thing, marker_sheet, marker_thing

_SIZE_M = (3.4, 1.9)  # of the floor that the camera sees
_BODY_M = 0.09  # height of a robot
_FIELD_OF_VIEW_DEG = 70.0
_CORNER_SIZE_M = 0.15


def arena(
    robots: int = 12,
    family: str = "4x4_50",
    size_m: float = 0.11,
    height_m: float = 2.6,
    speed_m_s: float = 0.25,
    images: int = 30,
    seed: int = 0,
) -> Recipe:
    """Robots with markers on their roofs drive in circles under a ceiling camera.

    The four markers at the arena's corners are the last ids of the family, and stand still.

    Args:
        robots: How many.
        family: Of all markers; the robots' ids count from 0.
        size_m: Side of the robots' black squares.
        height_m: Of the camera.
        speed_m_s: Of the robots, on average.
        images: How many, 30 in a second.
        seed: Of the floor, of the robots' ways, and of the noise.
    """
    known = len(family_of(family)) - 4
    if not 1 <= robots <= known:
        raise InputError(f"expected 1 to {known} robots with markers of {family}, found {robots}")
    rng = np.random.default_rng(seed)
    places, cell_m = _places(robots)
    ways = (_way(place, cell_m, size_m, speed_m_s, rng) for place in places)
    ground = facing((0.0, 0.0, 0.0), UP)
    things = (
        concrete("floor", (5.2, 3.4), ground, rng, brightness=0.35),
        marker_thing(_corners(family), Still(ground), name="corners"),
        *(_robot(number, family, size_m, way) for number, way in enumerate(ways)),
    )
    above = _hung(height_m)
    light = Light(
        0.6, (Lamp(np.array([-1.2, 0.6, 3.5]), 3.0), Lamp(np.array([1.3, -0.5, 3.5]), 3.0))
    )
    shot = machine_camera(Still(above), _FIELD_OF_VIEW_DEG)
    return Recipe(Scene(things, light), shot, images, seed=seed)


def _hung(height_m: float) -> RigidTransform:
    """Return T_world_camera of a camera that was hung not quite straight; x is to the right."""
    down = looking(np.array([0.05, -0.04, height_m]), np.array([0.05, -0.04, 0.0]))
    return down * RigidTransform.from_rotation(Rotation.from_rotvec([0.012, 0.018, -0.01]))


def _places(robots: int) -> tuple[Array, float]:
    """Return a place for each robot, shape (n, 2), and how wide the space round it is."""
    columns = int(np.ceil(np.sqrt(robots * _SIZE_M[0] / _SIZE_M[1])))
    rows = int(np.ceil(robots / columns))
    number = np.arange(robots)
    across = ((number % columns + 0.5) / columns - 0.5) * (_SIZE_M[0] - 0.5)
    up = ((number // columns + 0.5) / rows - 0.5) * (_SIZE_M[1] - 0.1)
    cell_m = min((_SIZE_M[0] - 0.5) / columns, (_SIZE_M[1] - 0.1) / rows)
    return np.column_stack([across, up]), cell_m


def _way(
    place_m: Array, cell_m: float, size_m: float, speed_m_s: float, rng: np.random.Generator
) -> Circling:
    """Return a circle that stays in a robot's own space."""
    radius_m = max(cell_m / 2 - 0.9 * size_m, 0.02) * float(rng.uniform(0.7, 1.0))
    turn_rad_s = float(rng.choice([-1, 1]) * rng.uniform(0.7, 1.3)) * speed_m_s / radius_m
    center_m = (float(place_m[0]), float(place_m[1]), 0.0)
    return Circling(center_m, radius_m, turn_rad_s, float(rng.uniform(0, 2 * np.pi)))


def _robot(number: int, family: str, size_m: float, way: Path) -> Thing:
    """Return a box on the floor with a marker on its roof; the marker's x is ahead."""
    body = box("body", (1.5 * size_m, 1.5 * size_m, _BODY_M), brightness=0.12)
    T_robot_body = RigidTransform.from_translation([0.0, 0.0, _BODY_M / 2])
    sides = [replace(s, T_thing_sheet=T_robot_body * s.T_thing_sheet) for s in body.sheets]
    T_robot_marker = RigidTransform.from_translation([0.0, 0.0, _BODY_M])
    marker = MountedMarker(family_of(family).name, number, size_m, T_robot_marker)
    return Thing(f"robot {number}", (*sides, marker_sheet(marker)), (marker,), path=way)


def _corners(family: str) -> tuple[MountedMarker, ...]:
    half = np.array(_SIZE_M) / 2 - _CORNER_SIZE_M / 2
    places = half * np.array([[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]])
    last = len(family_of(family))
    return hung(family, range(last - 4, last), _CORNER_SIZE_M, places, np.zeros(4))

"""Markers on a wall."""

import numpy as np

from tagmetry.twin.recipe import Recipe
from tagmetry.twin.scenes.light import Lamp, Light
from tagmetry.twin.scenes.path import Steady, Still, looking
from tagmetry.twin.scenes.ready.building import facing, hung, plaster
from tagmetry.twin.scenes.ready.photographer import webcam
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.scenes.thing import marker_thing

_HEIGHT_M = 1.3
_AWAY = (0.0, -1.0, 0.0)  # from the wall, y = 0, into the room


def wall(
    columns: int = 4,
    rows: int = 2,
    family: str = "tag36h11",
    size_m: float = 0.16,
    distance_m: float = 1.8,
    srgb: bool = False,
    images: int = 1,
    seed: int = 0,
) -> Recipe:
    """Markers on paper on a painted wall, seen by a webcam that passes slowly.

    Args:
        columns: Of markers.
        rows: Of markers.
        family: Of the markers; ids count from 0, row by row.
        size_m: Side of their black squares.
        distance_m: From the wall to the camera.
        srgb: Whether the grey values are made for a display, which moves blurred edges; else they
            are linear in the light.
        images: How many, 30 in a second.
        seed: Of the wall, of how the papers hang, and of the noise.
    """
    rng = np.random.default_rng(seed)
    column, row = np.meshgrid(np.arange(columns), np.arange(rows))
    pitch_m = 2.2 * size_m
    places = pitch_m * np.column_stack(
        [column.ravel() - (columns - 1) / 2, (rows - 1) / 2 - row.ravel()]
    )
    places += rng.uniform(-0.15, 0.15, places.shape) * size_m
    turns_deg = rng.uniform(-6, 6, len(places))
    markers = hung(family, range(len(places)), size_m, places, turns_deg)
    T_world_wall = facing((0.0, 0.0, _HEIGHT_M), _AWAY)
    things = (
        plaster("wall", (6.0, 3.5), facing((0.0, 0.0, 1.75), _AWAY), rng),
        marker_thing(markers, Still(T_world_wall)),
    )
    start = looking(
        np.array([0.28, -1.0, 0.1]) * distance_m + [0, 0, _HEIGHT_M], np.array([0, 0, _HEIGHT_M])
    )
    path = Steady(start, np.array([-0.05, 0.0, 0.0]), np.zeros(3))
    light = Light(0.75, (Lamp(np.array([-1.5, -1.6, 2.6]), 1.2),))
    return Recipe(Scene(things, light), webcam(path, srgb=srgb), images, seed=seed)

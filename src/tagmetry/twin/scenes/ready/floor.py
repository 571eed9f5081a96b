"""Markers on a floor."""

import numpy as np

from tagmetry.twin.recipe import Recipe
from tagmetry.twin.scenes.light import Lamp, Light
from tagmetry.twin.scenes.path import Steady, Still, looking
from tagmetry.twin.scenes.ready.building import UP, concrete, facing, hung
from tagmetry.twin.scenes.ready.photographer import webcam
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.scenes.thing import marker_thing


def floor(
    columns: int = 4,
    rows: int = 4,
    family: str = "tag36h11",
    size_m: float = 0.16,
    pitch_m: float = 0.5,
    height_m: float = 1.5,
    images: int = 1,
    seed: int = 0,
) -> Recipe:
    """Markers in a grid on a concrete floor, seen at a slant by a camera that moves ahead.

    Args:
        columns: Of markers, along the world's x.
        rows: Of markers, along y.
        family: Of the markers; ids count from 0, row by row.
        size_m: Side of their black squares.
        pitch_m: From one marker to the next.
        height_m: Of the camera.
        images: How many, 30 in a second.
        seed: Of the floor and of the noise.
    """
    rng = np.random.default_rng(seed)
    column, row = np.meshgrid(np.arange(columns), np.arange(rows))
    places = pitch_m * np.column_stack(
        [column.ravel() - (columns - 1) / 2, (rows - 1) / 2 - row.ravel()]
    )
    markers = hung(family, range(len(places)), size_m, places, np.zeros(len(places)))
    ground = facing((0.0, 0.0, 0.0), UP)
    things = (
        concrete("floor", (9.0, 9.0), ground, rng),
        marker_thing(markers, Still(ground)),
    )
    depth_m = rows * pitch_m
    start = looking(np.array([0.1, -0.95 * depth_m, height_m]), np.array([0.0, -0.06 * depth_m, 0]))
    path = Steady(start, np.array([0.0, 0.3, 0.0]), np.zeros(3))
    light = Light(0.8, (Lamp(np.array([0.8, 1.2, 2.7]), 1.8),))
    return Recipe(Scene(things, light), webcam(path), images, seed=seed)

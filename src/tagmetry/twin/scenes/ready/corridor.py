"""A corridor with markers on its walls."""

import numpy as np

from tagmetry.twin.recipe import Recipe
from tagmetry.twin.scenes.furniture import box
from tagmetry.twin.scenes.light import Lamp, Light
from tagmetry.twin.scenes.path import Steady, Still, looking
from tagmetry.twin.scenes.ready.building import UP, concrete, facing, hung, plaster
from tagmetry.twin.scenes.ready.photographer import webcam
from tagmetry.twin.scenes.scene import Scene
from tagmetry.twin.scenes.thing import Thing, marker_thing, surface

_WIDTH_M, _HEIGHT_M = 2.2, 2.5
_CAMERA_M = 1.1
_EYE_M = 1.4  # height of the markers


def corridor(
    length_m: float = 12.0,
    family: str = "tag36h11",
    size_m: float = 0.16,
    step_m: float = 1.5,
    speed_m_s: float = 0.8,
    images: int = 60,
    seed: int = 0,
) -> Recipe:
    """A robot's camera drives along a corridor with markers on both walls and at its end.

    Args:
        length_m: Of the corridor, along the world's y.
        family: Of the markers; ids count from 0, the right wall after the left, the end last.
        size_m: Side of their black squares.
        step_m: From one marker on a wall to the next.
        speed_m_s: Of the camera.
        images: How many, 30 in a second.
        seed: Of the walls and of the noise.
    """
    rng = np.random.default_rng(seed)
    count = max(int((length_m - 1) / step_m), 1)
    along_m = (np.arange(count) - (count - 1) / 2) * step_m
    places = np.column_stack([along_m, np.full(count, _EYE_M - _HEIGHT_M / 2)])
    straight = np.zeros(count)
    left, right, end = _walls(length_m)
    things = (
        *_shell(length_m, rng),
        marker_thing(hung(family, range(count), size_m, places, straight), left, name="left"),
        marker_thing(
            hung(family, range(count, 2 * count), size_m, -places * [1, -1], straight),
            right,
            name="right",
        ),
        marker_thing(hung(family, [2 * count], size_m, places[:1] * [0, 1], straight[:1]), end),
    )
    start = looking(np.array([-0.15, 0.4, _CAMERA_M]), np.array([0.1, length_m, 1.25]))
    path = Steady(start, np.array([0.0, speed_m_s, 0.0]), np.zeros(3))
    lamps = tuple(Lamp(np.array([0.0, share * length_m, 2.4]), 1.5) for share in (0.15, 0.5, 0.85))
    shot = webcam(path)
    return Recipe(Scene(things, Light(0.35, lamps)), shot, images, seed=seed)


def _walls(length_m: float) -> tuple[Still, Still, Still]:
    """Return where the left, the right and the far wall are."""
    half_m, middle_m = _WIDTH_M / 2, length_m / 2
    return (
        Still(facing((-half_m, middle_m, _HEIGHT_M / 2), (1.0, 0.0, 0.0))),
        Still(facing((half_m, middle_m, _HEIGHT_M / 2), (-1.0, 0.0, 0.0))),
        Still(facing((0.0, length_m, _HEIGHT_M / 2), (0.0, -1.0, 0.0))),
    )


def _shell(length_m: float, rng: np.random.Generator) -> list[Thing]:
    """Return the floor, the ceiling and the walls, with a few things that stand in the way."""
    left, right, end = (one.T_world_thing for one in _walls(length_m))
    middle_m = length_m / 2
    side_m = (length_m, _HEIGHT_M)
    ceiling = facing((0.0, middle_m, _HEIGHT_M), (0.0, 0.0, -1.0))
    return [
        concrete("floor", (_WIDTH_M, length_m), facing((0.0, middle_m, 0.0), UP), rng, 0.3),
        plaster("ceiling", (_WIDTH_M, length_m), ceiling, rng, 0.75),
        plaster("left wall", side_m, left, rng),
        plaster("right wall", side_m, right, rng),
        plaster("end wall", (_WIDTH_M, _HEIGHT_M), end, rng, 0.5),
        *_doors(length_m),
        box("crate", (0.4, 0.5, 0.6), Still(facing((0.85, 0.45 * length_m, 0.3), UP))),
    ]


def _doors(length_m: float) -> list[Thing]:
    """Return doors, a hair in front of the walls, so that they are painted over them."""
    half_m = _WIDTH_M / 2 - 1e-3
    left = facing((-half_m, 0.3 * length_m, 1.0), (1.0, 0.0, 0.0))
    right = facing((half_m, 0.7 * length_m, 1.0), (-1.0, 0.0, 0.0))
    return [
        surface("left door", 0.9, 2.0, Still(left), brightness=0.22),
        surface("right door", 0.9, 2.0, Still(right), brightness=0.28),
    ]

"""Robots that wander among virtual obstacles, within virtual walls."""

from itertools import count, pairwise

import numpy as np

from tagmetry.arena import Disc, Obstacle, Wall
from tagmetry.arena.controllers import Controller, Shielded, Wander
from tagmetry.arena.place import Place
from tagmetry.pipeline.arena_twin.ready.stage import FLOOR_HALF_M, robot, scattered
from tagmetry.pipeline.arena_twin.scenario import TwinRobot

_X_M, _Y_M = FLOOR_HALF_M
_CORNERS_M = ((-_X_M, -_Y_M), (_X_M, -_Y_M), (_X_M, _Y_M), (-_X_M, _Y_M), (-_X_M, -_Y_M))
_RIM = tuple(Wall(start, end, "rim") for start, end in pairwise(_CORNERS_M))
OBSTACLES: tuple[Obstacle, ...] = (
    *_RIM,
    Disc((-0.75, 0.2), 0.16, "pond"),
    Disc((0.8, -0.3), 0.2, "hill"),
    Wall((0.15, 0.85), (0.15, 0.2), "hedge"),
)
_CLEAR_M = 0.15  # from a robot's centre to the nearest obstacle when it starts


def wander(robots: int, rng: np.random.Generator) -> tuple[TwinRobot, ...]:
    """Robots all over the floor wander."""
    return tuple(
        TwinRobot(robot(n), place, _wanderer) for n, place in enumerate(_clear(robots, rng))
    )


def _clear(robots: int, rng: np.random.Generator) -> list[Place]:
    """Return places that no obstacle is near to."""
    tries = (scattered(many, rng) for many in count(robots))
    found = ([place for place in places if _is_clear(place)] for places in tries)
    return next(places[:robots] for places in found if len(places) >= robots)


def _is_clear(place: Place) -> bool:
    away_m = [np.hypot(*(one.nearest_point(place.xy_m) - place.xy_m)) for one in OBSTACLES]
    return bool(min(away_m) > _CLEAR_M)


def _wanderer() -> Controller:
    return Shielded(Wander())

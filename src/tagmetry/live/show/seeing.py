"""With what eye the live arena looks down: at corners alone, or at pictures as a real camera does.

Pictures of the full size, with noise and blur, go through the real detector and tracker. That takes
a computer some tens of milliseconds, so there are only as many images a second as it affords.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np

from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.live.show.eye import WatchedEye
from tagmetry.live.show.painter import Paint, measured, painting
from tagmetry.pipeline.arena_twin import CornerEye, Eye, PictureEye, Scenario
from tagmetry.pipeline.arena_twin.ready.stage import floor, shot

EyeKind = Literal["corners", "pictures"]

_SHARE = 0.5  # of a processor, for looking
_LEAST_HZ = 2.0
_TRIES, _STEP_S = 5, 0.1  # the first compiles


@dataclass(frozen=True, eq=False)
class Seeing:
    """An eye, ready.

    Attributes:
        eye: Who looks.
        prepare: Returns what makes a picture of a look, for people.
        image_rate_hz: How often it looks.
    """

    eye: WatchedEye
    prepare: Callable[[], Paint]
    image_rate_hz: float


def seeing(kind: EyeKind, scenario: Scenario) -> Seeing:
    """Return an eye for a scenario.

    Args:
        kind: Of what it looks at.
        scenario: Whose robots it sees; its image rate is the most.
    """
    robots, rng = [one.robot for one in scenario.robots], np.random.default_rng(scenario.seed)
    if kind == "corners":
        corners = CornerEye(robots, scenario.view, rng)
        return Seeing(WatchedEye(corners), partial(painting, robots), scenario.image_rate_hz)
    eye = PictureEye(robots, floor(scenario.seed), shot(), rng)
    rate_hz = min(scenario.image_rate_hz, max(_SHARE / _cost_s(eye, scenario), _LEAST_HZ))
    return Seeing(WatchedEye(eye, lambda: eye.pixels), lambda: measured, rate_hz)


def _cost_s(eye: Eye, scenario: Scenario) -> float:
    """Return how long a look takes where nothing else runs: the quickest of some."""
    places = [one.start for one in scenario.robots]
    Ts_world_robot = RigidTransform.from_components(
        [(place.x_m, place.y_m, 0.0) for place in places],
        Rotation.from_euler("z", [[place.heading_rad] for place in places]),
    )
    before_s = [_STEP_S * (n - _TRIES) for n in range(_TRIES)]  # the arena begins at 0
    return min(_timed_s(eye, time_s, Ts_world_robot) for time_s in before_s)


def _timed_s(eye: Eye, time_s: float, Ts_world_robot: RigidTransform) -> float:
    began_s = time.monotonic()
    eye.look(time_s, Ts_world_robot)
    return time.monotonic() - began_s

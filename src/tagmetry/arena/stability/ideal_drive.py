"""A drive of the real controller behind a perfect leader, on wheels that only lag.

Straight lines and turns, start and stop, in the plane, without slip and noise: what the
linear loops leave out.
"""

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil, exp

import numpy as np

from tagmetry.arena.controllers import Course, SpringFollower, View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.neighbours import Neighbour
from tagmetry.arena.own_motion import OwnMotion
from tagmetry.arena.place import Place
from tagmetry.arena.stability.setting import FollowingSetting
from tagmetry.arena.stability.wheels import Lateness
from tagmetry.geometry import Array

_LEADER, _FOLLOWER = 0, 1
_STEP_S = 0.005
_SETTLE_S = 2.0


def ideal_gaps_m(setting: FollowingSetting, course: Course) -> Array:
    """Return the distances between leader and follower, centre to centre, one for each image."""
    end_s = course.end_s + _SETTLE_S
    robot = _Robot(setting, course.start.moved(-setting.spring.length_m, 0.0))
    mind = _Mind(setting)
    late = Lateness.of(setting.delay_s + setting.untold_s, setting.image_s)
    sent = deque([STILL] * (late.whole + 2), maxlen=late.whole + 2)
    gaps_m = []
    for n in range(int(end_s / setting.image_s)):
        leader = course.at(n * setting.image_s).place
        gaps_m.append(leader.distance_m(robot.place))
        sent.append(mind.command(n * setting.image_s, robot.place, leader))
        robot.drive(sent[0], late.rest_s)
        robot.drive(sent[1], late.image_s - late.rest_s)
    return np.array(gaps_m)


@dataclass
class _Robot:
    """A robot on two wheels that lag.

    Attributes:
        setting: How much.
        place: Where it is.
        twist: How it moves.
    """

    setting: FollowingSetting
    place: Place
    twist: Twist = STILL

    def drive(self, wanted: Twist, duration_s: float) -> None:
        """Let it follow a command for a while."""
        for step_s in _steps(duration_s):
            left = exp(-step_s / self.setting.motor_s)
            lagging_s = self.setting.motor_s * (1 - left)
            old = self.twist
            self.place = self.place.moved(
                wanted.speed_mps * step_s + (old.speed_mps - wanted.speed_mps) * lagging_s,
                wanted.turn_rate_radps * step_s
                + (old.turn_rate_radps - wanted.turn_rate_radps) * lagging_s,
            )
            self.twist = Twist(
                wanted.speed_mps + left * (old.speed_mps - wanted.speed_mps),
                wanted.turn_rate_radps + left * (old.turn_rate_radps - wanted.turn_rate_radps),
            )


class _Mind:
    """The follower's controller, asked once an image."""

    def __init__(self, setting: FollowingSetting) -> None:
        self._delay_s = setting.delay_s
        self._controller = SpringFollower(_LEADER, setting.spring)
        self._own = OwnMotion(setting.told_motor_s)

    def command(self, image_s: float, place: Place, leader: Place) -> Twist:
        """Return what an image leads to."""
        acts_s = image_s + self._delay_s
        seen = leader.seen_from(place)
        neighbour = Neighbour(
            _LEADER, leader.distance_m(place), seen.bearing_rad, seen.heading_rad, self._delay_s
        )
        twist = self._controller(
            View(_FOLLOWER, acts_s, self._own.at(acts_s), (neighbour,), sensed_s=image_s)
        )
        self._own.command(twist, acts_s)
        return twist


def _steps(duration_s: float) -> Iterator[float]:
    count = ceil(duration_s / _STEP_S - 1e-9)
    return iter([duration_s / count] * count if count else [])

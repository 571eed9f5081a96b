"""A drive of the real controller behind a perfect leader, on wheels that know no slip.

Straight lines and turns, start and stop, in the plane, without noise: what the linear loops
leave out.
"""

from collections import deque
from math import ceil

import numpy as np

from tagmetry.arena.controllers import Course, SpringFollower, View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.own_motion import OwnMotion
from tagmetry.arena.place import Place
from tagmetry.arena.stability.setting import FollowingSetting
from tagmetry.arena.stability.wheels import Held, Lateness, Wheels
from tagmetry.arena.told import Neighbour
from tagmetry.geometry import Array

_LEADER, _FOLLOWER = 0, 1
_STEP_S = 0.005
_SETTLE_S = 2.0


def ideal_gaps_m(setting: FollowingSetting, course: Course) -> Array:
    """Return the distances between leader and follower, centre to centre, one for each image."""
    end_s = course.end_s + _SETTLE_S
    late = Lateness.of(setting.delay_s + setting.untold_s, setting.image_s)
    robot = _Robot(setting, course.start.moved(-setting.spring.length_m, 0.0))
    before, after = (robot.part(part_s) for part_s in (late.rest_s, late.image_s - late.rest_s))
    mind = _Mind(setting)
    sent = deque([STILL] * (late.whole + 2), maxlen=late.whole + 2)
    gaps_m = []
    for n in range(int(end_s / setting.image_s)):
        leader = course.at(n * setting.image_s).place
        gaps_m.append(leader.distance_m(robot.place))
        sent.append(mind.command(n * setting.image_s, robot.place, leader))
        robot.drive(sent[0], before)
        robot.drive(sent[1], after)
    return np.array(gaps_m)


class _Robot:
    """A robot on two wheels with servos.

    Attributes:
        place: Where it is.
    """

    def __init__(self, setting: FollowingSetting, place: Place) -> None:
        self.place = place
        self._wheels = Wheels.of(np.array([[0.0, 1.0]]), setting.motor_s, setting.hold_s)
        self._state = np.zeros((len(self._wheels.push), 2))  # way and turn, and their rates

    def part(self, duration_s: float) -> list[Held]:
        """Return the small steps that a time is made of."""
        count = ceil(duration_s / _STEP_S - 1e-9)
        return [self._wheels.held(duration_s / count)] * count if count else []

    def drive(self, wanted: Twist, steps: list[Held]) -> None:
        """Let it follow a command for a while."""
        command = np.array([wanted.speed_mps, wanted.turn_rate_radps])
        for step in steps:
            self._state = step.after(self._state, command)
            self.place = self.place.moved(*self._state[0].tolist())
            self._state[0] = 0.0


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

"""The follower's loop across the line to its leader, linear around going straight behind it.

Offsets y to the left and headings h are small; seen from the follower's own place when its command
acts, with v the speed and L the spring's length (`controllers.leader_follower`):

    leader       y and h by alpha, turn rate by beta, carried on by the delay
    turn rate    (v / L) h + k y / L

Own motion on an arc moves what lies X ahead by -X turn - v t turn / 2 across.
"""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.arena.stability.period import Period
from tagmetry.arena.stability.wheels import driven
from tagmetry.geometry import Array

OFFSET, HEADING = 0, 1  # of the state, and of the leader in what comes from outside


@dataclass(frozen=True, eq=False)
class _Seen:
    """Something ahead: how far, and its offset, heading and turn rate, shape (m,) each."""

    ahead_m: float
    offset: Array
    heading: Array
    turn_rate: Array

    def carried(self, speed_mps: float, time_s: float) -> "_Seen":
        """Return it later, if it goes on as it does."""
        way_m = speed_mps * time_s
        return _Seen(
            self.ahead_m + way_m,
            self.offset + way_m * (self.heading + self.turn_rate * time_s / 2),
            self.heading + self.turn_rate * time_s,
            self.turn_rate,
        )

    def passed(self, way_m: float, turn: Array) -> "_Seen":
        """Return it as seen from further on along an own arc."""
        ahead_m = self.ahead_m - way_m
        offset = self.offset - (ahead_m + way_m / 2) * turn
        return replace(self, ahead_m=ahead_m, offset=offset, heading=self.heading - turn)


@dataclass(frozen=True)
class Across(Period):
    """One image period.

    The state is the robot's (offset, heading, turn rate), commands sent, own turn rates, the last
    command, and the leader's offset, heading and turn rate.
    """

    def __call__(self, state: Array, command: Array, outside: Array) -> tuple[Array, Array]:
        """Return the next state, and the controller's command."""
        robot, sent, turns, (last, *known) = np.split(state, self._ends)
        turns = self._own(turns, last)
        seen = self._sighting(robot, outside, turns)
        leader = self._leader(known, turns[0], seen)
        now = leader.carried(self.setting.speed_mps, self.setting.delay_s)
        wish = self._turned(now)
        robot, sent = driven(self._wheels, robot, sent, command, self._acting)
        known = [leader.offset, leader.heading, leader.turn_rate]
        return np.concatenate([robot, sent, turns, [wish, *known]]), wish

    @property
    def _known(self) -> int:
        return 4

    @property
    def _moved(self) -> Array:
        return np.array([[0.0, self.setting.speed_mps, 0.0], [0.0, 0.0, 1.0]])

    def _sighting(self, robot: Array, leader: Array, turns: Array) -> _Seen:
        """Return the leader as the image has it, seen from where the command acts."""
        late, speed, length_m = self._told, self.setting.speed_mps, self.setting.spring.length_m
        offset = leader[OFFSET] - robot[OFFSET] - length_m * robot[HEADING]
        seen = _Seen(length_m, offset, leader[HEADING] - robot[HEADING], 0 * offset)
        seen = seen.passed(speed * late.rest_s, late.rest_s * turns[late.whole])
        for turn in turns[: late.whole][::-1]:
            seen = seen.passed(speed * late.image_s, late.image_s * turn)
        return seen

    def _leader(self, known: list[Array], own: Array, seen: _Seen) -> _Seen:
        """Return what is known of the leader as of this image."""
        setting = self.setting
        way_m = setting.speed_mps * setting.image_s
        last = _Seen(seen.ahead_m, *known).carried(setting.speed_mps, setting.image_s)
        expected = last.passed(way_m, setting.image_s * own)
        offset, heading = seen.offset - expected.offset, seen.heading - expected.heading
        return _Seen(
            seen.ahead_m,
            expected.offset + setting.place_share * offset,
            expected.heading + setting.place_share * heading,
            expected.turn_rate + setting.motion_share * heading / setting.image_s,
        )

    def _turned(self, now: _Seen) -> Array:
        setting, spring = self.setting, self.setting.spring
        facing = spring.turn_per_s * now.offset / spring.length_m
        return np.asarray(setting.speed_mps / spring.length_m * now.heading + facing)

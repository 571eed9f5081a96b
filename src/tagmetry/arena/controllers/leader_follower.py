"""Follow a leader as if tied to it by a damped spring, knowing only what a sensor on board tells.

The spring's length at rest is from centre to centre: 0.20 m leaves robots of 160 mm across 40 mm of
air. With e the spring's stretch, v the follower's wanted speed and u the leader's speed along it,

    dv/dt = w^2 e + 2 z w (u - v)

so a leader at constant speed is followed without a gap; without u the follower would trail by
2 z v / w, 40 mm at 0.2 m/s and w = 10 / s. It faces the leader: its turn rate is that of the line
to the leader plus a share of the bearing.

Reference: seed 001, section 2.1 and figures 1 b and 13 (20 cm, largest error 0.042 m).
"""

from copy import copy
from dataclasses import dataclass, replace
from math import cos, hypot, sin
from typing import Self

from tagmetry.arena.controllers.leader_motion import NeighbourMotion, Seen
from tagmetry.arena.controllers.parameters import Parameter
from tagmetry.arena.controllers.view import View
from tagmetry.arena.drive import STILL, Twist

_LONGEST_STEP_S = 0.2


@dataclass(frozen=True)
class Spring:
    """What ties a follower to its leader.

    Attributes:
        length_m: At rest, from centre to centre.
        stiffness_per_s: w, the undamped spring's angular rate.
        damping: z, its damping ratio; 1 is critical.
        turn_per_s: How soon the follower faces its leader.
        lost_s: After so long without a sighting it stands still.
    """

    length_m: float = 0.20
    stiffness_per_s: float = 10.0
    damping: float = 1.0
    turn_per_s: float = 5.0
    lost_s: float = 0.5


class SpringFollower:
    """A controller that follows one neighbour."""

    def __init__(self, leader: int, spring: Spring | None = None) -> None:
        """Tie it to a leader, by its id."""
        self._leader = leader
        self._spring = spring or Spring()
        self._motion = NeighbourMotion()
        self._speed_mps = 0.0
        self._before_s: float | None = None
        self._seen_s = float("-inf")

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        neighbour = view.neighbour(self._leader)
        leader = self._motion.see(view, neighbour)
        if neighbour is not None:
            self._seen_s = view.time_s - neighbour.age_s
        if leader is None or view.time_s - self._seen_s > self._spring.lost_s:
            self._speed_mps, self._before_s = 0.0, view.time_s
            return STILL
        return self._pulled(view, leader)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be changed of the spring."""
        spring = self._spring
        return (
            Parameter("length_m", spring.length_m, 0.17, 0.5, "of the spring at rest"),
            Parameter("stiffness_per_s", spring.stiffness_per_s, 1.0, 12.0, "of the spring"),
            Parameter("damping", spring.damping, 0.3, 3.0, "of the spring; 1 is critical"),
        )

    def tuned(self, name: str, value: float) -> Self:
        """Return it with another spring; it goes on with what it knows."""
        other = copy(self)
        other._spring = replace(self._spring, **{name: value})  # noqa: SLF001 - its own class
        return other

    def _pulled(self, view: View, leader: Seen) -> Twist:
        spring, step_s = self._spring, self._step_s(view.time_s)
        distance_m = max(hypot(leader.place.x_m, leader.place.y_m), 1e-3)
        bearing_rad = leader.place.bearing_rad
        across_rad = leader.place.heading_rad - bearing_rad
        away_mps = leader.twist.speed_mps * cos(across_rad)
        stretch_m = distance_m - spring.length_m
        pull_mps2 = spring.stiffness_per_s**2 * stretch_m
        drag_mps2 = 2 * spring.damping * spring.stiffness_per_s * (away_mps - self._speed_mps)
        self._speed_mps += step_s * (pull_mps2 + drag_mps2)
        aside_mps = leader.twist.speed_mps * sin(across_rad) + self._speed_mps * sin(bearing_rad)
        return Twist(
            self._speed_mps * cos(bearing_rad),
            aside_mps / distance_m + spring.turn_per_s * bearing_rad,
        )

    def _step_s(self, time_s: float) -> float:
        step_s = 0.0 if self._before_s is None else time_s - self._before_s
        self._before_s = time_s
        return min(max(step_s, 0.0), _LONGEST_STEP_S)

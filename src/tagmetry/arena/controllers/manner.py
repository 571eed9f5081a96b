"""How a robot of a swarm goes to a point that it wishes for."""

from dataclasses import dataclass, replace
from math import atan2, cos, hypot
from typing import Self

from tagmetry.arena.controllers.parameters import Parameter
from tagmetry.arena.drive import STILL, Twist


@dataclass(frozen=True)
class Manner:
    """How a robot of a swarm moves.

    Attributes:
        speed_mps: At most.
        turn_per_s: How soon it faces where it goes.
        turn_radps: How fast it turns at most.
        pull_per_s: Wished speed per metre that it is off.
        idle_mps: Slower wishes are not worth a turn.
    """

    speed_mps: float = 0.15
    turn_per_s: float = 4.0
    turn_radps: float = 3.0
    pull_per_s: float = 1.5
    idle_mps: float = 0.005

    @property
    def parameter(self) -> Parameter:
        """Its speed, which can be changed."""
        return Parameter("speed_mps", self.speed_mps, 0.02, 0.3, "at most")

    def at_speed(self, speed_mps: float) -> Self:
        """Return it with another speed."""
        return replace(self, speed_mps=speed_mps)


GENTLE = Manner()


def driven(x_m: float, y_m: float, manner: Manner) -> Twist:
    """Return the motion toward a point of the robot's own frame: it turns, then goes."""
    wish_mps = min(manner.pull_per_s * hypot(x_m, y_m), manner.speed_mps)
    if wish_mps < manner.idle_mps:
        return STILL
    bearing_rad = atan2(y_m, x_m)
    turn_radps = manner.turn_per_s * bearing_rad
    turn_radps = max(-manner.turn_radps, min(turn_radps, manner.turn_radps))
    return Twist(wish_mps * max(cos(bearing_rad), 0.0), turn_radps)

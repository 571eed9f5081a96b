"""Follow a timed path: a PD controller in the robot's own frame.

With the wanted place seen from the robot at (x, y), turned by h, and the wanted motion (v, omega):

    forward  = v cos h + k_x x + k_d (v cos h - v_robot)
    turn     = omega + k_y y v* + k_h sin h

where v* is |v| or, near rest, a least speed, so that a robot beside its path comes back to it, and
moving backwards steers the other way round.

Reference: seed 001, section 2.1 (a PD controller; no gains are printed); Y. Kanayama et al., A
stable tracking control method for an autonomous mobile robot, 1990, for the lateral term.
"""

from dataclasses import dataclass, replace
from math import copysign, cos, sin
from typing import Protocol, Self

from tagmetry.arena.controllers.course import Reference
from tagmetry.arena.controllers.parameters import Parameter
from tagmetry.arena.controllers.view import View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import Place


class Timed(Protocol):
    """Anything that says where to be at a time."""

    def at(self, time_s: float) -> Reference:
        """Return where to be."""


@dataclass(frozen=True)
class Gains:
    """How hard a robot is drawn to its path.

    Attributes:
        ahead_per_s: k_x.
        motion: k_d.
        aside_per_m2: k_y.
        turn_per_s: k_h.
    """

    ahead_per_s: float = 1.5
    motion: float = 0.0
    aside_per_m2: float = 25.0
    turn_per_s: float = 3.0


@dataclass(frozen=True)
class PathFollower:
    """A controller that follows a timed path; it stands still while nobody tells it where it is.

    Attributes:
        path: Where to be at what time.
        gains: How hard it is drawn there.
    """

    path: Timed
    gains: Gains = Gains()

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        if view.place is None:
            return STILL
        return toward(self.path.at(view.time_s), view.place, view.twist, self.gains)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be changed of its gains."""
        ahead, aside = self.gains.ahead_per_s, self.gains.aside_per_m2
        return (
            Parameter("ahead_per_s", ahead, 0.2, 4.0, "pull along the path"),
            Parameter("aside_per_m2", aside, 0.0, 60.0, "pull to the path from beside it"),
        )

    def tuned(self, name: str, value: float) -> Self:
        """Return it with one of these gains changed."""
        return replace(self, gains=replace(self.gains, **{name: value}))


def toward(wanted: Reference, place: Place, moving: Twist, gains: Gains) -> Twist:
    """Return the motion that brings a robot to its reference and keeps it there."""
    off = wanted.place.seen_from(place)
    ahead_mps = wanted.twist.speed_mps * cos(off.heading_rad)
    steering_mps = copysign(max(abs(wanted.twist.speed_mps), 0.05), wanted.twist.speed_mps)
    return Twist(
        ahead_mps + gains.ahead_per_s * off.x_m + gains.motion * (ahead_mps - moving.speed_mps),
        wanted.twist.turn_rate_radps
        + gains.aside_per_m2 * off.y_m * steering_mps
        + gains.turn_per_s * sin(off.heading_rad),
    )

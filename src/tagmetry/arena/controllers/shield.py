"""Keep robots from touching, and inside their place, whatever a controller wants.

Toward anything ahead a robot may go as fast as it can still stop for: with a gap g, a braking rate
a and a delay t between what is known and what is done,

    v t + v^2 / (2 a) <= g      so      v = a (sqrt(t^2 + 2 g / a) - t)

The other is taken to keep its place: both sides keep their half of the gap where both come.
Turning on the spot is always free, so a robot can leave.
"""

from dataclasses import dataclass
from math import cos, inf, pi, sqrt

from tagmetry.arena.controllers.view import Controller, View
from tagmetry.arena.drive import Twist
from tagmetry.arena.place import turned_rad
from tagmetry.arena.safety import Fence


@dataclass(frozen=True)
class ShieldRules:
    """What a robot keeps away from, and how.

    Attributes:
        diameter_m: Of the robots.
        gap_m: That stays free between two bodies.
        braking_mps2: How hard a robot can stop.
        delay_s: From what happens to what the robot does about it.
        fence: Where its rim stays; anywhere when None.
    """

    diameter_m: float = 0.160
    gap_m: float = 0.01
    braking_mps2: float = 1.0
    delay_s: float = 0.1
    fence: Fence | None = None


@dataclass(frozen=True)
class Shielded:
    """A controller whose wishes are slowed where they would end in a touch.

    Attributes:
        controller: Whose wishes.
        rules: What is kept.
    """

    controller: Controller
    rules: ShieldRules = ShieldRules()

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        return shielded(self.controller(view), view, self.rules)


def shielded(wanted: Twist, view: View, rules: ShieldRules) -> Twist:
    """Return the wanted motion, as slow as what is ahead of it demands; turns stay as they are."""
    front_rad = 0.0 if wanted.speed_mps >= 0 else pi
    limits_mps = [*_by_neighbours(view, front_rad, rules), *_by_obstacles(view, front_rad, rules)]
    limits_mps.append(_by_fence(view, front_rad, rules))
    slowed_mps = min(abs(wanted.speed_mps), *limits_mps)
    return Twist(slowed_mps if front_rad == 0 else -slowed_mps, wanted.turn_rate_radps)


def stoppable_mps(gap_m: float, rules: ShieldRules) -> float:
    """Return how fast one may go toward something so far away."""
    if gap_m <= 0:
        return 0.0
    delay_s, braking = rules.delay_s, rules.braking_mps2
    return braking * (sqrt(delay_s**2 + 2 * gap_m / braking) - delay_s)


def _by_neighbours(view: View, front_rad: float, rules: ShieldRules) -> list[float]:
    limits_mps = []
    for other in view.neighbours:
        free_m = other.range_m - rules.diameter_m - rules.gap_m
        limits_mps.append(_toward(free_m, other.bearing_rad - front_rad, rules))
    return limits_mps


def _by_obstacles(view: View, front_rad: float, rules: ShieldRules) -> list[float]:
    reach_m = rules.diameter_m / 2 + rules.gap_m
    return [
        _toward(one.range_m - reach_m, one.bearing_rad - front_rad, rules) for one in view.obstacles
    ]


def _toward(free_m: float, off_rad: float, rules: ShieldRules) -> float:
    """Return the speed ahead whose part toward a thing that lies off to a side is stoppable."""
    part = cos(turned_rad(off_rad))
    return stoppable_mps(free_m, rules) / part if part > 0.05 else inf


def _by_fence(view: View, front_rad: float, rules: ShieldRules) -> float:
    """Return how fast it may go ahead: half a length ahead must not be further out than here."""
    if rules.fence is None or view.place is None:
        return inf
    inside_m = rules.fence.inside_m(view.place.xy_m)
    step_m = -rules.diameter_m / 2 if front_rad else rules.diameter_m / 2
    ahead_m = rules.fence.inside_m(view.place.moved(step_m, 0.0).xy_m)
    if ahead_m >= inside_m:
        return inf
    share = (inside_m - ahead_m) / abs(step_m)
    return stoppable_mps(inside_m - rules.diameter_m / 2, rules) / max(share, 0.05)

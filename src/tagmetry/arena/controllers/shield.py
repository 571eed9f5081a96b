"""Keep robots from touching, and inside their place, whatever a controller wants.

Toward anything ahead a robot may go as fast as it can still stop for: with a gap g, a braking rate
a and a delay t between what is known and what is done,

    v t + v^2 / (2 a) <= g      so      v = a (sqrt(t^2 + 2 g / a) - t)

Another robot may come toward it just so: each takes half of the gap between them. Turning on the
spot is always free, so a robot can leave.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import cos, inf, pi, sqrt
from typing import Self

from tagmetry.arena.controllers.parameters import Parameter, parameters_of, tuned
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
    gap_m: float = 0.02
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

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The controller's, and the gap that stays free."""
        gap = Parameter("gap_m", self.rules.gap_m, 0.0, 0.3, "that stays free between two robots")
        return (*parameters_of(self.controller), gap)

    def tuned(self, name: str, value: float) -> Self:
        """Return it with one of them changed."""
        if name == "gap_m":
            return replace(self, rules=replace(self.rules, gap_m=value))
        return replace(self, controller=tuned(self.controller, name, value))


def shielded(wanted: Twist, view: View, rules: ShieldRules) -> Twist:
    """Return the wanted motion, as slow as what is ahead of it demands; turns stay as they are."""
    front_rad = 0.0 if wanted.speed_mps >= 0 else pi
    sweep_rad = abs(wanted.turn_rate_radps) * rules.delay_s
    limits_mps = [
        _toward(gap_m, turned_rad(bearing_rad - front_rad), sweep_rad, rules)
        for gap_m, bearing_rad in _gaps(view, rules)
    ]
    limits_mps.append(_by_fence(view, front_rad, rules))
    slowed_mps = min(abs(wanted.speed_mps), *limits_mps)
    return Twist(slowed_mps if front_rad == 0 else -slowed_mps, wanted.turn_rate_radps)


def stoppable_mps(gap_m: float, rules: ShieldRules) -> float:
    """Return how fast one may go toward something so far away."""
    if gap_m <= 0:
        return 0.0
    delay_s, braking = rules.delay_s, rules.braking_mps2
    return braking * (sqrt(delay_s**2 + 2 * gap_m / braking) - delay_s)


def _gaps(view: View, rules: ShieldRules) -> Iterator[tuple[float, float]]:
    """Yield how far the robot may go toward each thing, and where that is."""
    for other in view.neighbours:
        yield (other.range_m - rules.diameter_m - rules.gap_m) / 2, other.bearing_rad
    for one in view.obstacles:
        yield one.range_m - rules.diameter_m / 2 - rules.gap_m, one.bearing_rad


def _toward(gap_m: float, off_rad: float, sweep_rad: float, rules: ShieldRules) -> float:
    """Return the speed ahead whose part toward a thing that lies off to a side is stoppable.

    Until it can know better, the robot may have turned toward it by the sweep.
    """
    part = cos(max(abs(off_rad) - sweep_rad, 0.0))
    return stoppable_mps(gap_m, rules) / part if part > 0.05 else inf


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

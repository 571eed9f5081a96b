"""A path of straight lines and arcs, driven with soft starts and stops: where to be at what time.

Speed rises at a constant rate to the cruising speed and falls so that the path's end is a stop; on
a path too short for that it turns around half-way.
"""

from dataclasses import dataclass
from functools import cached_property
from math import pi, sqrt

from tagmetry.arena.drive import Twist
from tagmetry.arena.place import Place
from tagmetry.errors import InputError


@dataclass(frozen=True)
class Arc:
    """A piece of a path.

    Attributes:
        length_m: Along the path.
        turn_rad: By how much it turns, counter-clockwise; 0 is straight.
    """

    length_m: float
    turn_rad: float = 0.0


@dataclass(frozen=True)
class Reference:
    """Where a robot shall be, and how it shall move there.

    Attributes:
        place: In the world.
        twist: In the robot's own frame.
    """

    place: Place
    twist: Twist


@dataclass(frozen=True)
class Course:
    """A timed path.

    Attributes:
        start: Where it begins, and which way it goes.
        arcs: Its pieces in their order.
        speed_mps: To cruise at.
        acceleration_mps2: Of the start and of the stop.
        start_s: When it begins.
    """

    start: Place
    arcs: tuple[Arc, ...]
    speed_mps: float = 0.2
    acceleration_mps2: float = 0.2
    start_s: float = 0.0

    def __post_init__(self) -> None:
        if not self.arcs or not all(0 < arc.length_m < float("inf") for arc in self.arcs):
            raise InputError("a course needs pieces, each with a positive length in metres")
        if not (0 < self.speed_mps < float("inf") and 0 < self.acceleration_mps2 < float("inf")):
            raise InputError(
                f"a course needs a positive speed and acceleration, got {self.speed_mps} m/s and "
                f"{self.acceleration_mps2} m/s^2"
            )

    @property
    def length_m(self) -> float:
        """Of the whole path."""
        return sum(arc.length_m for arc in self.arcs)

    @property
    def end_s(self) -> float:
        """When it is at its end."""
        return self.start_s + 2 * self._ramp_s + self._cruise_s

    def at(self, time_s: float) -> Reference:
        """Return where to be; at rest at the start before it and at the end after it."""
        driven_m, speed_mps = self._driven(time_s - self.start_s)
        place, curvature = self._where(driven_m)
        return Reference(place, Twist(speed_mps, curvature * speed_mps))

    @cached_property
    def _top_mps(self) -> float:
        return min(self.speed_mps, sqrt(self.acceleration_mps2 * self.length_m))

    @cached_property
    def _ramp_s(self) -> float:
        return self._top_mps / self.acceleration_mps2

    @cached_property
    def _cruise_s(self) -> float:
        return self.length_m / self._top_mps - self._ramp_s

    def _driven(self, since_s: float) -> tuple[float, float]:
        """Return how far it is along the path and how fast, m and m/s."""
        whole_s = 2 * self._ramp_s + self._cruise_s
        rising_s = min(max(since_s, 0.0), self._ramp_s)
        falling_s = min(max(whole_s - since_s, 0.0), self._ramp_s)
        cruised_s = min(max(since_s - self._ramp_s, 0.0), self._cruise_s)
        half = self.acceleration_mps2 / 2
        braked_m = half * (self._ramp_s**2 - falling_s**2)
        driven_m = half * rising_s**2 + self._top_mps * cruised_s + braked_m
        return driven_m, self.acceleration_mps2 * min(rising_s, falling_s)

    def _where(self, driven_m: float) -> tuple[Place, float]:
        """Return the place so far along the path, and the curvature there, 1/m."""
        place, left_m = self.start, driven_m
        for arc in self.arcs:
            curvature = arc.turn_rad / arc.length_m
            if left_m <= arc.length_m:
                return place.moved(left_m, left_m * curvature), curvature
            place, left_m = place.moved(arc.length_m, arc.turn_rad), left_m - arc.length_m
        return place, 0.0


def line_loop_line(start: Place, line_m: float = 0.8, radius_m: float = 0.35) -> Course:
    """Return seed 001's leader's path: along a line, one loop, and on along the line."""
    loop = Arc(2 * pi * radius_m, 2 * pi)
    return Course(start, (Arc(line_m), loop, Arc(line_m)))

"""Drive courses one after another, and wait for the robot: a path without a timetable.

A course says where to be at what time. Here its time is the robot's own: it passes as usual while
the robot is near where it shall be, slower while it lags, and not at all while it is held up. So a
robot that waited before another goes on from where it is, and cuts no corner.
"""

from collections.abc import Sequence
from dataclasses import replace

from tagmetry.arena.controllers.course import Course, Reference
from tagmetry.arena.controllers.tracking import Gains, toward
from tagmetry.arena.controllers.view import View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import Place, turned_rad

_NEAR_M, _FAR_M = 0.04, 0.12  # time slows between these lags
_FACES_RAD, _TURN_PER_S = 0.1, 3.0
_ARRIVED_M = 0.02
_LONGEST_STEP_S = 0.2


class PatientFollower:
    """A controller that drives courses; it turns on the spot before each, and stays at the end."""

    def __init__(self, legs: Sequence[Course], gains: Gains | None = None) -> None:
        """Begin with the first.

        Args:
            legs: Each begins where the one before ends.
            gains: How hard the robot is drawn to its path.
        """
        self._legs = list(legs)
        self._gains = gains or Gains()
        self._own_s = 0.0
        self._before_s: float | None = None
        self._faces = False

    def __call__(self, view: View) -> Twist:
        """Return how to move; still where nobody tells where the robot is, and at the end."""
        step_s = self._step_s(view.time_s)
        if view.place is None or not self._legs:
            return STILL
        off_rad = turned_rad(self._legs[0].start.heading_rad - view.place.heading_rad)
        self._faces |= abs(off_rad) < _FACES_RAD
        if not self._faces:
            return Twist(0.0, _TURN_PER_S * off_rad)
        return self._drawn(view, view.place, step_s)

    def _drawn(self, view: View, place: Place, step_s: float) -> Twist:
        leg = self._legs[0]
        time_s = leg.start_s + self._own_s
        wanted = leg.at(time_s)
        if time_s >= leg.end_s and wanted.place.distance_m(place) < _ARRIVED_M:
            self._legs.pop(0)
            self._own_s, self._faces = 0.0, False
            return STILL
        pace = _pace(wanted.place.distance_m(place))
        self._own_s += pace * step_s
        return toward(_slowed(wanted, pace), place, view.twist, self._gains)

    def _step_s(self, time_s: float) -> float:
        step_s = 0.0 if self._before_s is None else time_s - self._before_s
        self._before_s = time_s
        return min(max(step_s, 0.0), _LONGEST_STEP_S)


def _pace(lag_m: float) -> float:
    """Return how fast a course's time passes, 0 to 1."""
    return min(max((_FAR_M - lag_m) / (_FAR_M - _NEAR_M), 0.0), 1.0)


def _slowed(wanted: Reference, pace: float) -> Reference:
    twist = Twist(pace * wanted.twist.speed_mps, pace * wanted.twist.turn_rate_radps)
    return replace(wanted, twist=twist)

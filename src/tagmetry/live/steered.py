"""A robot's own controller, until a person sends the robot somewhere else.

Time in which a controller is not asked, because its robot is stopped or sent away, does not pass
for it: a leader whose course is timed goes on where it was, and does not run after its timetable.
"""

from dataclasses import replace
from math import atan2, cos, hypot

from tagmetry.arena.controllers import Controller, ShieldRules, View
from tagmetry.arena.controllers.shield import shielded
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import turned_rad

_ARRIVED_M, _TOP_MPS, _NEARING_PER_S, _TURN_PER_S = 0.02, 0.25, 1.5, 3.0
_PAUSE_S = 0.2  # a controller that was not asked for longer was paused


class Steered:
    """A controller that a person can overrule.

    Attributes:
        goal_m: (x, y) of where to go; None while the robot's own controller drives.
    """

    def __init__(self, controller: Controller | None, rules: ShieldRules) -> None:
        """Take the robot's own controller, if it has one, and how it keeps away from others."""
        self.goal_m: tuple[float, float] | None = None
        self._controller, self._rules = controller, rules
        self._asked_s: float | None = None
        self._paused_s = 0.0

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        goal_m = self.goal_m
        if goal_m is not None:
            return shielded(toward_goal(view, goal_m), view, self._rules)
        return self._controller(self._without_pauses(view)) if self._controller else STILL

    def _without_pauses(self, view: View) -> View:
        """Return the view at the controller's own time."""
        before_s = view.time_s if self._asked_s is None else self._asked_s
        if view.time_s - before_s > _PAUSE_S:
            self._paused_s += view.time_s - before_s
        self._asked_s = view.time_s
        sensed_s = None if view.sensed_s is None else view.sensed_s - self._paused_s
        return replace(view, time_s=view.time_s - self._paused_s, sensed_s=sensed_s)


def toward_goal(view: View, goal_m: tuple[float, float]) -> Twist:
    """Return the motion that turns a robot to a place (x, y) and brings it there."""
    if view.place is None:
        return STILL
    x_m, y_m = goal_m[0] - view.place.x_m, goal_m[1] - view.place.y_m
    distance_m = hypot(x_m, y_m)
    if distance_m < _ARRIVED_M:
        return STILL
    off_rad = turned_rad(atan2(y_m, x_m) - view.place.heading_rad)
    speed_mps = min(_TOP_MPS, _NEARING_PER_S * distance_m) * max(cos(off_rad), 0.0)
    return Twist(speed_mps, _TURN_PER_S * off_rad)

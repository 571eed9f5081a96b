"""A robot's own controller, until a person sends the robot on an errand.

Time in which a controller is not asked, because its robot is stopped or sent away, does not pass
for it: a leader whose course is timed goes on where it was, and does not run after its timetable.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace

from tagmetry.arena.controllers import (
    Controller,
    Parameter,
    Shielded,
    ShieldRules,
    View,
    parameters_of,
    tuned,
)
from tagmetry.arena.controllers.shield import shielded
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.safety import Fence
from tagmetry.live.errands import Errand

_PAUSE_S = 0.2  # a controller that was not asked for longer was paused


class Steered:
    """A controller that a person can overrule.

    Attributes:
        errand: What to do instead; None while the robot's own controller drives.
    """

    def __init__(self, controller: Controller | None, rules: ShieldRules) -> None:
        """Take the robot's own controller, if it has one, and how it keeps away from others."""
        self.errand: Errand | None = None
        self._controller, self._rules = controller, rules
        self._asked_s: float | None = None
        self._paused_s = 0.0

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        errand = self.errand
        if errand is not None:
            return shielded(errand(view), view, self._rules)
        return self._controller(self._without_pauses(view)) if self._controller else STILL

    @property
    def fence(self) -> Fence | None:
        """What the robot's own controller stays within, if it says so."""
        own = self._controller
        return own.rules.fence if isinstance(own, Shielded) else None

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be changed of the robot's own controller."""
        return parameters_of(self._controller)

    def tune(self, name: str, value: float) -> None:
        """Change a parameter, if the robot's own controller has it.

        Raises:
            InputError: The value is out of its range.
        """
        if self._controller is not None:
            self._controller = tuned(self._controller, name, value)

    def _without_pauses(self, view: View) -> View:
        """Return the view at the controller's own time."""
        before_s = view.time_s if self._asked_s is None else self._asked_s
        if view.time_s - before_s > _PAUSE_S:
            self._paused_s += view.time_s - before_s
        self._asked_s = view.time_s
        sensed_s = None if view.sensed_s is None else view.sensed_s - self._paused_s
        return replace(view, time_s=view.time_s - self._paused_s, sensed_s=sensed_s)


def parameters_by_name(steered: Iterable[Steered]) -> Mapping[str, Parameter]:
    """Return what can be changed of robots, each name as the first robot has it."""
    known: dict[str, Parameter] = {}
    for one in steered:
        for parameter in one.parameters:
            known.setdefault(parameter.name, parameter)
    return known

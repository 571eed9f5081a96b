"""A robot's own controller, until a person sends the robot on an errand.

A controller that expects nobody in its way, a leader's on its course, is shielded from robots that
are on errands, and from no others: a follower keeps nearer to its leader than the shield would let
it.

Time in which a controller is not asked, because its robot is stopped or sent away, does not pass
for it: a leader whose course is timed goes on where it was, and does not run after its timetable.
"""

from collections.abc import Callable, Iterable, Mapping
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
from tagmetry.live.show.errands import Errand

_PAUSE_S = 0.2  # a controller that was not asked for longer was paused


class Steered:
    """A controller that a person can overrule.

    Attributes:
        errand: What to do instead; None while the robot's own controller drives.
    """

    def __init__(
        self,
        controller: Controller | None,
        rules: ShieldRules,
        is_sent: Callable[[int], bool] = lambda _robot: False,
    ) -> None:
        """Take over a robot.

        Args:
            controller: Its own, if it has one.
            rules: How it keeps away from others.
            is_sent: Whether a robot, by its id, is on an errand.
        """
        self.errand: Errand | None = None
        self._controller, self._rules, self._is_sent = controller, rules, is_sent
        self._asked_s: float | None = None
        self._paused_s = 0.0

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        errand = self.errand
        if errand is not None:
            return shielded(errand(view), view, self._rules)
        if self._controller is None:
            return STILL
        wish = self._controller(self._without_pauses(view))
        return shielded(wish, self._of_the_sent(view), self._rules)

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

    def _of_the_sent(self, view: View) -> View:
        """Return the view without those that its controller expects where they are."""
        sent = tuple(one for one in view.neighbours if self._is_sent(one.id))
        return replace(view, neighbours=sent, obstacles=())

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

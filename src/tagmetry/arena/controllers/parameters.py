"""Numbers of a controller that people may change while it drives, each with its range.

A controller that has some says so:

    parameters: what there is and what it is set to
    tuned(name, value): the controller with one of them changed; the old one is no longer used
"""

from dataclasses import dataclass
from math import isfinite
from typing import Protocol, Self, runtime_checkable

from tagmetry.arena.controllers.view import Controller, View
from tagmetry.arena.drive import Twist
from tagmetry.errors import InputError


@dataclass(frozen=True)
class Parameter:
    """A number that can be changed.

    Attributes:
        name: With its unit.
        value: As it is set.
        least: That makes sense.
        most: That makes sense.
        meaning: In words.
    """

    name: str
    value: float
    least: float
    most: float
    meaning: str


@runtime_checkable
class Tunable(Protocol):
    """A controller with parameters."""

    def __call__(self, view: View) -> Twist:
        """Return how to move."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be changed."""

    def tuned(self, name: str, value: float) -> Self:
        """Return it with one of its parameters changed; the value is within its range."""


def parameters_of(controller: Controller | None) -> tuple[Parameter, ...]:
    """Return what can be changed of a controller; nothing of most."""
    return controller.parameters if isinstance(controller, Tunable) else ()


def tuned(controller: Controller, name: str, value: float) -> Controller:
    """Return a controller with a parameter changed; the same where it has none of this name.

    Raises:
        InputError: The value is out of the parameter's range.
    """
    known = {one.name: one for one in parameters_of(controller)}
    if name not in known or not isinstance(controller, Tunable):
        return controller
    check_range(known[name], value)
    return controller.tuned(name, value)


def check_range(parameter: Parameter, value: float) -> None:
    """Refuse a value that a parameter cannot have.

    Raises:
        InputError: It is out of the range, or no number.
    """
    if not (isfinite(value) and parameter.least <= value <= parameter.most):
        raise InputError(
            f"{parameter.name} is {parameter.least:g} to {parameter.most:g}, got {value:g}"
        )

"""What can be set on a camera: zoom, focus, exposure, gain, and its auto modes.

Usual names and units; a camera may have others, and need not have all of these:

    zoom           percent, 100 shows everything
    focus          the device's own unit, with its own direction
    exposure       seconds
    gain           factor on the signal
    auto_focus     0 or 1: the camera moves `focus` itself
    auto_exposure  0 or 1: the camera sets `exposure` and `gain` itself
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from tagmetry.camera.source import Source
from tagmetry.errors import ControlError, InputError

RULED_BY: Mapping[str, str] = {
    "focus": "auto_focus",
    "exposure": "auto_exposure",
    "gain": "auto_exposure",
}
"""Which auto mode moves a control, and must be off before anyone else does."""

_NEARLY = 1e-9  # of the step, that a limit may be missed by


class ControlRefusedError(ControlError):
    """A camera did not take a value that is within the control's range."""


class ControlMisreadError(ControlError):
    """A camera reads back another value than it was sent."""


class ControlStuckError(ControlError):
    """No image showed a change in the time that it may take: the control sticks or is too late."""


@dataclass(frozen=True)
class Control:
    """One control of a camera and its range.

    Attributes:
        name: What it is called.
        least: Smallest value.
        most: Greatest value.
        step: Values are `least` and whole steps from it; 0 takes every value.
        default: Value after the camera was switched on.
        unit: `percent`, `s`, `factor`; empty for the device's own.
    """

    name: str
    least: float
    most: float
    step: float
    default: float
    unit: str = ""

    def __post_init__(self) -> None:
        numbers = (self.least, self.most, self.step, self.default)
        if not (np.isfinite(numbers).all() and self.step >= 0):
            raise InputError(
                f"{self.name}: limits and default must be finite and the step not negative, got "
                f"{self._range} from {self.default:g}"
            )
        if not self.least <= self.default <= self.most:
            raise InputError(f"{self.name}: the default {self.default:g} is not in {self._range}")

    def checked(self, value: float) -> float:
        """Return the value that the control can take nearest to one within its range.

        Raises:
            InputError: The value is not finite or out of range; it is not clipped.
        """
        slack = _NEARLY * max(self.step, abs(self.most))
        if not self.least - slack <= value <= self.most + slack:
            raise InputError(f"{self.name}: expected {self._range}, got {value:g}{self._unit}")
        return self.nearest(value)

    def nearest(self, value: float) -> float:
        """Return the value that the control can take nearest to any finite one."""
        inside = min(max(value, self.least), self.most)
        if self.step == 0:
            return inside
        steps = min(round((inside - self.least) / self.step), self._steps)
        return self.least + steps * self.step

    @property
    def _steps(self) -> int:
        """How many whole steps there are."""
        return int((self.most - self.least) / self.step + _NEARLY)

    @property
    def _range(self) -> str:
        step = f" in steps of {self.step:g}" if self.step > 0 else ""
        return f"{self.least:g} to {self.most:g}{self._unit}{step}"

    @property
    def _unit(self) -> str:
        return f" {self.unit}" if self.unit else ""


@runtime_checkable
class Controls(Protocol):
    """What can be set on one camera."""

    @property
    def available(self) -> Mapping[str, Control]:
        """The camera's controls by name."""

    def read(self, name: str) -> float:
        """Return what the camera says a control is at.

        Raises:
            InputError: The camera has no such control.
        """

    def write(self, name: str, value: float) -> float:
        """Set a control and return the value that was sent: the nearest whole step.

        It returns before the images show the change.

        Raises:
            InputError: The camera has no such control, or the value is out of its range.
            ControlRefusedError: The camera does not take the value.
        """


@runtime_checkable
class ControlledSource(Source, Protocol):
    """A source of images whose camera can be set."""

    @property
    def controls(self) -> Controls:
        """What can be set."""


def control_named(available: Mapping[str, Control], name: str) -> Control:
    """Return a control by its name, or raise InputError with the names that there are."""
    if name not in available:
        names = ", ".join(available) or "none"
        raise InputError(f"this camera has no control {name[:40]!r}; it has: {names}")
    return available[name]

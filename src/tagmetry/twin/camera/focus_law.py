"""Which distance is in focus at a value of the focus control."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from tagmetry.errors import InputError


class FocusLaw(Protocol):
    """From a control value to a distance."""

    def distance_m(self, value: float) -> float:
        """Return the distance in focus; may be infinite."""

    def value(self, distance_m: float) -> float:
        """Return the control value for a distance, not rounded or limited to the control's."""


@dataclass(frozen=True)
class LogFocus:
    """F = -alpha ln z + beta, z in metres; a greater value is nearer.

    Reference: Equation 3 and Table 2 of the paper on dynamic camera control for micro markers.
    """

    alpha: float = 42.11
    beta: float = 4.0

    def __post_init__(self) -> None:
        if not (np.isfinite((self.alpha, self.beta)).all() and self.alpha > 0):
            raise InputError(
                f"a focus law needs a positive alpha and a finite beta, got {self.alpha} and "
                f"{self.beta}"
            )

    def distance_m(self, value: float) -> float:
        """Return the distance in focus."""
        return float(np.exp((self.beta - value) / self.alpha))

    def value(self, distance_m: float) -> float:
        """Return the control value for a distance."""
        return float(self.beta - self.alpha * np.log(distance_m))


@dataclass(frozen=True)
class DioptreFocus:
    """A motor that moves in proportion to 1 / distance; 0 is infinity.

    Attributes:
        value_m: Control value that focuses at 1 m.
    """

    value_m: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.value_m) and self.value_m > 0):
            raise InputError(f"value_m must be positive, got {self.value_m}")

    def distance_m(self, value: float) -> float:
        """Return the distance in focus."""
        return self.value_m / value if value > 0 else float("inf")

    def value(self, distance_m: float) -> float:
        """Return the control value for a distance."""
        return self.value_m / distance_m


@dataclass(frozen=True)
class FixedFocus:
    """A lens that stays focused at one distance."""

    focus_m: float

    def __post_init__(self) -> None:
        if not self.focus_m > 0:
            raise InputError(f"focus_m must be positive, got {self.focus_m}")

    def distance_m(self, value: float) -> float:  # noqa: ARG002 (there is nothing to set)
        """Return the distance in focus."""
        return self.focus_m

    def value(self, distance_m: float) -> float:  # noqa: ARG002 (there is nothing to set)
        """Return 0."""
        return 0.0

"""Which focus value is sharp at which depth.

    LogLaw      F = -alpha ln z + beta       seed 000, equation 3
    DioptreLaw  F = per_dioptre / z + far    a thin lens whose motor moves in proportion
    SplineLaw   F(ln z), a monotone cubic    any lens, within the depths that were measured

Depths z in metres from the camera's centre; F in the device's own unit, with its own direction.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from tagmetry.errors import InputError


class FocusLaw(Protocol):
    """From a depth to the focus value that is sharp there, and back."""

    def value(self, depth_m: float) -> float:
        """Return the focus value for a depth, not rounded or limited to the control's."""

    def depth_m(self, value: float) -> float:
        """Return the depth in focus; may be infinite."""


@dataclass(frozen=True)
class LogLaw:
    """F = -alpha ln z + beta.

    Reference: seed 000, equation 3 and table 2, whose camera has the numbers that stand here.
    """

    alpha: float = 42.11
    beta: float = 4.0

    def __post_init__(self) -> None:
        _check_numbers("a logarithmic focus law", self.alpha, self.beta)

    def value(self, depth_m: float) -> float:
        """Return the focus value for a depth."""
        return float(self.beta - self.alpha * np.log(_checked_depth_m(depth_m)))

    def depth_m(self, value: float) -> float:
        """Return the depth in focus."""
        return float(np.exp((self.beta - value) / self.alpha))


@dataclass(frozen=True)
class DioptreLaw:
    """F = per_dioptre / z + far.

    Attributes:
        per_dioptre: Focus units per 1/m.
        far: Focus value of infinity.
    """

    per_dioptre: float
    far: float = 0.0

    def __post_init__(self) -> None:
        _check_numbers("a dioptre law", self.per_dioptre, self.far)

    def value(self, depth_m: float) -> float:
        """Return the focus value for a depth."""
        return self.per_dioptre / _checked_depth_m(depth_m) + self.far

    def depth_m(self, value: float) -> float:
        """Return the depth in focus; infinite at `far` and beyond."""
        dioptres = (value - self.far) / self.per_dioptre
        return 1 / dioptres if dioptres > 0 else float("inf")


@dataclass(frozen=True)
class SplineLaw:
    """A monotone cubic through places of the curve; straight beyond its ends.

    Attributes:
        log_depths: ln z, strictly rising.
        values: F there, strictly rising or strictly falling.
    """

    log_depths: tuple[float, ...]
    values: tuple[float, ...]

    def __post_init__(self) -> None:
        steps, rises = np.diff(self.log_depths), np.diff(self.values)
        if len(self.log_depths) != len(self.values) or len(steps) < 1 or not (steps > 0).all():
            raise InputError("a focus spline needs two or more depths, strictly rising")
        if not ((rises > 0).all() or (rises < 0).all()):
            raise InputError("the values of a focus spline must all rise or all fall")

    def value(self, depth_m: float) -> float:
        """Return the focus value for a depth."""
        return _along(self.log_depths, self.values, float(np.log(_checked_depth_m(depth_m))))

    def depth_m(self, value: float) -> float:
        """Return the depth in focus, by bisection: the cubic's inverse is no cubic."""
        sign = 1.0 if self.values[-1] > self.values[0] else -1.0
        low, high = np.log(1e-4), np.log(1e4)
        for _ in range(60):
            middle = (low + high) / 2
            ahead = sign * (_along(self.log_depths, self.values, middle) - value) > 0
            low, high = (low, middle) if ahead else (middle, high)
        return float(np.exp((low + high) / 2))


def _along(places: Sequence[float], values: Sequence[float], at: float) -> float:
    """Return a monotone cubic's value, going on straight beyond its ends."""
    from scipy.interpolate import PchipInterpolator  # slow to import

    curve = PchipInterpolator(places, values)
    inside = float(np.clip(at, places[0], places[-1]))
    if inside == at:
        return float(curve(at))
    end = 1 if at > places[-1] else 0
    slope = (values[-1] - values[-2]) / (places[-1] - places[-2]) if end else 0.0
    slope = slope if end else (values[1] - values[0]) / (places[1] - places[0])
    return float(curve(inside) + slope * (at - inside))


def _checked_depth_m(depth_m: float) -> float:
    if not depth_m > 0:
        raise InputError(f"a depth must be positive, in metres, got {depth_m}")
    return float(depth_m)


def _check_numbers(what: str, slope: float, constant: float) -> None:
    if not (np.isfinite((slope, constant)).all() and slope != 0):
        raise InputError(f"{what} needs a slope that is not 0, got {slope} and {constant}")

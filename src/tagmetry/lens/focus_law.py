"""Which focus value is sharp at which depth: laws, fitted to measured pairs.

    LogLaw      F = -alpha ln z + beta       seed 000, equation 3
    DioptreLaw  F = per_dioptre / z + far    a thin lens whose motor moves in proportion
    SplineLaw   F(ln z), a monotone cubic    any lens, within the depths that were measured

Depths z in metres from the camera's centre; F in the device's own unit, with its own direction.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array

_LEAST_PAIRS = 3


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


@dataclass(frozen=True, eq=False)
class FocusFit:
    """A law and how well it explains what was measured.

    Attributes:
        law: The law.
        covariance: Of its two numbers, shape (2, 2); None for a spline.
        residuals: Measured minus predicted, focus units, shape (n,).
        left_out: The same where each pair in turn took no part, shape (n,); NaN where the law
            cannot be told without it.
    """

    law: LogLaw | DioptreLaw | SplineLaw
    covariance: Array | None
    residuals: Array
    left_out: Array

    @property
    def rms(self) -> float:
        """Root mean square of what is left, focus units."""
        return float(np.sqrt(np.mean(self.residuals**2)))

    @property
    def left_out_rms(self) -> float:
        """Root mean square error of predicting a pair from the others, focus units."""
        return float(np.sqrt(np.nanmean(self.left_out**2)))


def fit_focus_laws(
    depths_m: Sequence[float], values: Sequence[float], sds: Sequence[float] | None = None
) -> Mapping[str, FocusFit]:
    """Return every law fitted to measured pairs, the one that predicts best first.

    Args:
        depths_m: Where the target was, shape (n,), three or more.
        values: Focus values that were sharpest there.
        sds: Their standard deviations; by default all alike, judged by the residuals.

    Raises:
        InputError: There are too few pairs, or they are no numbers.
    """
    pairs = _checked_pairs(depths_m, values, sds)
    solvers: dict[str, Callable[[Array], tuple[LogLaw | DioptreLaw | SplineLaw, Array | None]]] = {
        "log": _fitted_log,
        "dioptre": _fitted_dioptre,
        "spline": _fitted_spline,
    }
    fits = {name: _assessed(solve, pairs) for name, solve in solvers.items()}
    return dict(sorted(fits.items(), key=lambda item: round(item[1].left_out_rms, 9)))


def _assessed(
    solve: Callable[[Array], tuple[LogLaw | DioptreLaw | SplineLaw, Array | None]], pairs: Array
) -> FocusFit:
    law, covariance = solve(pairs)
    left_out = np.full(len(pairs), np.nan)
    for n in range(len(pairs)) if len(pairs) > _LEAST_PAIRS else ():
        others, _ = solve(np.delete(pairs, n, axis=0))
        left_out[n] = pairs[n, 1] - others.value(pairs[n, 0])
    residuals = np.array([value - law.value(depth_m) for depth_m, value, _ in pairs])
    return FocusFit(law, covariance, residuals, residuals if np.isnan(left_out).all() else left_out)


def _fitted_log(pairs: Array) -> tuple[LogLaw, Array]:
    numbers, covariance = _line(-np.log(pairs[:, 0]), pairs)
    return LogLaw(*numbers), covariance


def _fitted_dioptre(pairs: Array) -> tuple[DioptreLaw, Array]:
    numbers, covariance = _line(1 / pairs[:, 0], pairs)
    return DioptreLaw(*numbers), covariance


def _fitted_spline(pairs: Array) -> tuple[SplineLaw, None]:
    """Pool what is out of order, then pass through all that is left."""
    from scipy.optimize import isotonic_regression  # slow to import

    ordered = pairs[np.argsort(pairs[:, 0], kind="stable")]
    falls = np.polyfit(np.log(ordered[:, 0]), ordered[:, 1], 1)[0] < 0
    pooled = isotonic_regression(ordered[:, 1], weights=ordered[:, 2] ** -2, increasing=not falls)
    levels = np.unique(pooled.x)
    logs = np.array([np.log(ordered[pooled.x == level, 0]).mean() for level in levels])
    order = np.argsort(logs)
    return SplineLaw(tuple(logs[order].tolist()), tuple(levels[order].tolist())), None


def _line(x: Array, pairs: Array) -> tuple[tuple[float, float], Array]:
    """Return slope and constant of values over x, weighted, with their covariance.

    The covariance grows where the residuals are larger than the pairs' own deviations say.
    """
    weights = 1 / pairs[:, 2]
    J = np.stack([x, np.ones_like(x)], axis=1) * weights[:, None]
    inverse = np.linalg.inv(J.T @ J)
    numbers = inverse @ (J.T @ (weights * pairs[:, 1]))
    excess = float(np.sum((weights * pairs[:, 1] - J @ numbers) ** 2) / max(len(x) - 2, 1))
    return (float(numbers[0]), float(numbers[1])), np.asarray(inverse * max(excess, 1.0))


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


def _checked_pairs(
    depths_m: Sequence[float], values: Sequence[float], sds: Sequence[float] | None
) -> Array:
    """Return depth, value and deviation, shape (n, 3)."""
    sds = [1e-6] * len(values) if sds is None else sds
    if not len(depths_m) == len(values) == len(sds):
        raise InputError(
            f"expected as many depths as values and deviations, got {len(depths_m)}, "
            f"{len(values)} and {len(sds)}"
        )
    pairs = np.array([depths_m, values, sds], dtype=np.float64).T
    if not (np.isfinite(pairs).all() and (pairs[:, 0] > 0).all() and (pairs[:, 2] > 0).all()):
        raise InputError("depths and deviations of a focus curve must be positive numbers")
    if len(np.unique(pairs[:, 0])) < _LEAST_PAIRS:
        raise InputError(
            f"a focus curve needs {_LEAST_PAIRS} different depths or more, got "
            f"{len(np.unique(pairs[:, 0]))}; measure at more distances"
        )
    return pairs


def _checked_depth_m(depth_m: float) -> float:
    if not depth_m > 0:
        raise InputError(f"a depth must be positive, in metres, got {depth_m}")
    return float(depth_m)


def _check_numbers(what: str, slope: float, constant: float) -> None:
    if not (np.isfinite((slope, constant)).all() and slope != 0):
        raise InputError(f"{what} needs a slope that is not 0, got {slope} and {constant}")

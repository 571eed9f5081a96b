"""Laws of focus, fitted to measured pairs, and which of them predicts best.

Each pair in turn is left out and predicted from the others: the law with the smallest error comes
first. Depths z in metres from the camera's centre; F in the device's own unit.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.lens.focus_law import DioptreLaw, LogLaw, SplineLaw

_LEAST_PAIRS = 3

Law = LogLaw | DioptreLaw | SplineLaw
_Solver = Callable[[Array], tuple[Law, Array | None]]


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

    law: Law
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
    solvers: dict[str, _Solver] = {
        "log": _fitted_log,
        "dioptre": _fitted_dioptre,
        "spline": _fitted_spline,
    }
    fits = {name: _assessed(solve, pairs) for name, solve in solvers.items()}
    return dict(sorted(fits.items(), key=lambda item: round(item[1].left_out_rms, 9)))


def _assessed(solve: _Solver, pairs: Array) -> FocusFit:
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

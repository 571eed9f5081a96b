"""How long after a command its effect is seen: command, radio, motor, camera, program and all.

A robot is told to turn to and fro (or a lamp to blink), and what the camera sees is compared with
what should be seen without any delay. The model is

    seen(t) = offset + gain * expected(t - delay) + noise

with an `expected` that is linear between its knots: the heading that follows from turn rates that
are held, or the light that an exposure gathers. The delay is that of least squares; offset and gain
are found beside it. Times may come at any intervals, and the delay is finer than they are. A motor
that follows with a lag counts as part of the delay, as it does for whoever drives by it.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

from tagmetry.errors import InputError
from tagmetry.geometry import Array

_FEWEST = 10
_LEAST_GAIN_SD = 5.0  # below, what is seen may as well be noise


@dataclass(frozen=True)
class Reaction:
    """The delay from a command to what is seen of it.

    Attributes:
        delay_s: The delay; NaN where `why_not` says why.
        sd_s: Its standard deviation, for noise that is independent from sample to sample.
        gain: How much of what was expected is seen, 1 for a robot that does as it is told.
        noise: Root mean square of what remains, in the unit of what is seen.
        why_not: Why there is no delay; empty where there is one.
    """

    delay_s: float
    sd_s: float
    gain: float
    noise: float
    why_not: str = ""


@dataclass(frozen=True, eq=False)
class Expected:
    """What should be seen without delay: linear between knots, constant before the first.

    Attributes:
        times_s: The knots, rising, shape (n,).
        values: What is expected there, shape (n,).
        last_slope: How it goes on after the last knot, per second.
        is_angle: What is seen may jump by whole turns.
    """

    times_s: Array
    values: Array
    last_slope: float = 0.0
    is_angle: bool = False

    def at(self, times_s: Array) -> Array:
        """Return what is expected at any times, shape as theirs."""
        beyond_s = np.maximum(times_s - self.times_s[-1], 0.0)
        found: Array = np.interp(times_s, self.times_s, self.values) + self.last_slope * beyond_s
        return found

    def slope_at(self, times_s: Array) -> Array:
        """Return how fast it changes there, per second."""
        slopes = np.diff(self.values) / np.diff(self.times_s)
        steps = np.concatenate([[0.0], slopes, [self.last_slope]])
        found: Array = steps[np.searchsorted(self.times_s, times_s, side="right")]
        return found


def expected_heading(times_s: Array, turn_rates_radps: Array) -> Expected:
    """Return the heading that follows from turn rates, each held until the next.

    Args:
        times_s: When each was commanded, rising, shape (n,).
        turn_rates_radps: The rates, shape (n,).

    Raises:
        InputError: The shapes differ, a number is not finite, or the times do not rise.
    """
    times_s, rates = _checked(times_s, turn_rates_radps, "commands")
    turned = np.concatenate([[0.0], np.cumsum(rates[:-1] * np.diff(times_s))])
    return Expected(times_s, turned, float(rates[-1]), is_angle=True)


def expected_light(times_s: Array, is_lit: Array, exposure_s: float) -> Expected:
    """Return the light of a lamp as an exposure around each time gathers it, from 0 to 1.

    Args:
        times_s: When it was switched, rising, shape (n,); more than an exposure apart.
        is_lit: What to, shape (n,); dark before.
        exposure_s: How long an image is exposed.

    Raises:
        InputError: The shapes differ, the times do not rise, or come faster than the exposure.
    """
    times_s, levels = _checked(times_s, is_lit, "switchings")
    if not 0 < exposure_s < np.diff(times_s, prepend=-np.inf).min():
        raise InputError(
            f"expected an exposure above 0 and shorter than between switchings, got {exposure_s} s"
        )
    knots_s = (times_s[:, None] + exposure_s / 2 * np.array([-1.0, 1.0])).ravel()
    before = np.concatenate([[0.0], levels[:-1]])
    return Expected(knots_s, np.stack([before, levels], axis=1).ravel())


def estimate_reaction(
    expected: Expected, times_s: Array, seen: Array, *, longest_s: float = 1.0
) -> Reaction:
    """Return the delay with which what is seen follows what was expected.

    Args:
        expected: What would be seen without delay.
        times_s: When each image was taken, in the clock of the commands, rising, shape (n,).
        seen: What it shows: headings in radians, or a brightness in any unit.
        longest_s: The longest delay that is looked for.

    Raises:
        InputError: The shapes differ, a number is not finite, or there are fewer than 10 images.
    """
    times_s, seen = _checked(times_s, seen, "images")
    if len(times_s) < _FEWEST:
        raise InputError(f"expected at least {_FEWEST} images, got {len(times_s)}")
    if not 0 < longest_s < np.inf:
        raise InputError(f"expected a longest delay above 0 s, got {longest_s}")
    seen = np.unwrap(seen) if expected.is_angle else seen
    step_s = float(np.median(np.diff(times_s))) / 4
    delay_s = _least_squares_delay(expected, times_s, seen, longest_s, step_s)
    return _judged(expected, times_s, seen, delay_s, longest_s - step_s)


def _least_squares_delay(
    expected: Expected, times_s: Array, seen: Array, longest_s: float, step_s: float
) -> float:
    """Return the best delay: of a grid first, then between its neighbours."""

    def misfit(delay_s: float) -> float:
        return _fit(expected.at(times_s - delay_s), seen)[1]

    grid_s = np.arange(0.0, longest_s + step_s, step_s)
    best_s = grid_s[int(np.argmin([misfit(delay_s) for delay_s in grid_s]))]
    bounds = (max(best_s - step_s, 0.0), best_s + step_s)
    found = minimize_scalar(misfit, bounds=bounds, method="bounded", options={"xatol": 1e-7})
    return float(found.x)


def _fit(expected: Array, seen: Array) -> tuple[float, float]:
    """Return gain and sum of squares that remain, with the best offset."""
    centred, aim = expected - expected.mean(), seen - seen.mean()
    power = float(centred @ centred)
    gain = float(centred @ aim) / power if power > 0 else 0.0
    remaining = aim - gain * centred
    return gain, float(remaining @ remaining)


def _judged(
    expected: Expected, times_s: Array, seen: Array, delay_s: float, limit_s: float
) -> Reaction:
    """Return the result with its deviation, or why there is none."""
    shifted_s = times_s - delay_s
    gain, squares = _fit(expected.at(shifted_s), seen)
    noise = float(np.sqrt(squares / (len(seen) - 3)))
    slopes = -gain * expected.slope_at(shifted_s)
    J = np.stack([np.ones_like(seen), expected.at(shifted_s), slopes], axis=1)
    if np.linalg.matrix_rank(J) < 3:
        return _none(gain, noise, "nothing moves while images are taken")
    sd = noise * np.sqrt(np.diag(np.linalg.inv(J.T @ J)))
    if abs(gain) < _LEAST_GAIN_SD * sd[1]:
        return _none(gain, noise, "what is seen does not follow what was commanded")
    if delay_s > limit_s:
        return _none(gain, noise, f"it comes later than {limit_s:.2g} s, or not at all")
    return Reaction(delay_s, float(sd[2]), gain, noise)


def _none(gain: float, noise: float, why_not: str) -> Reaction:
    return Reaction(float("nan"), float("nan"), gain, noise, why_not)


def _checked(times_s: Array, values: Array, what: str) -> tuple[Array, Array]:
    """Return both as arrays of numbers, of one length, with rising times."""
    times_s, values = np.asarray(times_s, dtype=float), np.asarray(values, dtype=float)
    if times_s.shape != values.shape or times_s.ndim != 1 or not times_s.size:
        raise InputError(
            f"expected {what} as two lists of one length, got {times_s.shape} and {values.shape}"
        )
    if not (np.isfinite(times_s).all() and np.isfinite(values).all()):
        raise InputError(f"expected finite numbers of {what}, got NaN or infinity")
    if (np.diff(times_s) <= 0).any():
        raise InputError(f"expected the times of {what} to rise")
    return times_s, values

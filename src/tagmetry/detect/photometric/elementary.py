"""Exponential, logarithm and the normal integral, to 1e-7, as arithmetic that vectorises."""

import numpy as np

from tagmetry.detect.photometric.kernel import kernel

_FRACTION_BITS = 52
_ROOT_HALF = int(np.float64(np.sqrt(0.5)).view(np.int64))  # the bits of that number
_ONE = 1023
_LOG_2 = float(np.log(2.0))
_PER_LOG_2 = 1.0 / _LOG_2
_BELL = float(1.0 / np.sqrt(2.0 * np.pi))


@kernel
def logarithm(x: float) -> float:
    """Return log x, for normal positive numbers: x = 2^k m, m from root 1/2 to root 2."""
    bits = np.float64(x).view(np.int64)
    k = (bits - _ROOT_HALF) >> _FRACTION_BITS
    m = np.int64(bits - (k << _FRACTION_BITS)).view(np.float64)
    s = (m - 1.0) / (m + 1.0)
    s2 = s * s
    series = 1.0 + s2 * (1 / 3 + s2 * (1 / 5 + s2 * (1 / 7 + s2 * (1 / 9))))
    return float(_LOG_2 * np.int32(k) + 2.0 * s * series)


@kernel
def exponential(x: float) -> float:
    """Return e^x, for x from -700 to 700."""
    k = np.rint(x * _PER_LOG_2)
    r = x - k * _LOG_2
    series = 1 / 24 + r * (1 / 120 + r * (1 / 720 + r * (1 / 5040)))
    fraction = 1.0 + r * (1.0 + r * (1 / 2 + r * (1 / 6 + r * series)))
    bits = (np.int64(np.int32(k)) + _ONE) << _FRACTION_BITS
    return float(fraction * np.int64(bits).view(np.float64))


@kernel
def step_and_bell(z: float) -> tuple[float, float]:
    """Return the normal integral up to z, and its slope.

    Reference: Abramowitz and Stegun, Handbook of Mathematical Functions, 26.2.17.
    """
    bell = _BELL * exponential(-0.5 * z * z)
    t = 1.0 / (1.0 + 0.2316419 * abs(z))
    high = -0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))
    beyond = bell * t * (0.319381530 + t * high)
    return (beyond if z < 0.0 else 1.0 - beyond), bell

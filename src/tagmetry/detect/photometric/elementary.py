"""Exponential, logarithm and the normal integral, of 32 bits, as arithmetic that vectorises."""

import numpy as np

from tagmetry.detect.photometric.kernel import f32, kernel

_FRACTION_BITS = 23
_ROOT_HALF = int(f32(np.sqrt(0.5)).view(np.int32))  # the bits of that number
_ONE = 127
_LOG_2 = f32(np.log(2.0))
_PER_LOG_2 = f32(1.0 / np.log(2.0))
_BELL = f32(1.0 / np.sqrt(2.0 * np.pi))


@kernel
def logarithm(x: f32) -> f32:
    """Return log x, for normal positive numbers: x = 2^k m, m from root 1/2 to root 2."""
    bits = f32(x).view(np.int32)
    k = np.int32(np.int32(bits - _ROOT_HALF) >> _FRACTION_BITS)
    m = np.int32(bits - (k << _FRACTION_BITS)).view(f32)
    s = (m - f32(1)) / (m + f32(1))
    s2 = s * s
    series = f32(1) + s2 * (f32(1 / 3) + s2 * (f32(1 / 5) + s2 * (f32(1 / 7) + s2 * f32(1 / 9))))
    return f32(_LOG_2 * f32(k) + f32(2) * s * series)


@kernel
def exponential(x: f32) -> f32:
    """Return e^x, for x from -87 to 88."""
    k = np.rint(f32(x) * _PER_LOG_2)
    r = f32(x) - k * _LOG_2
    series = f32(1 / 24) + r * (f32(1 / 120) + r * f32(1 / 720))
    fraction = f32(1) + r * (f32(1) + r * (f32(1 / 2) + r * (f32(1 / 6) + r * series)))
    bits = np.int32((np.int32(k) + _ONE) << _FRACTION_BITS)
    return f32(fraction * bits.view(f32))


@kernel
def step_and_bell(z: f32) -> tuple[f32, f32]:
    """Return the normal integral up to z, and its slope.

    Reference: Abramowitz and Stegun, Handbook of Mathematical Functions, 26.2.17.
    """
    bell = _BELL * exponential(f32(-0.5) * z * z)
    t = f32(1) / (f32(1) + f32(0.2316419) * abs(z))
    high = t * (f32(1.781477937) + t * (f32(-1.821255978) + t * f32(1.330274429)))
    beyond = bell * t * (f32(0.319381530) + t * (f32(-0.356563782) + high))
    return (beyond if z < 0 else f32(1) - beyond), bell

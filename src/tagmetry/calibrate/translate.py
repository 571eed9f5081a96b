"""The same camera by another lens model, to start from."""

from dataclasses import replace

import numpy as np

from tagmetry.calibrate.bundle import Bundle

_FARTHEST_RAD = np.radians(85.0)


def as_rational(fisheye: Bundle, coefficients: int, farthest_rad: float) -> Bundle:
    """Return a bundle with a Brown lens of 8 or more coefficients that bends like a fisheye's.

    With r the tangent of the angle from the axis and d the fisheye's radius there, least squares
    of d (1 + k4 r^2 + k5 r^4 + k6 r^6) = r (1 + k1 r^2 + k2 r^4 + k3 r^6), linear in all six.

    Args:
        fisheye: The solved fisheye.
        coefficients: 8, 12 or 14.
        farthest_rad: Angle from the axis up to which to fit.
    """
    angle = np.linspace(0.01, min(farthest_rad, _FARTHEST_RAD), 100)
    ray = np.stack([np.sin(angle), 0 * angle, np.cos(angle)], axis=1)
    d, r = fisheye.lens.bend(ray)[:, 0], np.tan(angle)
    powers = r[:, None] ** np.array([2, 4, 6])
    rows = np.hstack([r[:, None] * powers, -d[:, None] * powers])
    size = np.sqrt((rows**2).sum(axis=1, keepdims=True))  # the far rays must not decide alone
    found = np.linalg.lstsq(rows / size, (d - r) / size[:, 0], rcond=None)[0]
    lens = np.zeros(coefficients)
    lens[[0, 1, 4, 5, 6, 7]] = found
    return replace(fisheye, kind="brown", intrinsics=np.concatenate([fisheye.intrinsics[:4], lens]))

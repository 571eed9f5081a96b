"""The fisheye of the twin's own lens (`rays`): radius = t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8).

With t the angle from the axis. None of it is the camera model's code.
"""

import numpy as np
from numba import njit

from tagmetry.geometry import Array


@njit(cache=True, nogil=True)
def bend_fisheye(x: float, y: float, z: float, k: Array) -> tuple[float, float]:
    """Bend a ray (x, y, z) toward the axis; NaN for the one straight back."""
    across = np.sqrt(x * x + y * y)
    if across == 0.0:
        return (0.0, 0.0) if z > 0 else (np.nan, np.nan)
    radius = _radius(np.arctan2(across, z), k)
    return radius * x / across, radius * y / across


@njit(cache=True, nogil=True)
def unbend_fisheye(bent_x: float, bent_y: float, k: Array) -> tuple[float, float, float]:
    """Search outward for the first angle that reaches the radius, then halve."""
    radius = np.sqrt(bent_x * bent_x + bent_y * bent_y)
    if radius == 0.0:
        return 0.0, 0.0, 1.0
    low, high, step = 0.0, 0.0, np.pi / 128.0
    while _radius(high, k) < radius:
        low, high = high, high + step
        if high > np.pi or _radius(high, k) < _radius(low, k):
            return np.nan, np.nan, np.nan
    for _ in range(60):
        middle = (low + high) / 2.0
        if _radius(middle, k) < radius:
            low = middle
        else:
            high = middle
    angle = (low + high) / 2.0
    aside = np.sin(angle) / radius
    return aside * bent_x, aside * bent_y, np.cos(angle)


@njit(cache=True, nogil=True)
def fisheye_fold(k: Array) -> float:
    """Return the least angle at which the image stands still, at most pi, by walking outward."""
    before = 0.0
    for step in range(1, 1025):
        angle = np.pi * step / 1024.0
        reached = _radius(angle, k)
        if reached <= before:
            return float(angle)
        before = reached
    return np.pi + 1e-9


@njit(cache=True, nogil=True)
def _radius(angle: float, k: Array) -> float:
    q = angle * angle
    return float(angle * (1.0 + k[0] * q + k[1] * q**2 + k[2] * q**3 + k[3] * q**4))

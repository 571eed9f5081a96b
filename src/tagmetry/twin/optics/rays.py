"""The twin's own lens: which way a pixel looks, and which pixel sees a point.

It takes the numbers of a `Camera` (intrinsics and distortion coefficients) but none of its code:
the laws are written here again, the inverse is another algorithm (steps with a numerical
derivative, each pixel from its neighbour's ray), so that a slip in the one shows against the other.

    u = fx x'' + cx, v = fy y'' + cy,  (x'', y'') the ray (x, y, 1) bent by the lens
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numba import njit

from tagmetry.camera import Camera
from tagmetry.geometry import Array
from tagmetry.twin.optics.fisheye_rays import bend_fisheye, fisheye_fold, unbend_fisheye

_STEP = 1e-6
_TURNS = 50
_REACHED = 1e-11


@dataclass(frozen=True)
class Rays:
    """A camera as the twin sees it."""

    camera: Camera

    def look(self, u: Array, v: Array) -> Array:
        """Return viewing directions of pixels, shape (..., 3), NaN where there is none."""
        bent_x = (u - self.camera.center_px[0]) / self.camera.focal_px[0]
        bent_y = (v - self.camera.center_px[1]) / self.camera.focal_px[1]
        k, fold = _law(self.camera.lens.coefficients, self._is_fisheye)
        rays = _straightened(bent_x.ravel(), bent_y.ravel(), k, fold, self._is_fisheye)
        return np.asarray(rays.reshape(*u.shape, 3))

    def see(self, p_camera: Array) -> Array:
        """Return the pixels that show points (..., 3), shape (..., 2), NaN where none does."""
        points = np.ascontiguousarray(p_camera.reshape(-1, 3))
        k, fold = _law(self.camera.lens.coefficients, self._is_fisheye)
        bent = _bent(points, k, fold, self._is_fisheye).reshape(*p_camera.shape[:-1], 2)
        return np.asarray(bent * self.camera.focal_px + self.camera.center_px)

    @property
    def _is_fisheye(self) -> bool:
        return self.camera.lens.kind == "fisheye"


@lru_cache(maxsize=64)
def _law(coefficients: tuple[float, ...], fisheye: bool) -> tuple[Array, float]:
    """Return all 14 coefficients, and where the image folds: radius squared, or angle squared."""
    k = np.concatenate([coefficients, np.zeros(14 - len(coefficients))])
    if fisheye:
        return k, fisheye_fold(k) ** 2
    return k, _fold(k) if k.any() else np.inf


@njit(cache=True, nogil=True)
def _bent(points: Array, k: Array, fold: float, fisheye: bool) -> Array:
    """Return the bent rays of points (n, 3), shape (n, 2)."""
    bent = np.full((len(points), 2), np.nan)
    for i in range(len(points)):
        x, y, z = points[i]
        if fisheye:
            if np.arctan2(np.sqrt(x * x + y * y), z) ** 2 < fold:
                bent[i] = bend_fisheye(x, y, z, k)
        elif z > 0 and (x * x + y * y) / (z * z) < fold:
            bent[i] = _bend(x / z, y / z, k)
    return bent


@njit(cache=True, nogil=True)
def _straightened(bent_x: Array, bent_y: Array, k: Array, fold: float, fisheye: bool) -> Array:
    """Return the directions (n, 3) whose bent rays are given."""
    rays = np.full((len(bent_x), 3), np.nan)
    if fisheye:
        for i in range(len(bent_x)):
            rays[i] = unbend_fisheye(bent_x[i], bent_y[i], k)
        return rays
    if not k.any():
        rays[:, 0], rays[:, 1], rays[:, 2] = bent_x, bent_y, 1.0
        return rays
    x, y, last_x, last_y = 0.0, 0.0, 0.0, 0.0
    slope = np.eye(2)  # d(ray) / d(bent ray), of a neighbour
    for i in range(len(bent_x)):
        ahead_x, ahead_y = 2.0 * x - last_x, 2.0 * y - last_y
        last_x, last_y = x, y
        x, y, reached = _step(bent_x[i], bent_y[i], ahead_x, ahead_y, k, slope)
        if not (reached and x * x + y * y < fold):
            x, y, reached = _unbend(bent_x[i], bent_y[i], last_x, last_y, k, slope)
        if not (reached and x * x + y * y < fold):  # the neighbour's ray was no good start
            x, y, reached = _unbend(bent_x[i], bent_y[i], bent_x[i], bent_y[i], k, slope)
        if reached and x * x + y * y < fold:
            rays[i] = (x, y, 1.0)
        else:
            x, y = 0.0, 0.0
    return rays


@njit(cache=True, nogil=True)
def _bend(x: float, y: float, k: Array) -> tuple[float, float]:
    """Bend a ray: radial, decentring, thin prism, tilted sensor (coefficients as OpenCV's)."""
    q = x * x + y * y
    gain = 1.0 + k[0] * q + k[1] * q**2 + k[4] * q**3
    gain /= 1.0 + k[5] * q + k[6] * q**2 + k[7] * q**3
    u = gain * x + 2.0 * k[2] * x * y + k[3] * (3.0 * x * x + y * y) + k[8] * q + k[9] * q**2
    v = gain * y + k[2] * (x * x + 3.0 * y * y) + 2.0 * k[3] * x * y + k[10] * q + k[11] * q**2
    if k[12] == 0.0 and k[13] == 0.0:
        return u, v
    # The sensor's axes in the lens: the plane is met by the ray through (u, v, 1) and looked at
    # along its own normal.
    cx, sx, cy, sy = np.cos(k[12]), np.sin(k[12]), np.cos(k[13]), np.sin(k[13])
    along = cy * u + sy * sx * v - sy * cx
    down = cx * v + sx
    depth = sy * u - cy * sx * v + cy * cx
    normal = cy * cx
    return normal * along / depth + sy * cx, normal * down / depth - sx


@njit(cache=True, nogil=True)
def _step(
    bent_x: float, bent_y: float, x: float, y: float, k: Array, slope: Array
) -> tuple[float, float, bool]:
    """Find the ray from one almost there, by a neighbour's slope; say whether it was reached."""
    for _ in range(3):
        at_x, at_y = _bend(x, y, k)
        miss_x, miss_y = bent_x - at_x, bent_y - at_y
        if abs(miss_x) + abs(miss_y) < _REACHED:
            return x, y, True
        x += slope[0, 0] * miss_x + slope[0, 1] * miss_y
        y += slope[1, 0] * miss_x + slope[1, 1] * miss_y
    return x, y, False


@njit(cache=True, nogil=True)
def _unbend(
    bent_x: float, bent_y: float, x: float, y: float, k: Array, slope: Array
) -> tuple[float, float, bool]:
    """Find the ray that is bent to a place, from any start; keep the slope that was found."""
    for _ in range(_TURNS):
        at_x, at_y = _bend(x, y, k)
        miss_x, miss_y = bent_x - at_x, bent_y - at_y
        if abs(miss_x) + abs(miss_y) < _REACHED:
            return x, y, True
        right_x, right_y = _bend(x + _STEP, y, k)
        low_x, low_y = _bend(x, y + _STEP, k)
        a, b = (right_x - at_x) / _STEP, (low_x - at_x) / _STEP
        c, d = (right_y - at_y) / _STEP, (low_y - at_y) / _STEP
        area = a * d - b * c
        if not area > 1e-9:
            return x, y, False
        slope[0, 0], slope[0, 1], slope[1, 0], slope[1, 1] = (
            d / area,
            -b / area,
            -c / area,
            a / area,
        )
        x += slope[0, 0] * miss_x + slope[0, 1] * miss_y
        y += slope[1, 0] * miss_x + slope[1, 1] * miss_y
    return x, y, False


@njit(cache=True, nogil=True)
def _fold(k: Array) -> float:
    """Return the least radius squared at which the image stands still, by walking outward."""
    least = np.inf
    for direction in range(16):
        cos, sin = np.cos(np.pi * direction / 8.0), np.sin(np.pi * direction / 8.0)
        before = 0.0
        for step in range(1, 600):
            radius = 0.005 * step * (1.0 + 0.01 * step)
            u, v = _bend(radius * cos, radius * sin, k)
            reached = u * cos + v * sin
            if reached <= before:
                least = min(least, radius * radius)
                break
            before = reached
    return least

"""How a lens bends rays: the two models behind one interface.

A lens maps a point in front of the camera to distorted normalised coordinates, on which the
intrinsics then act. Points that no pixel shows (behind the camera, beyond the fold of the
polynomial) become NaN.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, Protocol

import numpy as np

from tagmetry.camera import brown
from tagmetry.camera.fold import least_positive_root
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array

BROWN_COUNTS = (0, 4, 5, 8, 12, 14)


class Lens(Protocol):
    """What the camera model needs of a lens."""

    @property
    def kind(self) -> Literal["brown", "fisheye"]:
        """Which of the models it is."""

    @property
    def coefficients(self) -> tuple[float, ...]:
        """The coefficients in OpenCV's order."""

    @property
    def fold_angle_rad(self) -> float:
        """Angle from the optical axis up to which the lens is one to one."""

    def bend(self, p_camera: Array) -> Array:
        """Return distorted normalised coordinates (..., 2) of points (..., 3)."""

    def jacobians(self, p_camera: Array) -> tuple[Array, Array]:
        """Return d(bent) / d(point) (..., 2, 3) and d(bent) / d(coefficients) (..., 2, n)."""

    def straighten(self, bent: Array) -> Array:
        """Return unit rays (..., 3) of distorted normalised coordinates (..., 2)."""


@dataclass(frozen=True)
class BrownLens:
    """A pinhole with OpenCV's 4, 5, 8, 12 or 14 coefficients, or none.

    Attributes:
        coefficients: k1 k2 p1 p2 [k3 [k4 k5 k6 [s1 s2 s3 s4 [tx ty]]]].
    """

    coefficients: tuple[float, ...] = ()
    kind: Literal["brown"] = "brown"

    def __post_init__(self) -> None:
        if len(self.coefficients) not in BROWN_COUNTS:
            raise InputError(
                f"expected 0, 4, 5, 8, 12 or 14 distortion coefficients, got "
                f"{len(self.coefficients)}; a fisheye lens is a model of its own"
            )
        _check_finite(self.coefficients)

    @cached_property
    def _all(self) -> Array:
        return np.pad(self.coefficients, (0, brown.COEFFICIENTS - len(self.coefficients)))

    @cached_property
    def _fold_radius(self) -> float:
        return brown.fold_radius(self._all)

    @property
    def fold_angle_rad(self) -> float:
        """Angle from the optical axis up to which the lens is one to one."""
        return float(np.arctan(self._fold_radius))

    def bend(self, p_camera: Array) -> Array:
        """Return distorted normalised coordinates (..., 2) of points (..., 3)."""
        return brown.distort(self._ideal(p_camera), self._all)

    def jacobians(self, p_camera: Array) -> tuple[Array, Array]:
        """Return d(bent) / d(point) (..., 2, 3) and d(bent) / d(coefficients) (..., 2, n)."""
        xy = self._ideal(p_camera)
        by_xy = brown.jacobian_by_point(xy, self._all)
        by_point = np.empty((*xy.shape[:-1], 2, 3))
        by_point[..., :2] = by_xy
        by_point[..., 2] = -(by_xy * xy[..., None, :]).sum(axis=-1)
        by_point /= p_camera[..., 2][..., None, None]
        return by_point, brown.jacobian_by_coefficients(xy, self._all, len(self.coefficients))

    def straighten(self, bent: Array) -> Array:
        """Return unit rays (..., 3) of distorted normalised coordinates (..., 2)."""
        xy = brown.undistort(bent, self._all, self._fold_radius) if self.coefficients else bent
        rays = np.concatenate([xy, np.ones_like(xy[..., :1])], axis=-1)
        return np.asarray(rays / np.linalg.norm(rays, axis=-1, keepdims=True))

    def _ideal(self, p_camera: Array) -> Array:
        with np.errstate(divide="ignore", invalid="ignore"):
            xy = p_camera[..., :2] / p_camera[..., 2:]
        seen = (p_camera[..., 2] > 0) & (np.hypot(xy[..., 0], xy[..., 1]) < self._fold_radius)
        return np.where(seen[..., None], xy, np.nan)


@dataclass(frozen=True)
class FisheyeLens:
    """OpenCV's fisheye model (Kannala and Brandt, 2006; Kalibr's `equidistant`).

    With t the angle from the optical axis, the radius in the image is
    t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8). Rays beyond 90 degrees are fine.
    """

    coefficients: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)
    kind: Literal["fisheye"] = "fisheye"

    def __post_init__(self) -> None:
        if len(self.coefficients) != 4:
            raise InputError(
                f"a fisheye lens has 4 distortion coefficients, got {len(self.coefficients)}"
            )
        _check_finite(self.coefficients)

    @cached_property
    def fold_angle_rad(self) -> float:
        """Angle from the optical axis up to which the lens is one to one, at most pi."""
        k1, k2, k3, k4 = self.coefficients
        slope = np.array([1.0, 3 * k1, 5 * k2, 7 * k3, 9 * k4])  # in the squared angle
        return float(min(np.pi, np.sqrt(least_positive_root(slope))))

    def bend(self, p_camera: Array) -> Array:
        """Return distorted normalised coordinates (..., 2) of points (..., 3)."""
        angle, across = self._angle(p_camera)
        scale = self._scale(angle, across, p_camera[..., 2])
        return np.asarray(scale[..., None] * p_camera[..., :2])

    def jacobians(self, p_camera: Array) -> tuple[Array, Array]:
        """Return d(bent) / d(point) (..., 2, 3) and d(bent) / d(coefficients) (..., 2, n)."""
        angle, across = self._angle(p_camera)
        x, y, z = np.moveaxis(p_camera, -1, 0)
        slope, distance2 = self._slope(angle), across**2 + z**2
        along, aside = slope * z / distance2, self._scale(angle, across, z)
        direction = np.stack([x, y], axis=-1) / np.maximum(across, 1e-300)[..., None]
        outer = direction[..., :, None] * direction[..., None, :]
        by_xy = (along - aside)[..., None, None] * outer + aside[..., None, None] * np.eye(2)
        by_z = -(slope * across / distance2)[..., None] * direction
        by_point = np.concatenate([by_xy, by_z[..., None]], axis=-1)
        powers = angle[..., None] ** np.array([3.0, 5.0, 7.0, 9.0])
        return by_point, direction[..., :, None] * powers[..., None, :]

    def straighten(self, bent: Array) -> Array:
        """Return unit rays (..., 3) of distorted normalised coordinates (..., 2)."""
        radius = np.hypot(bent[..., 0], bent[..., 1])
        angle = self._angle_of(radius)
        with np.errstate(divide="ignore", invalid="ignore"):
            aside = np.where(radius > 0, np.sin(angle) / radius, 1.0)
        return np.concatenate([aside[..., None] * bent, np.cos(angle)[..., None]], axis=-1)

    def _angle(self, p_camera: Array) -> tuple[Array, Array]:
        across = np.hypot(p_camera[..., 0], p_camera[..., 1])
        angle, distance = np.arctan2(across, p_camera[..., 2]), np.hypot(across, p_camera[..., 2])
        seen = (angle < self.fold_angle_rad) & (distance > 0) & (distance < np.inf)
        return np.where(seen, angle, np.nan), across

    def _scale(self, angle: Array, across: Array, z: Array) -> Array:
        """Return the image radius over the distance from the axis; at the axis it is 1 / z."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(across < 1e-9 * z, 1 / z, self._radius(angle) / across)

    def _radius(self, angle: Array) -> Array:
        k1, k2, k3, k4 = self.coefficients
        t2 = angle * angle
        return np.asarray(angle * (1 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4)))))

    def _slope(self, angle: Array) -> Array:
        k1, k2, k3, k4 = self.coefficients
        t2 = angle * angle
        return np.asarray(1 + t2 * (3 * k1 + t2 * (5 * k2 + t2 * (7 * k3 + t2 * 9 * k4))))

    def _angle_of(self, radius: Array) -> Array:
        """Invert the radius by bisection, then Newton: it grows up to the fold."""
        low, high = np.zeros_like(radius), np.full_like(radius, self.fold_angle_rad)
        for _ in range(30):
            middle = (low + high) / 2
            short = self._radius(middle) < radius
            low, high = np.where(short, middle, low), np.where(short, high, middle)
        angle = (low + high) / 2
        for _ in range(3):
            slope = np.maximum(self._slope(angle), 1e-6)
            step = (self._radius(angle) - radius) / slope
            angle = np.clip(angle - step, 0.0, self.fold_angle_rad)
        reached = (np.abs(self._radius(angle) - radius) < 1e-9) & (angle < self.fold_angle_rad)
        return np.where(reached, angle, np.nan)


def _check_finite(coefficients: tuple[float, ...]) -> None:
    if not np.isfinite(coefficients).all():
        raise InputError(f"distortion coefficients must be finite, got {coefficients}")

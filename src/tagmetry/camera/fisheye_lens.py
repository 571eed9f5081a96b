"""A lens whose image grows with the angle from the axis, so that it sees beyond 90 degrees."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from tagmetry.camera.fold import least_positive_root
from tagmetry.camera.lens import check_finite
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array


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
        check_finite(self.coefficients)

    @property
    def names(self) -> tuple[str, ...]:
        """What the coefficients are called, one by one."""
        return ("k1", "k2", "k3", "k4")

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

"""A lens with radial and tangential distortion, a thin prism and a tilted sensor (`brown`)."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from tagmetry.camera import brown
from tagmetry.camera.lens import check_finite
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array

BROWN_COUNTS = (0, 4, 5, 8, 12, 14)
_NAMES = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tx", "ty")


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
        check_finite(self.coefficients)

    @property
    def names(self) -> tuple[str, ...]:
        """What the coefficients are called, one by one."""
        return _NAMES[: len(self.coefficients)]

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

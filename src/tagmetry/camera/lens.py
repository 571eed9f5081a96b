"""How a lens bends rays: one interface for all models.

A lens maps a point in front of the camera to distorted normalised coordinates, on which the
intrinsics then act. Points that no pixel shows (behind the camera, beyond the fold of the
polynomial) become NaN.
"""

from typing import Literal, Protocol

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array


class Lens(Protocol):
    """What the camera model needs of a lens."""

    @property
    def kind(self) -> Literal["brown", "fisheye"]:
        """Which of the models it is."""

    @property
    def coefficients(self) -> tuple[float, ...]:
        """The coefficients in OpenCV's order."""

    @property
    def names(self) -> tuple[str, ...]:
        """What the coefficients are called, one by one."""

    @property
    def fold_angle_rad(self) -> float:
        """Angle from the optical axis up to which the lens is one to one."""

    def bend(self, p_camera: Array) -> Array:
        """Return distorted normalised coordinates (..., 2) of points (..., 3)."""

    def jacobians(self, p_camera: Array) -> tuple[Array, Array]:
        """Return d(bent) / d(point) (..., 2, 3) and d(bent) / d(coefficients) (..., 2, n)."""

    def straighten(self, bent: Array) -> Array:
        """Return unit rays (..., 3) of distorted normalised coordinates (..., 2)."""


def check_finite(coefficients: tuple[float, ...]) -> None:
    """Refuse coefficients that are no numbers."""
    if not np.isfinite(coefficients).all():
        raise InputError(f"distortion coefficients must be finite, got {coefficients}")

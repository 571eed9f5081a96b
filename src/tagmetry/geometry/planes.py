"""Planes, and where rays meet them."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array
from tagmetry.geometry.transforms import RigidTransform


@dataclass(frozen=True)
class Plane:
    """All points p with `normal . p = offset_m`.

    Attributes:
        normal: Unit vector, shape (3,).
        offset_m: Distance from the origin along the normal.
    """

    normal: Array
    offset_m: float

    @classmethod
    def through(cls, points: Array) -> Self:
        """Return the plane with the least sum of squared distances to the points.

        Args:
            points: Shape (n, 3), n >= 3, not on one line, metres. The normal's sign is such that
                its largest component is positive.
        """
        points = np.asarray(points, dtype=np.float64)
        if points.ndim != 2 or points.shape[0] < 3 or points.shape[1] != 3:
            raise InputError(f"a plane needs points of shape (n >= 3, 3), got {points.shape}")
        if not np.isfinite(points).all():
            raise InputError("a plane needs finite points")
        centre = points.mean(axis=0)
        _, spread, axes = np.linalg.svd(points - centre, full_matrices=False)
        if spread[1] <= 1e-9 * max(spread[0], 1e-300):
            raise InputError("the points lie on one line and define no plane")
        normal = axes[2] * np.sign(axes[2][np.argmax(np.abs(axes[2]))])
        return cls(normal, float(normal @ centre))

    @classmethod
    def of_frame(cls, T_a_b: RigidTransform) -> Self:
        """Return the plane z = 0 of frame b, in frame a."""
        normal = T_a_b.rotation.as_matrix()[:, 2]
        return cls(normal, float(normal @ T_a_b.translation))

    def distance_m(self, points: Array) -> Array:
        """Return the signed distances of points (..., 3), positive on the normal's side."""
        return np.asarray(points @ self.normal - self.offset_m)

    def meet(self, origins: Array, directions: Array) -> Array:
        """Return where rays meet the plane.

        Args:
            origins: Shape (..., 3), metres.
            directions: Shape (..., 3), any length.

        Returns:
            Points, shape (..., 3), metres; NaN where the ray is level or points away.
        """
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = (self.offset_m - origins @ self.normal) / (directions @ self.normal)
            hits = np.isfinite(scale) & (scale > 0)
            return np.asarray(origins + np.where(hits, scale, np.nan)[..., None] * directions)

    def transformed(self, T_a_b: RigidTransform) -> "Plane":
        """Return this plane of frame b in frame a."""
        normal_a = T_a_b.rotation.apply(self.normal)
        return Plane(normal_a, float(self.offset_m + normal_a @ T_a_b.translation))

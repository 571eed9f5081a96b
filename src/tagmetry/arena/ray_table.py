"""Rays of a camera's pixels by interpolation: near enough to begin a fit with, and quick."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array

_STEP_PX = 24.0


@dataclass(frozen=True, eq=False)
class RayTable:
    """Rays at nodes over the image.

    Attributes:
        nodes: Unit vectors in the camera's frame, shape (rows, columns, 3); NaN where the lens
            shows nothing.
        step_px: From node to node along x and y, shape (2,); the first is at pixel (0, 0).
    """

    nodes: Array
    step_px: Array

    @classmethod
    def of(cls, camera: Camera) -> Self:
        """Return the table of a camera."""
        size_px = np.array(camera.size_px, dtype=np.float64)
        counts = np.ceil(size_px / _STEP_PX).astype(int) + 1
        step_px = size_px / (counts - 1)
        u, v = np.meshgrid(*(np.arange(n) * step for n, step in zip(counts, step_px, strict=True)))
        return cls(camera.unproject(np.stack([u, v], axis=-1)), step_px)

    def rays(self, pixels: Array) -> Array:
        """Return rays of pixels (..., 2), not of unit length, shape (..., 3).

        Pixels a little outside the image are extrapolated; NaN where the lens shows nothing.
        """
        at = pixels / self.step_px
        most = np.array(self.nodes.shape[1::-1]) - 2
        usable = np.isfinite(at).all(axis=-1, keepdims=True)
        low = np.clip(np.where(usable, at, 0.0), 0, most).astype(int)
        (x, y), (column, row) = np.moveaxis(at - low, -1, 0), np.moveaxis(low, -1, 0)
        above, below = self.nodes[row, column], self.nodes[row + 1, column]
        above = above + x[..., None] * (self.nodes[row, column + 1] - above)
        below = below + x[..., None] * (self.nodes[row + 1, column + 1] - below)
        return np.asarray(above + y[..., None] * (below - above))

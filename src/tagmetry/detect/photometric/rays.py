"""Rays of a camera's pixels from a table: what a lens's own formula costs is paid once per camera.

Between nodes, 8 px apart, rays are interpolated by cubics through four nodes each way, which is
good to some ten-thousandths of a pixel for strong lenses too.
"""

from dataclasses import dataclass
from typing import Self
from weakref import WeakKeyDictionary

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.photometric.kernel import kernel
from tagmetry.geometry import Array

_STEP_PX = 8.0
_BEYOND_PX = 8 * _STEP_PX  # the table reaches so far outside the image


@dataclass(frozen=True, eq=False)
class Rays:
    """Rays at nodes over an image.

    Attributes:
        nodes: Unit vectors in the camera's frame, shape (rows, columns, 3); NaN where the lens
            shows nothing. The first stands `_BEYOND_PX` before pixel (0, 0), both ways.
    """

    nodes: Array

    @classmethod
    def of(cls, camera: Camera) -> Self:
        """Return the table of a camera."""
        width_px, height_px = camera.size_px
        u, v = (
            np.arange(-_BEYOND_PX, size_px + _BEYOND_PX + _STEP_PX, _STEP_PX)
            for size_px in (width_px, height_px)
        )
        return cls(camera.unproject(np.stack(np.meshgrid(u, v), axis=-1)))

    def at(self, pixels: Array) -> Array:
        """Return rays of pixels (n, 2), nearly of unit length, (n, 3); NaN where not known."""
        return np.asarray(_interpolated(self.nodes, (pixels + _BEYOND_PX) / _STEP_PX))


_SEEN: "WeakKeyDictionary[Camera, Rays | None]" = WeakKeyDictionary()


def rays_of(camera: Camera, pixels: Array) -> Array:
    """Return rays of pixels (n, 2), (n, 3), NaN where the lens shows nothing.

    The first image of a camera is not worth a table; the second one makes it.
    """
    if camera not in _SEEN:
        _SEEN[camera] = None
        return camera.unproject(pixels)
    table = _SEEN[camera]
    if table is None:
        table = _SEEN[camera] = Rays.of(camera)
    rays = table.at(pixels)
    rest = np.isnan(rays[:, 0])
    if rest.any():
        rays[rest] = camera.unproject(pixels[rest])
    return rays


@kernel
def _interpolated(nodes: Array, at: Array) -> Array:
    """Return values (rows, columns, 3) at places x, y between them, NaN outside, shape (n, 3)."""
    rows, columns = nodes.shape[:2]
    found = np.zeros((len(at), 3))
    by_x, by_y = np.empty(4), np.empty(4)
    for k in range(len(at)):
        x, y = at[k]
        if not (1.0 <= x < columns - 2.0 and 1.0 <= y < rows - 2.0):
            found[k] = np.nan
            continue
        column, row = int(x), int(y)
        _write_weights(x - column, by_x)
        _write_weights(y - row, by_y)
        for j in range(4):
            for i in range(4):
                weight = by_y[j] * by_x[i]
                node = nodes[row + j - 1, column + i - 1]
                found[k, 0] += weight * node[0]
                found[k, 1] += weight * node[1]
                found[k, 2] += weight * node[2]
    return found


@kernel
def _write_weights(t: float, weights: Array) -> None:
    """Write Lagrange's weights of nodes at -1, 0, 1 and 2 for a place t."""
    weights[0] = -t * (t - 1.0) * (t - 2.0) / 6.0
    weights[1] = (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0
    weights[2] = -(t + 1.0) * t * (t - 2.0) / 2.0
    weights[3] = (t + 1.0) * t * (t - 1.0) / 6.0

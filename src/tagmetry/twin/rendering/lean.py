"""How much the scale changes within a pixel, where sheets are seen from the side.

A footprint's mean is taken over the sheet, where the part of it that is farther away counts for
more than in the pixel. At an angle a between ray and normal the sheet's area to a pixel grows by

    g = 3 tan(a) / focal_px

from pixel to pixel, and an edge across it is moved by g / 12 on average (the mean of
p (1 - p) / 2 over where in the pixel it lies); on a grid n times finer by g / (12 n^2). Scenery
is not looked at: a wall's texture may be off by a thousandth of a pixel.
"""

from collections.abc import Sequence

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array
from tagmetry.twin.optics.rays import Rays
from tagmetry.twin.rendering.box import Box
from tagmetry.twin.rendering.seen import SeenSheet

_PER_SIDE = 3  # rays looked at along a box
_STEEPEST = 1e4


def moved_px(seen: Sequence[SeenSheet], box: Box, camera: Camera) -> float:
    """Return by how much a sheet's edge would be moved on a grid of whole pixels.

    Args:
        seen: The sheets; those of scenery do not count.
        box: Where edges are looked at.
        camera: Who sees them.
    """
    growths = [
        3 * _steepest(one, common, camera) / min(camera.focal_px)
        for one in seen
        if not one.thing.scenery and (common := one.box & box)
    ]
    return max(growths, default=0.0) / 12


def _steepest(one: SeenSheet, box: Box, camera: Camera) -> float:
    """Return the greatest tangent of the angle between the rays of a box and a sheet's normal."""
    rays = _rays(box, camera)
    cos = -(rays @ one.T_camera_sheet.rotation.as_matrix()[:, 2])
    met = cos > 1 / _STEEPEST  # the others pass by, or are not there
    return float(np.sqrt(1 / cos[met].min() ** 2 - 1)) if met.any() else 0.0


def _rays(box: Box, camera: Camera) -> Array:
    """Return unit directions spread over a box, shape (n, 3)."""
    u = np.linspace(box.left - 0.5, box.right - 0.5, _PER_SIDE)
    v = np.linspace(box.top - 0.5, box.bottom - 0.5, _PER_SIDE)
    rays = Rays(camera).look(*np.meshgrid(u, v)).reshape(-1, 3)
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True))

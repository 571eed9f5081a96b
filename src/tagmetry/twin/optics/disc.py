"""How a disc of light falls on a grid of square cells: the exact area of disc and cell.

With S(x) = (x sqrt(R^2 - x^2) + R^2 asin(x / R)) / 2, the area between the axes, x = a > 0 and
y = b > 0 that lies within the disc is

    F(a, b) = b x_b + S(a) - S(x_b),  x_b = min(a, sqrt(R^2 - b^2)),

F is odd in a and b, and a cell's area is the difference of F over its four corners.
"""

import numpy as np

from tagmetry.geometry import Array


def disc_kernel(radius: float) -> Array:
    """Return the share of a uniform disc in each cell of a grid, centred on the middle cell.

    Args:
        radius: Of the disc, in cells; positive.

    Returns:
        Shape (n, n), n odd, sum 1.
    """
    reach = max(int(np.ceil(radius - 0.5)), 0)
    edges = np.arange(-reach, reach + 2, dtype=np.float64) - 0.5
    corner_areas = _area_to_axes(edges[None, :], edges[:, None], radius)
    areas = np.diff(np.diff(corner_areas, axis=0), axis=1)
    return np.asarray(areas / areas.sum())


def _area_to_axes(a: Array, b: Array, radius: float) -> Array:
    """Return F(a, b), signed, for broadcast corners."""
    wide, high = np.minimum(np.abs(a), radius), np.minimum(np.abs(b), radius)
    leaves = np.minimum(wide, np.sqrt((radius - high) * (radius + high)))
    area = high * leaves + _half_segment(wide, radius) - _half_segment(leaves, radius)
    return np.asarray(np.sign(a) * np.sign(b) * area)


def _half_segment(x: Array, radius: float) -> Array:
    """Return S(x), the area under the circle from 0 to x."""
    return np.asarray(
        (x * np.sqrt((radius - x) * (radius + x)) + radius**2 * np.arcsin(x / radius)) / 2
    )

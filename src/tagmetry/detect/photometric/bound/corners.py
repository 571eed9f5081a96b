"""How well can corners be known at all? The Cramer-Rao bound of a whole marker's picture.

When corners move, the blurred picture changes along the edges of its cells only: with G the blur's
Gaussian (the pixel's own square in it), n the normal of an edge from black to white at x,

    d white(p) / d corner = - integral over all edges of G(p - x) n . dx/dcorner dx
    d white(p) / d blur_ij = 1/2 integral over all edges of n_i d/dp_j G(p - x) dx, both ways

with blur_ij the blur's covariance. The levels of black and white, the blur, and a response exponent
are not known beforehand either. The noise is white, its deviation the same everywhere but for that
of light itself.

This shares no formula with the fit that it judges.
"""

import numpy as np

from tagmetry.detect.photometric.bound import light
from tagmetry.detect.photometric.bound.edges import by_edges
from tagmetry.detect.photometric.bound.seen import Print, Window
from tagmetry.geometry import Array

_ISOTROPIC = np.array([1.0, 0.0, 1.0])


def corner_bound_px2(corners_px: Array, seen: Print, noise: float) -> Array:
    """Return the least covariance of the corners (x0, y0, x1, ...), shape (8, 8).

    Args:
        corners_px: Where they are, shape (4, 2).
        seen: The marker.
        noise: Standard deviation of the grey values' noise.
    """
    window = Window.around(corners_px, seen)
    by_corners, by_blur = by_edges(window, seen)
    white = light.whiteness(light.sharp_samples(window, seen), seen)
    slope = light.by_whiteness(white, seen)[:, None]
    columns = [slope * by_corners, slope * (by_blur @ _ISOTROPIC)[:, None]]
    columns.append(light.by_levels(white, seen))
    if seen.exponent != 1.0:
        columns.append(light.by_exponent(white, seen)[:, None])
    variance = light.variances(white, seen, noise)
    return first_covariances(np.concatenate(columns, axis=1) / np.sqrt(variance)[:, None])


def corner_bound_px(corners_px: Array, seen: Print, noise: float) -> float:
    """Return the least root mean square error of a corner's coordinate; see `corner_bound_px2`."""
    return float(np.sqrt(np.trace(corner_bound_px2(corners_px, seen, noise)) / 8))


def first_covariances(J: Array) -> Array:
    """Return the first 8 rows and columns of (J^T J)^-1, well scaled first."""
    scale = np.linalg.norm(J, axis=0)
    scaled = J / scale
    return np.asarray((np.linalg.inv(scaled.T @ scaled) / np.outer(scale, scale))[:8, :8])

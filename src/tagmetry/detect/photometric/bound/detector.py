"""How well the detector of this package knows corners: the bound with what it does not know or use.

It finds more along with the corners than the bound takes as unknown: how light changes over the
marker, a blur of its own in every direction, and the exponent in any case. It looks at the pixels
beside edges only, of large markers at every second, third, ... All that widens the covariance.

It takes motion for a bell, not for the box that it is. What that costs is fitted to its errors on
the twin's pictures: some of what the pixels tell, and a part that does not go with the noise.
"""

import numpy as np
from scipy.ndimage import maximum_filter, minimum_filter

from tagmetry.detect.photometric.bound import light
from tagmetry.detect.photometric.bound.corners import first_covariances
from tagmetry.detect.photometric.bound.edges import by_edges, edge_px
from tagmetry.detect.photometric.bound.seen import Print, Window
from tagmetry.detect.photometric.marker import BESIDE_PX, FINE_PIXELS
from tagmetry.detect.photometric.pixels import FLAT
from tagmetry.geometry import Array

_LOST_BY_MOTION = 0.03  # share of the variance, by the motion's square, px
_LEFT_BY_MOTION = 3e-4  # px, by the motion's square
_LARGE_PX = 80.0  # from here on a marker's derivatives are those of a smaller one


def detector_covariance_px2(corners_px: Array, seen: Print, noise: float) -> Array:
    """Return the covariance that the detector's corners will have, shape (8, 8).

    Args:
        corners_px: Where they are, shape (4, 2).
        seen: The marker; the camera's lens is taken as known, so that no edge bows.
        noise: Standard deviation of the grey values' noise.
    """
    edges_px = edge_px(Window.around(corners_px, seen), seen)
    shrunk_px, times = _at_most(corners_px, _LARGE_PX)
    window = Window.around(shrunk_px, seen)
    by_corners, by_blur = by_edges(window, seen)
    sharp = light.sharp_samples(window, seen)
    white = light.whiteness(sharp, seen)
    slope = light.by_whiteness(white, seen)[:, None]
    columns = (
        slope * by_corners,
        slope * by_blur,
        light.by_levels(white, seen),
        light.by_exponent(white, seen)[:, None],
        light.by_slopes(white, seen, window),
    )
    weights = _shares_used(sharp, edges_px) / light.variances(white, seen, noise)
    known = first_covariances(np.concatenate(columns, axis=1) * np.sqrt(weights)[:, None])
    return _smeared(known / times, seen)


def _smeared(covariance_px2: Array, seen: Print) -> Array:
    """Return the covariance with what is lost by taking motion for a bell."""
    motion2_px2 = float(np.dot(seen.motion_px, seen.motion_px))
    left_px = _LEFT_BY_MOTION * motion2_px2
    return (1 + _LOST_BY_MOTION * motion2_px2) * covariance_px2 + left_px**2 * np.eye(8)


def _at_most(corners_px: Array, side_px: float) -> tuple[Array, float]:
    """Return the marker at most so large, shape (4, 2), and how many times larger it truly is.

    Where cells are much larger than the blur, the variance goes with one over the size.
    """
    times = max(1.0, float(np.ptp(corners_px, axis=0).max()) / side_px)
    middle = corners_px.mean(axis=0)
    return middle + (corners_px - middle) / times, times


def _shares_used(sharp: Array, edges_px: float) -> Array:
    """Return the share of pixels of each kind that the detector looks at, 0 to 1, shape (p,).

    Args:
        sharp: Samples within the pixels.
        edges_px: How long all edges of the picture truly are.
    """
    reach = int(BESIDE_PX * light.FINER)
    y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    disc = np.hypot(x, y) <= BESIDE_PX * light.FINER
    changes = maximum_filter(sharp, footprint=disc) > minimum_filter(sharp, footprint=disc)
    middle = light.FINER // 2
    beside = changes[middle :: light.FINER, middle :: light.FINER].ravel()
    every = np.ceil(2 * BESIDE_PX * edges_px / FINE_PIXELS)
    return np.asarray(np.where(beside, 1.0, 1.0 / FLAT) / every)

"""How wide are edges? The standard deviation of the blur, in pixels.

An edge of contrast c blurred by a Gaussian of deviation s has the steepest slope
c / (s sqrt(2 pi)).
"""

import cv2
import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

_COLUMNS = 15
_STEPS = 41
_REACH_PX = (2.5, 30.0)
_WINDOW_PX = 31
_LEAST_CONTRAST = 30
_LEAST_PIXELS = 50
_ROOT = float(np.sqrt(2 * np.pi))


def side_blurs_px(grey: GreyPixels, corners_px: Array, cell_px: float) -> Array:
    """Return the blur across each of a square's sides, shape (4,), px; NaN where unclear.

    Args:
        grey: The image.
        corners_px: Shape (4, 2).
        cell_px: A cell's width: the dark border is looked at no deeper.
    """
    reach_px = float(np.clip(cell_px, *_REACH_PX))
    offsets_px = np.linspace(-reach_px, reach_px, _STEPS)
    return np.array(
        [
            _blur_px(_profiles(grey, a, b, offsets_px), offsets_px)
            for a, b in zip(corners_px, np.roll(corners_px, -1, axis=0), strict=True)
        ]
    )


def side_normals(corners_px: Array) -> Array:
    """Return unit vectors across the sides, shape (4, 2)."""
    along = np.roll(corners_px, -1, axis=0) - corners_px
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    return np.stack([-along[:, 1], along[:, 0]], axis=1)


def principal_blurs_px(blurs_px: Array, normals: Array) -> tuple[float, float]:
    """Return the blur along the direction where it is widest, and across it.

    The variance of the blur along a normal n is n^T S n; the smallest S that fits all sides is
    taken, since two directions of sides do not tell how the blur lies between them.

    Args:
        blurs_px: Shape (n,).
        normals: Shape (n, 2).
    """
    x, y = normals.T
    design = np.stack([x * x, y * y, np.sqrt(2) * x * y], axis=1)
    xx, yy, xy = np.linalg.lstsq(design, blurs_px**2, rcond=0.3)[0]
    xy = xy / np.sqrt(2)
    small, large = np.sqrt(np.maximum(np.linalg.eigvalsh([[xx, xy], [xy, yy]]), 0))
    return float(large), float(small)


def sharpest_edges_px(grey: GreyPixels) -> Array:
    """Return the blur of the sharpest few edges of an image, by the direction of their slope.

    Returns:
        Slopes around 0, 45, 90 and 135 degrees, shape (4,), px; NaN where there are too few edges.
    """
    smooth = cv2.GaussianBlur(grey, (3, 3), 0.6)
    window = np.ones((_WINDOW_PX, _WINDOW_PX), np.uint8)
    contrast = cv2.dilate(smooth, window).astype(np.float64) - cv2.erode(smooth, window)
    slope_y, slope_x = np.gradient(smooth.astype(np.float64))
    slope = np.hypot(slope_x, slope_y)
    octant = np.rint(np.arctan2(slope_y, slope_x) / (np.pi / 4)) % 4
    edges = (contrast >= _LEAST_CONTRAST) & (slope > 0)
    blurs = [
        (contrast / (_ROOT * np.maximum(slope, 1e-9)))[edges & (octant == k)] for k in range(4)
    ]
    return np.array(
        [np.percentile(blur, 0.5) if len(blur) >= _LEAST_PIXELS else np.nan for blur in blurs]
    )


def _profiles(grey: GreyPixels, a: Array, b: Array, offsets_px: Array) -> Array:
    """Return grey values across the side from a to b, shape (columns, steps)."""
    along = np.linspace(0.2, 0.8, _COLUMNS)[:, None, None]
    direction = (b - a) / max(float(np.linalg.norm(b - a)), 1e-9)
    normal = np.array([-direction[1], direction[0]])
    places = (a + along * (b - a) + offsets_px[None, :, None] * normal).astype(np.float32)
    values = cv2.remap(
        grey.astype(np.float32),
        places[..., 0],
        places[..., 1],
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )
    return np.asarray(values, dtype=np.float64)


def _blur_px(profiles: Array, offsets_px: Array) -> float:
    step_px = offsets_px[1] - offsets_px[0]
    slope = np.abs(np.diff(profiles, axis=1)).max(axis=1) / step_px
    contrast = np.ptp(profiles, axis=1)
    clear = contrast > 8
    return (
        float(np.median(contrast[clear] / (_ROOT * slope[clear]))) if clear.any() else float("nan")
    )

"""Grey values between pixels, and how an image steps across the sides of squares."""

import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

_ALONG = np.linspace(0.05, 0.95, 10)


def steps_across(grey: GreyPixels, corners_px: Array, reach_px: Array) -> Array:
    """Return by how much the image is brighter just outside each side than just inside.

    Args:
        grey: 8-bit image.
        corners_px: Squares, clockwise, shape (n, 4, 2).
        reach_px: How far outside and inside each square's sides is looked at, shape (n,).

    Returns:
        Grey values at ten places along each side, shape (n, 40).
    """
    along = np.roll(corners_px, -1, axis=1) - corners_px
    length_px = np.maximum(np.linalg.norm(along, axis=2, keepdims=True), 1e-9)
    outward = np.stack([along[..., 1], -along[..., 0]], axis=-1) / length_px
    on = corners_px[:, :, None] + _ALONG[:, None] * along[:, :, None]
    off = reach_px[:, None, None, None] * outward[:, :, None]
    outside, inside = (bilinear(grey, at.reshape(-1, 2)) for at in (on + off, on - off))
    return (outside - inside).reshape(len(corners_px), 4 * len(_ALONG))


def side_lengths(corners_px: Array) -> Array:
    """Return the lengths of the sides of squares (n, 4, 2), shape (n, 4), pixels."""
    sides = np.roll(corners_px, -1, axis=1) - corners_px
    return np.asarray(np.linalg.norm(sides, axis=2))


def bilinear(grey: GreyPixels, pixels: Array) -> Array:
    """Return grey values between pixels, shape (n,); the image's edge is repeated outside."""
    height_px, width_px = grey.shape
    x = np.clip(np.nan_to_num(pixels[:, 0]), 0, width_px - 1.001)
    y = np.clip(np.nan_to_num(pixels[:, 1]), 0, height_px - 1.001)
    column, row = x.astype(np.intp), y.astype(np.intp)
    right, down = x - column, y - row
    flat, first = grey.ravel(), row * width_px + column
    above = flat[first] * (1 - right) + flat[first + 1] * right
    below = flat[first + width_px] * (1 - right) + flat[first + width_px + 1] * right
    return np.asarray(above * (1 - down) + below * down)

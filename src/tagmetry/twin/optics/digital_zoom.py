"""Digital zoom: a part of a larger sensor's image, resampled to the size that a camera gives out.

By the rule of pixel centres, with m = zoom * (size out) / (size in) along each axis,

    u' = m (u - c) + c',  c = (size in - 1) / 2, c' = (size out - 1) / 2

which is `camera.zoomed` followed by `camera.scaled`. A pixel is the exact mean of the interpolated
image over its own area: nothing aliases when shrinking, and no edge moves, at any zoom. (Picking
the interpolated image at the pixels' centres moves edges by up to 0.01 px as they lie.) Images go
on beyond the border as they end.
"""

from functools import lru_cache
from typing import Literal

import numpy as np
from scipy.sparse import csr_array

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels, FloatImage

Interpolation = Literal["area", "linear", "cubic"]

_REACH = {"area": 0.5, "linear": 1.0, "cubic": 2.0}  # half the kernel's width, pixels


def zoomed_pixels(
    image: AnyPixels,
    zoom: float,
    width_px: int,
    height_px: int,
    interpolation: Interpolation = "linear",
) -> FloatImage:
    """Return the middle 1 / zoom of an image, resampled to a size.

    Args:
        image: Shape (height, width), of the whole sensor.
        zoom: 1 or more, as of `camera.zoomed`.
        width_px: Columns to give out.
        height_px: Rows to give out.
        interpolation: What the image is between pixels' centres. `area`: squares of one colour;
            `linear` and `cubic` (Catmull-Rom, sharper, may overshoot) keep ramps at any zoom.

    Returns:
        Shape (height_px, width_px), float32.
    """
    _check(image, zoom, width_px, height_px, interpolation)
    pixels = np.asarray(image, np.float32)
    if zoom == 1 and image.shape == (height_px, width_px):
        return pixels
    down = resampling(image.shape[0], height_px, zoom, interpolation)
    across = resampling(image.shape[1], width_px, zoom, interpolation)
    return np.asarray((across @ (down @ pixels).T).T, np.float32)


@lru_cache(maxsize=16)
def resampling(size_in: int, size_out: int, zoom: float, interpolation: Interpolation) -> csr_array:
    """Return the weights of one axis, sparse, shape (size_out, size_in); rows sum to 1."""
    magnification = zoom * size_out / size_in
    at = (np.arange(size_out) - (size_out - 1) / 2) / magnification + (size_in - 1) / 2
    width = 1 / magnification
    reach = _REACH[interpolation] + width / 2
    first = np.ceil(at - reach).astype(np.int64)
    taps = first[:, None] + np.arange(int(np.floor(2 * reach)) + 1)
    weights = _weights(at[:, None] - taps, width, interpolation).astype(np.float32)
    rows = np.repeat(np.arange(size_out), taps.shape[1])
    columns = np.clip(taps, 0, size_in - 1).ravel()
    return csr_array((weights.ravel(), (rows, columns)), shape=(size_out, size_in))


def _weights(offset: Array, width: float, interpolation: Interpolation) -> Array:
    """Return the interpolating kernel's mean over a width around offsets."""
    integral = _INTEGRALS[interpolation]
    return np.asarray((integral(offset + width / 2) - integral(offset - width / 2)) / width)


def _area_integral(t: Array) -> Array:
    """Return the integral of 1 within 1/2, from 0 to t."""
    return np.clip(t, -0.5, 0.5)


def _linear_integral(t: Array) -> Array:
    """Return the integral of 1 - |t| within 1, from 0 to t."""
    t = np.clip(t, -1, 1)
    return np.asarray(t - np.abs(t) * t / 2)


def _cubic_integral(t: Array) -> Array:
    """Return the integral of the kernel of Catmull and Rom from 0 to t.

    It is (3 t^3 - 5 t^2 + 2) / 2 for 0 <= t < 1, (1 - t) (t - 2)^2 / 2 up to 2, and even.
    """
    size = np.minimum(np.abs(t), 2)
    inner = 3 / 8 * size**4 - 5 / 6 * size**3 + size
    outer = -1 / 8 * size**4 + 5 / 6 * size**3 - 2 * size**2 + 2 * size - 1 / 6
    return np.asarray(np.sign(t) * np.where(size < 1, inner, outer))


_INTEGRALS = {"area": _area_integral, "linear": _linear_integral, "cubic": _cubic_integral}


def _check(
    image: AnyPixels, zoom: float, width_px: int, height_px: int, interpolation: Interpolation
) -> None:
    if image.ndim != 2 or image.size == 0:
        raise InputError(f"expected an image of shape (height, width), got {image.shape}")
    if not (np.isfinite(zoom) and zoom >= 1):
        raise InputError(f"a digital zoom is at least 1, got {zoom}")
    if width_px < 1 or height_px < 1:
        raise InputError(f"image size must be positive, got {width_px}x{height_px}")
    if interpolation not in _REACH:
        raise InputError(f"expected interpolation {' or '.join(_REACH)}, got {interpolation!r}")

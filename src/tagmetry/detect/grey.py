"""What comes in is checked once, and turned into grey values to work on."""

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels, GreyPixels

SMALLEST_SIDE_PX = 8


def grey_8bit(pixels: AnyPixels) -> GreyPixels:
    """Return an image as grey 8-bit values, contiguous; nobody writes to them.

    Args:
        pixels: Grey (h, w) or (h, w, 1), BGR (h, w, 3) or BGRA (h, w, 4); uint8 or uint16. 16-bit
            images are stretched from their darkest to their brightest value.

    Raises:
        InputError: The array is no such image, or smaller than any marker.
    """
    check_pixels(pixels)
    if pixels.dtype == np.uint16:
        pixels = _stretched(pixels)
    if pixels.ndim == 3 and pixels.shape[2] >= 3:
        pixels = _grey_of_bgr(pixels[..., :3])
    grey = pixels.reshape(pixels.shape[:2])
    return np.require(grey, requirements=["C", "W"])  # Numba compiles anew for what is read-only


def check_pixels(pixels: AnyPixels) -> None:
    """Raise InputError for an array that is no image, or smaller than any marker."""
    if not isinstance(pixels, np.ndarray):
        raise InputError(f"an image must be a NumPy array, got {type(pixels).__name__}")
    if pixels.ndim not in (2, 3) or (pixels.ndim == 3 and pixels.shape[2] not in (1, 3, 4)):
        raise InputError(
            f"an image must have shape (height, width) or (height, width, 3), got {pixels.shape}"
        )
    if pixels.dtype not in (np.uint8, np.uint16):
        raise InputError(
            f"an image must hold uint8 or uint16 values, got {pixels.dtype}; scale and convert it"
        )
    height_px, width_px = pixels.shape[:2]
    if min(height_px, width_px) < SMALLEST_SIDE_PX:
        raise InputError(
            f"an image of {width_px}x{height_px} pixels is too small to show a marker; "
            f"at least {SMALLEST_SIDE_PX}x{SMALLEST_SIDE_PX} are needed"
        )


def _stretched(pixels: AnyPixels) -> GreyPixels:
    darkest, brightest = float(pixels.min()), float(pixels.max())
    gain = 255.0 / max(brightest - darkest, 1.0)
    return np.asarray(np.rint((pixels - np.float32(darkest)) * np.float32(gain)), dtype=np.uint8)


def _grey_of_bgr(pixels: AnyPixels) -> GreyPixels:
    import cv2

    grey = cv2.cvtColor(np.ascontiguousarray(pixels), cv2.COLOR_BGR2GRAY)
    return np.asarray(grey, dtype=np.uint8)

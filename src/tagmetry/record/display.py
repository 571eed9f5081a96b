"""Any picture as one to draw on."""

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels, GreyPixels


def displayable(pixels: AnyPixels) -> GreyPixels:
    """Return a copy of a picture as 8-bit BGR.

    Args:
        pixels: Grey (height, width), BGR or BGRA (height, width, 3 or 4), 8 or 16 bits. Of 16 bits
            those are shown that are in use, so that 10- and 12-bit pictures are not black.

    Returns:
        Shape (height, width, 3), uint8, contiguous.

    Raises:
        InputError: It is no such picture.
    """
    shape, kind = np.shape(pixels), getattr(pixels, "dtype", None)
    is_color = len(shape) == 3 and shape[2] in (3, 4)
    if kind not in (np.uint8, np.uint16) or 0 in shape or not (len(shape) == 2 or is_color):
        raise InputError(
            f"expected a grey or BGR picture of 8 or 16 bits, got shape {shape} of {kind}"
        )
    color = pixels[..., :3] if is_color else np.repeat(pixels[..., None], 3, axis=2)
    return np.array(color >> _unused_bits(color), dtype=np.uint8, order="C")


def _unused_bits(pixels: AnyPixels) -> int:
    """Return how far to shift, for pictures of 8, 10, 12, 14 or 16 bits."""
    used = int(pixels.max()).bit_length()
    return max(0, -(-(used - 8) // 2) * 2)

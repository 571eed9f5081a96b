"""The pixels of an encoded picture, after its header has been checked."""

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.headers import PictureHeader, checked_header
from tagmetry.sources.quiet import quiet_opencv
from tagmetry.sources.tiff import without_orientation


def decode_picture(content: bytes, *, grey: bool = False) -> AnyPixels:
    """Return the pixels of an encoded picture.

    Rows are those that the sensor wrote: an orientation tag (EXIF, TIFF) is ignored, because the
    intrinsics of a camera belong to its sensor and not to the way in which it was held. Palettes
    become colour, transparency is dropped, grey stays grey and 16 bits stay 16 bits.

    Args:
        content: The whole file: JPEG, PNG, BMP, TIFF, WebP or PNM.
        grey: Convert colour to grey.

    Returns:
        Grey (height, width) or BGR (height, width, 3), uint8 or uint16.

    Raises:
        InputError: It is no picture, too large, empty, cut off or damaged.
    """
    header = checked_header(content)
    stored = without_orientation(content) if header.kind == "TIFF" else content
    return _checked(_decoded(stored, header, grey=grey), header)


def _decoded(content: bytes, header: PictureHeader, *, grey: bool) -> AnyPixels | None:
    import cv2

    color = cv2.IMREAD_GRAYSCALE if grey else cv2.IMREAD_ANYCOLOR
    flags = color | cv2.IMREAD_ANYDEPTH | cv2.IMREAD_IGNORE_ORIENTATION
    try:
        with quiet_opencv():
            return cv2.imdecode(np.frombuffer(content, dtype=np.uint8), flags)
    except (cv2.error, MemoryError) as error:
        raise InputError(f"a {header.kind} picture that is damaged or of a rare kind") from error


def _checked(pixels: AnyPixels | None, header: PictureHeader) -> AnyPixels:
    if pixels is None:
        raise InputError(f"a {header.kind} picture that is damaged, cut off or of a rare kind")
    if pixels.dtype not in (np.uint8, np.uint16):
        raise InputError(f"expected a picture of 8 or 16 bits, found {pixels.dtype}; convert it")
    return pixels

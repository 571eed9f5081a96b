"""The size that a picture declares, read before anything is decoded or allocated.

A file of a hundred bytes can declare 50,000 x 50,000 pixels; a decoder would ask for the memory
first and find out afterwards.
"""

import re
import struct
from dataclasses import dataclass

from tagmetry.errors import InputError
from tagmetry.sources.content import HEAD_BYTES, PictureKind, describe, picture_kind
from tagmetry.sources.jpeg import check_jpeg_whole, jpeg_size
from tagmetry.sources.png import check_png_whole, png_size
from tagmetry.sources.tiff import tiff_size

MAX_PIXELS = 200_000_000

_UNDERSTOOD = "a picture (JPEG, PNG, BMP, TIFF, WebP, PGM or PPM)"
_PNM_SIZE = re.compile(rb"P[1-6](?:\s|#[^\n]*\n)+([0-9]{1,12})(?:\s|#[^\n]*\n)+([0-9]{1,12})\b")


@dataclass(frozen=True)
class PictureHeader:
    """What a picture says about itself.

    Attributes:
        kind: Its format.
        width_px: Columns that it declares.
        height_px: Rows.
    """

    kind: PictureKind
    width_px: int
    height_px: int


def checked_header(content: bytes) -> PictureHeader:
    """Return the header of a picture that is fit to be decoded.

    Args:
        content: The whole file.

    Raises:
        InputError: It is no picture, has no or too many pixels, or is cut off.
    """
    header = read_header(content)
    _check_size(header.width_px, header.height_px)
    if header.kind == "PNG":
        check_png_whole(content)
    if header.kind == "JPEG":
        check_jpeg_whole(content)
    return header


def read_header(content: bytes) -> PictureHeader:
    """Return what a picture declares, whether it is usable or not."""
    kind = picture_kind(content[:HEAD_BYTES])
    if kind is None:
        raise InputError(f"expected {_UNDERSTOOD}, found {describe(content[:HEAD_BYTES])}")
    try:
        return PictureHeader(kind, *_SIZE_READERS[kind](content))
    except struct.error as error:
        raise InputError(f"a {kind} picture whose header is cut off") from error


def _check_size(width_px: int, height_px: int) -> None:
    if width_px < 1 or height_px < 1:
        raise InputError(f"a picture without pixels: it declares {width_px}x{height_px}")
    if width_px * height_px > MAX_PIXELS:
        raise InputError(
            f"a picture of {width_px}x{height_px} pixels is too large: up to "
            f"{MAX_PIXELS // 1_000_000} megapixels are read; scale it down"
        )


def _bmp_size(content: bytes) -> tuple[int, int]:
    is_old = struct.unpack_from("<I", content, 14)[0] == 12
    width_px, height_px = struct.unpack_from("<HH" if is_old else "<ii", content, 18)
    return width_px, abs(height_px)  # negative: rows from the top down


def _webp_size(content: bytes) -> tuple[int, int]:
    chunk = content[12:16]
    if chunk == b"VP8X":
        low_w, high_w, low_h, high_h = struct.unpack_from("<HBHB", content, 24)
        return low_w + (high_w << 16) + 1, low_h + (high_h << 16) + 1
    if chunk == b"VP8L":
        (bits,) = struct.unpack_from("<I", content, 21)
        return (bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1
    if chunk == b"VP8 ":
        width_px, height_px = struct.unpack_from("<HH", content, 26)
        return width_px & 0x3FFF, height_px & 0x3FFF
    raise InputError("a WebP picture of an unknown kind, or damaged")


def _pnm_size(content: bytes) -> tuple[int, int]:
    found = _PNM_SIZE.match(content[:4096])
    if found is None:
        raise InputError("a PNM picture that declares no size: it is damaged or cut off")
    return int(found[1]), int(found[2])


_SIZE_READERS = {
    "PNG": png_size,
    "JPEG": jpeg_size,
    "BMP": _bmp_size,
    "TIFF": tiff_size,
    "WebP": _webp_size,
    "PNM": _pnm_size,
}

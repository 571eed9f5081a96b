"""Pages as PNG: grey pixels, with the resolution written into the file."""

import struct
import zlib

import numpy as np

from tagmetry.errors import InputError
from tagmetry.files.sheets.page import Page
from tagmetry.files.sheets.raster import page_as_pixels, page_size_px
from tagmetry.geometry.arrays import GreyPixels

_LEAST_DPI, _MOST_DPI = 10, 10_000
_MOST_PIXELS = 300_000_000
_PER_METRE = 1


def page_as_png(page: Page, dpi: float) -> bytes:
    """Return a page as a PNG picture.

    The file holds whole pixels per metre, so the page is drawn at just that resolution: 23622
    per metre for 600 dpi.

    Raises:
        InputError: The resolution cannot be used, or makes too large a picture.
    """
    if not _LEAST_DPI <= dpi <= _MOST_DPI:
        raise InputError(f"dpi must be {_LEAST_DPI} to {_MOST_DPI}, got {dpi:g}")
    pixels_per_m = round(dpi / 0.0254)
    height_px, width_px = page_size_px(page, pixels_per_m)
    if height_px * width_px > _MOST_PIXELS:
        raise InputError(
            f"{dpi:g} dpi make a picture of {width_px}x{height_px} pixels, the most are "
            f"{_MOST_PIXELS}; take fewer dpi, or a .pdf or .svg"
        )
    return _encoded(page_as_pixels(page, pixels_per_m), pixels_per_m)


def _encoded(pixels: GreyPixels, pixels_per_m: int) -> bytes:
    height_px, width_px = pixels.shape
    header = struct.pack(">IIBBBBB", width_px, height_px, 8, 0, 0, 0, 0)  # 8-bit grey
    resolution = struct.pack(">IIB", pixels_per_m, pixels_per_m, _PER_METRE)
    unfiltered = np.pad(pixels, ((0, 0), (1, 0)))  # each row says first that it has no filter
    parts = (
        _chunk(b"IHDR", header),
        _chunk(b"pHYs", resolution),
        _chunk(b"IDAT", zlib.compress(unfiltered.tobytes(), level=6)),
        _chunk(b"IEND", b""),
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def _chunk(kind: bytes, content: bytes) -> bytes:
    checksum = zlib.crc32(kind + content)
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", checksum)

"""The segments of a JPEG file: the size it declares, and whether it is all there.

Reference: ITU-T T.81, annex B.
"""

import re
from collections.abc import Iterator

from tagmetry.errors import InputError

_SOI, _EOI, _SOS = 0xD8, 0xD9, 0xDA
_SIZES = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}  # SOFn, without DHT, JPG and DAC
_ALONE = frozenset(range(0xD0, 0xD8)) | {0x01}  # RSTn and TEM carry no length
_MARKER = re.compile(rb"\xff+([^\x00\xff])", re.DOTALL)  # within a scan, 0 stuffs a plain 255


def jpeg_size(content: bytes) -> tuple[int, int]:
    """Return (width, height) in pixels, as the first start-of-frame segment declares them."""
    for marker, body in _segments(content):
        if marker in _SIZES and len(body) >= 5:
            return int.from_bytes(body[3:5], "big"), int.from_bytes(body[1:3], "big")
        if marker == _SOS:
            break
    raise InputError("a JPEG that declares no size: it is damaged or cut off")


def check_jpeg_whole(content: bytes) -> None:
    """Raise InputError where the end-of-image marker is missing: the file was cut off."""
    if not any(marker == _EOI for marker, _ in _segments(content)):
        raise InputError("a JPEG that is cut off (it has no end marker); copy it again")


def _segments(content: bytes) -> Iterator[tuple[int, bytes]]:
    """Give (marker, body) up to the end of the image; what follows a thumbnail is not mistaken."""
    position = 2
    while found := _MARKER.search(content, position):
        marker, position = found[1][0], found.end()
        if marker in _ALONE or marker == _SOI:
            continue
        length = int.from_bytes(content[position : position + 2], "big")
        yield marker, b"" if marker == _EOI else content[position + 2 : position + length]
        if marker == _EOI:
            return
        position += max(length, 2)

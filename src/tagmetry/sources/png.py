"""The chunks of a PNG file: the size it declares, and whether it is all there and undamaged.

Reference: ISO/IEC 15948 (PNG), clauses 5 and 11.
"""

import zlib
from collections.abc import Iterator

from tagmetry.errors import InputError

_SIGNATURE_BYTES = 8


def png_size(content: bytes) -> tuple[int, int]:
    """Return (width, height) in pixels, as the header chunk declares them."""
    if content[12:16] != b"IHDR" or len(content) < 24:
        raise InputError("a PNG without a whole header: it is damaged or cut off")
    return int.from_bytes(content[16:20], "big"), int.from_bytes(content[20:24], "big")


def check_png_whole(content: bytes) -> None:
    """Raise InputError where a chunk is cut off or damaged, or the end chunk is missing."""
    for name, body, checksum in _chunks(content):
        is_critical = not name[0] & 0x20  # lower case: a decoder may do without it
        if is_critical and zlib.crc32(body, zlib.crc32(name)) != checksum:
            raise InputError(f"a damaged PNG (wrong checksum of its {_printable(name)} chunk)")
        if name == b"IEND":
            return
    raise InputError("a PNG that is cut off (it has no end chunk); copy it again")


def _chunks(content: bytes) -> Iterator[tuple[bytes, memoryview, int]]:
    """Give (name, body, checksum) of the chunks that are all there."""
    view, position = memoryview(content), _SIGNATURE_BYTES
    while position + 12 <= len(content):
        end = position + 8 + int.from_bytes(view[position : position + 4], "big")
        if end + 4 > len(content):
            return
        checksum = int.from_bytes(view[end : end + 4], "big")
        yield bytes(view[position + 4 : position + 8]), view[position + 8 : end], checksum
        position = end + 4


def _printable(name: bytes) -> str:
    return name.decode("ascii", "backslashreplace")

"""The tags of a TIFF file's first picture: the size it declares, and its orientation.

Reference: TIFF 6.0, section 2; BigTIFF has the same tags with 64-bit offsets.
"""

import struct
from collections.abc import Iterator
from dataclasses import dataclass

from tagmetry.errors import InputError

_WIDTH, _HEIGHT, _ORIENTATION = 256, 257, 274
_MAX_TAGS = 65_535  # what the classic format has room for
_SHORT, _LONG, _LONG8 = 3, 4, 16
_VALUE_CODES = {_SHORT: "H", _LONG: "I", _LONG8: "Q"}


@dataclass(frozen=True)
class _Tag:
    """One number of the directory and where it stands in the file."""

    tag: int
    value: int
    at_byte: int
    code: str


def tiff_size(content: bytes) -> tuple[int, int]:
    """Return (width, height) in pixels, as the first directory declares them."""
    values = {tag.tag: tag.value for tag in _tags(content)}
    if _WIDTH not in values or _HEIGHT not in values:
        raise InputError("a TIFF that declares no size: it is damaged or cut off")
    return values[_WIDTH], values[_HEIGHT]


def without_orientation(content: bytes) -> bytes:
    """Return the file with its orientation set to 1: rows as they are stored.

    OpenCV turns TIFF pictures even where it is told to ignore the orientation.
    """
    for tag in _tags(content):
        if tag.tag == _ORIENTATION and tag.value != 1:
            upright = bytearray(content)
            struct.pack_into(tag.code, upright, tag.at_byte, 1)
            return bytes(upright)
    return content


def _tags(content: bytes) -> Iterator[_Tag]:
    """Give the single whole numbers of the first directory."""
    order = "<" if content[:2] == b"II" else ">"
    is_big = content[2:4] in (b"+\0", b"\0+")
    start, count_code, entry = (8, "Q", "HHQ") if is_big else (4, "H", "HHI")
    try:
        (position,) = struct.unpack_from(order + ("Q" if is_big else "I"), content, start)
        (count,) = struct.unpack_from(order + count_code, content, position)
        position += struct.calcsize(count_code)
        for _ in range(min(count, _MAX_TAGS)):
            yield from _tag(content, position, order, entry)
            position += 20 if is_big else 12
    except (struct.error, OverflowError) as error:
        raise InputError("a TIFF whose directory is damaged or cut off") from error


def _tag(content: bytes, position: int, order: str, entry: str) -> Iterator[_Tag]:
    tag, kind, count = struct.unpack_from(order + entry, content, position)
    if kind not in _VALUE_CODES or count != 1:
        return
    at_byte, code = position + struct.calcsize(order + entry), order + _VALUE_CODES[kind]
    yield _Tag(tag, struct.unpack_from(code, content, at_byte)[0], at_byte, code)

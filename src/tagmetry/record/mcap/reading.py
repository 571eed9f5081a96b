"""The entries of a recording, also of one that was cut off or damaged.

A piece whose check sum is wrong is passed over; where the file ends in the middle of a piece, all
that is whole is given. Nothing that a file says of its own sizes is believed beyond what is there.
"""

import io
import struct
import warnings
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import BinaryIO

from tagmetry.errors import InputError
from tagmetry.record.mcap.pieces import MAGIC, Entry, require_mcap

OnDamage = Callable[[str], None]
LARGEST_PIECE_BYTES = 256 * 2**20
CHUNK, DATA_END = 0x06, 0x0F
_CHANNEL, _MESSAGE = 0x04, 0x05
RECORD = struct.Struct("<BQ")
PIECE_HEAD = struct.Struct("<QQQII")
_MESSAGE_HEAD = struct.Struct("<HIQQ")


class DamagedRecordingWarning(UserWarning):
    """A part of a recording could not be read; the rest was."""


def warn_of_damage(text: str) -> None:
    """Warn that a part of a recording could not be read."""
    warnings.warn(text, DamagedRecordingWarning, stacklevel=2)


def read_entries(
    path: str | Path, *topics: str, on_damage: OnDamage = warn_of_damage
) -> Iterator[Entry]:
    """Give the entries of a recording in the order in which they were written.

    Args:
        path: The file.
        topics: Only these; all where none is named.
        on_damage: Told of what could not be read; by default a `DamagedRecordingWarning`.

    Raises:
        InputError: It cannot be read, or is no MCAP file.
        MissingExtraError: The part `arena` is not installed.
    """
    require_mcap("reading")
    try:
        with Path(path).open("rb") as file:
            if file.read(len(MAGIC)) != MAGIC:
                raise InputError(f"{path}: expected an MCAP file, found something else")
            for piece in _pieces(file, str(path), on_damage):
                for entry in entries_of(piece):
                    if not topics or entry.topic in topics:
                        yield entry
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error


def _pieces(file: BinaryIO, path: str, on_damage: OnDamage) -> Iterator[bytes]:
    """Give the content of every whole piece."""
    for kind, body in records_of(file):
        if kind == DATA_END:
            return
        if kind == CHUNK:
            content = unpacked(body)
            if content is None:
                on_damage(f"{path}: passed over a piece that is damaged")
            else:
                yield content
    on_damage(
        f"{path}: its end is missing, cut off or damaged; all whole pieces before it are read"
    )


def records_of(file: BinaryIO) -> Iterator[tuple[int, bytes]]:
    """Give kind and body of every record that is all there."""
    while len(head := file.read(RECORD.size)) == RECORD.size:
        kind, size_bytes = RECORD.unpack(head)
        body = file.read(size_bytes) if size_bytes <= LARGEST_PIECE_BYTES else b""
        if len(body) < size_bytes:
            return
        yield kind, body


def unpacked(chunk: bytes) -> bytes | None:
    """Return the records of a piece; None where it is damaged, or packed in a way we never do."""
    if len(chunk) < PIECE_HEAD.size:
        return None
    _, _, size_bytes, crc, name_bytes = PIECE_HEAD.unpack_from(chunk)
    name_end = PIECE_HEAD.size + name_bytes
    packed = chunk[name_end + 8 :]
    if size_bytes > LARGEST_PIECE_BYTES:
        return None
    content = _decompressed(chunk[PIECE_HEAD.size : name_end], packed, size_bytes)
    is_whole = content is not None and len(content) == size_bytes
    return content if is_whole and zlib.crc32(content or b"") == crc else None


def _decompressed(compression: bytes, packed: bytes, size_bytes: int) -> bytes | None:
    import zstandard

    if compression == b"":
        return packed
    if compression != b"zstd":
        return None
    try:
        with zstandard.ZstdDecompressor().stream_reader(io.BytesIO(packed)) as reader:
            return bytes(reader.read(size_bytes + 1))
    except zstandard.ZstdError:
        return None


def entries_of(piece: bytes) -> Iterator[Entry]:
    """Give the messages of a piece."""
    topics: dict[int, str] = {}
    for kind, body in records_of(io.BytesIO(piece)):
        if kind == _CHANNEL and len(body) >= 8:
            number, _, name_bytes = struct.unpack_from("<HHI", body)
            topics[number] = body[8 : 8 + name_bytes].decode("utf-8", "replace")
        elif kind == _MESSAGE and len(body) >= _MESSAGE_HEAD.size:
            number, _, logged_ns, stamped_ns = _MESSAGE_HEAD.unpack_from(body)
            content = body[_MESSAGE_HEAD.size :]
            yield Entry(topics.get(number, ""), logged_ns, stamped_ns, content)

"""An MCAP file, a piece at a time: each is whole by itself; a killed run loses only the last.

Every piece (a chunk in MCAP's words) repeats its schemas and channels and carries a check sum. The
index at the end is for quick viewers; a file without it is read as well.

Reference: the MCAP format specification, version 0.
"""

import os
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, BinaryIO

from tagmetry import __version__
from tagmetry.errors import MissingExtraError
from tagmetry.record.mcap.topics import schema_of

if TYPE_CHECKING:
    from mcap.records import ChunkIndex, McapRecord

MAGIC = b"\x89MCAP0\r\n"


@dataclass(frozen=True)
class Entry:
    """One message of a recording.

    Attributes:
        topic: What it is about.
        logged_ns: When it was recorded, nanoseconds since 1970.
        stamped_ns: Its own time, in the clock of its source.
        content: JSON text.
    """

    topic: str
    logged_ns: int
    stamped_ns: int
    content: bytes


class PieceWriter:
    """Writes entries, a piece at a time, to a file that is open for writing."""

    def __init__(self, file: BinaryIO) -> None:
        """Write the file's beginning.

        Raises:
            MissingExtraError: The part `arena` is not installed.
        """
        require_mcap("recording")
        from mcap.records import Header

        self._file = file
        self._topics: dict[str, int] = {}
        self._indices: list[ChunkIndex] = []
        self._counts: dict[int, int] = {}
        self._append(MAGIC + _bytes_of(Header("", f"tagmetry {__version__}")))

    def write(self, entries: Sequence[Entry]) -> None:
        """Write a piece; it is on the disk when this returns, or not at all after an OSError."""
        import zstandard
        from mcap.records import Chunk, ChunkIndex

        content = self._content(entries)
        packed = zstandard.ZstdCompressor(level=1).compress(content)
        times_ns = [entry.logged_ns for entry in entries]
        first_ns, last_ns = min(times_ns), max(times_ns)
        chunk = Chunk("zstd", packed, last_ns, first_ns, zlib.crc32(content), len(content))
        record, start = _bytes_of(chunk), self._file.tell()
        self._append(record)
        self._indices.append(
            ChunkIndex(
                len(record), start, "zstd", len(packed), last_ns, 0, {}, first_ns, len(content)
            )
        )

    def finish(self) -> None:
        """Write the index and the file's end."""
        from mcap.records import DataEnd, Footer

        self._append(_bytes_of(DataEnd(0)))
        start = self._file.tell()
        summary = _bytes_of(*self._schemas_and_channels(), self._statistics(), *self._indices)
        self._append(summary + _bytes_of(Footer(start, 0, 0)) + MAGIC)

    def _content(self, entries: Sequence[Entry]) -> bytes:
        """Return what a piece holds, before it is packed."""
        from mcap.records import Message

        numbers = [self._number(entry.topic) for entry in entries]
        messages = []
        for number, entry in zip(numbers, entries, strict=True):
            count = self._counts[number] = self._counts.get(number, 0) + 1
            times_ns = entry.logged_ns, entry.stamped_ns
            messages.append(Message(number, times_ns[0], entry.content, times_ns[1], count))
        return _bytes_of(*self._schemas_and_channels(), *messages)

    def _number(self, topic: str) -> int:
        return self._topics.setdefault(topic, len(self._topics) + 1)

    def _schemas_and_channels(self) -> list["McapRecord"]:
        from mcap.records import Channel, Schema

        records: list[McapRecord] = []
        for topic, number in self._topics.items():
            schema = schema_of(topic)
            records.append(Schema(number, schema.text, "jsonschema", schema.name))
            records.append(Channel(number, topic, "json", {}, number))
        return records

    def _statistics(self) -> "McapRecord":
        from mcap.records import Statistics

        starts_ns = [index.message_start_time for index in self._indices]
        ends_ns = [index.message_end_time for index in self._indices]
        return Statistics(
            attachment_count=0,
            channel_count=len(self._topics),
            channel_message_counts=self._counts,
            chunk_count=len(self._indices),
            message_count=sum(self._counts.values()),
            message_end_time=max(ends_ns, default=0),
            message_start_time=min(starts_ns, default=0),
            metadata_count=0,
            schema_count=len(self._topics),
        )

    def _append(self, content: bytes) -> None:
        """Write and force out all of it, or, where a disk is full, nothing."""
        start = self._file.tell()
        try:
            self._file.write(content)
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError:
            self._file.seek(start)
            self._file.truncate()
            raise


def require_mcap(purpose: str) -> None:
    """Raise MissingExtraError where MCAP files cannot be handled."""
    try:
        import mcap.records  # noqa: F401
        import zstandard  # noqa: F401
    except ImportError as error:
        raise MissingExtraError(f"{purpose} MCAP files", "arena") from error


def _bytes_of(*records: "McapRecord") -> bytes:
    from mcap.data_stream import RecordBuilder

    builder = RecordBuilder()
    for record in records:
        record.write(builder)
    return bytes(builder.end())  # type: ignore[no-untyped-call]

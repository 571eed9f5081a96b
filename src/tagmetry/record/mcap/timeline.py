"""A recording by its time line: what was the newest at a moment, without reading all of it.

The time is that of the recording, from its first piece on: a clock of a source that begins anew
within it does not matter. Only the pieces' heads are read to know where to look.
"""

import struct
from bisect import bisect_right
from collections import OrderedDict
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path
from typing import BinaryIO

from tagmetry.errors import InputError
from tagmetry.record.mcap.pieces import MAGIC, Entry, require_mcap
from tagmetry.record.mcap.reading import (
    CHUNK,
    DATA_END,
    RECORD,
    entries_of,
    records_of,
    unpacked,
)

_TIMES = struct.Struct("<QQ")  # of a piece's first and last message
_KEPT = 4  # pieces that were just read
_MOST_BACK = 40  # pieces to look back through: ten seconds


@dataclass(frozen=True)
class _Piece:
    """Where a piece lies, and when it begins and ends."""

    at: int
    first_ns: int
    last_ns: int


class Timeline:
    """The pieces of a recording; to be used from one thread at a time."""

    def __init__(self, path: str | Path) -> None:
        """Read where the pieces are.

        Raises:
            InputError: It cannot be read, is no MCAP file, or has no piece.
            MissingExtraError: The part `arena` is not installed.
        """
        require_mcap("reading")
        self._path = Path(path)
        with self._opened() as file:
            self._pieces = list(_pieces(file, self._path.stat().st_size))
        if not self._pieces:
            raise InputError(f"{path}: nothing was recorded in it")
        self._first_ns = self._pieces[0].first_ns
        self._begins_ns = list(accumulate((one.first_ns for one in self._pieces), max))
        self._read: OrderedDict[int, list[Entry]] = OrderedDict()

    @property
    def length_s(self) -> float:
        """From the first message to the last."""
        return 1e-9 * max(max(one.last_ns for one in self._pieces) - self._first_ns, 0)

    def seconds(self, entry: Entry) -> float:
        """Return when an entry was recorded, since the recording began."""
        return 1e-9 * (entry.logged_ns - self._first_ns)

    def newest(self, topic: str, at_s: float) -> Entry | None:
        """Return a topic's last entry up to a moment; None where there was none shortly before.

        Args:
            topic: Of the entry.
            at_s: Since the recording began.

        Raises:
            InputError: The file cannot be read any more.
        """
        at_ns = self._first_ns + round(1e9 * min(max(at_s, 0.0), self.length_s))
        last = bisect_right(self._begins_ns, at_ns) - 1
        for number in range(last, max(last - _MOST_BACK, -1), -1):
            for entry in reversed(self._entries(number)):
                if entry.topic == topic and entry.logged_ns <= at_ns:
                    return entry
        return None

    def _entries(self, number: int) -> list[Entry]:
        """Return what a piece holds; nothing where it is damaged."""
        if number not in self._read:
            self._read[number] = self._read_piece(self._pieces[number])
            if len(self._read) > _KEPT:
                self._read.popitem(last=False)
        return self._read[number]

    def _read_piece(self, piece: _Piece) -> list[Entry]:
        with self._opened() as file:
            file.seek(piece.at)
            _, body = next(records_of(file), (0, b""))
        content = unpacked(body)
        return [] if content is None else list(entries_of(content))

    def _opened(self) -> BinaryIO:
        try:
            file = self._path.open("rb")
            if file.read(len(MAGIC)) == MAGIC:
                return file
            file.close()
        except OSError as error:
            raise InputError(f"{self._path}: {error.strerror or error}") from error
        raise InputError(f"{self._path}: expected an MCAP file, found something else")


def _pieces(file: BinaryIO, size_bytes: int) -> Iterator[_Piece]:
    """Give all pieces that are whole."""
    at = file.tell()
    while len(head := file.read(RECORD.size)) == RECORD.size:
        kind, body_bytes = RECORD.unpack(head)
        end = at + RECORD.size + body_bytes
        if kind == DATA_END or end > size_bytes:
            return
        if kind == CHUNK and body_bytes >= _TIMES.size:
            yield _Piece(at, *_TIMES.unpack(file.read(_TIMES.size)))
        at = file.seek(end)

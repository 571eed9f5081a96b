"""Records a run into one file, in a thread of its own: a slow disk delays nobody.

What comes in faster than it can be written is dropped, the oldest first, and counted. A piece is
written at least every quarter of a second, so that a run that is killed loses no more than that and
what was just being written.
"""

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from pathlib import Path
from types import TracebackType
from typing import BinaryIO, Self, TypeVar

from tagmetry.arena import WorldState
from tagmetry.camera import Image
from tagmetry.errors import InputError
from tagmetry.files.atomic import refusing
from tagmetry.record.jsonl import format_line
from tagmetry.record.mcap.images import image_text
from tagmetry.record.mcap.packets import PacketRecord, packet_text
from tagmetry.record.mcap.pieces import Entry, PieceWriter, require_mcap
from tagmetry.record.mcap.plain_json import json_text
from tagmetry.record.mcap.states import state_text
from tagmetry.record.mcap.topics import DETECTIONS, IMAGES, PACKETS, STATES
from tagmetry.record.result import ImageResult

PIECE_S = 0.25
_PIECE_BYTES = 8 * 2**20
_MOST_IMAGES = 30
_MOST_MESSAGES = 50_000
_WAKE_S = 0.1

T = TypeVar("T")


class Recorder:
    """Takes images, detections, states, packets and notes; to be used in a with-block.

    All calls return at once. `failure` says why nothing is written any more, such as a full disk;
    the run goes on, and what was written until then stays whole.
    """

    def __init__(
        self, path: str | Path, *, jpeg_quality: int | None = 90, may_drop: bool = True
    ) -> None:
        """Choose the file, which is replaced.

        Args:
            path: Where to; ends in `.mcap`.
            jpeg_quality: Of images, 1 to 100; None for lossless PNG, which replays bit by bit.
            may_drop: Drop what the disk is too slow for; else the calls wait, as is right for
                images that come from a file.

        Raises:
            InputError: The suffix or the quality is another one.
            MissingExtraError: The part `arena` is not installed.
        """
        if Path(path).suffix.lower() != ".mcap":
            raise InputError(f"{path}: expected a recording's name that ends in .mcap")
        if jpeg_quality is not None and not 1 <= jpeg_quality <= 100:
            raise InputError(f"expected a JPEG quality, 1 to 100, got {jpeg_quality}")
        require_mcap("recording")
        self._path, self._jpeg_quality, self._may_drop = Path(path), jpeg_quality, may_drop
        self._images: deque[tuple[int, Image]] = deque(maxlen=_MOST_IMAGES)
        self._messages: deque[Callable[[], Entry]] = deque(maxlen=_MOST_MESSAGES)
        self._dropped_count = 0
        self._failure: str | None = None
        self._changed = threading.Condition()
        self._is_closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)

    def __enter__(self) -> Self:
        with refusing(self._path):
            self._file: BinaryIO = self._path.open("wb")
            try:
                self._pieces = PieceWriter(self._file)
            except OSError:
                self._file.close()
                raise
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Write what still waits.

        Raises:
            InputError: Something could not be written, now or before, and no error is on its way.
        """
        self._is_closing.set()
        self._thread.join()
        self._file.close()
        if self._failure is not None and kind is None:
            raise InputError(self._failure)

    @property
    def dropped_count(self) -> int:
        """How many were not recorded: the disk was too slow, or JSON cannot hold them."""
        return self._dropped_count

    @property
    def failure(self) -> str | None:
        """Why nothing is written any more; None while all is well."""
        return self._failure

    def image(self, image: Image) -> None:
        """Record an image."""
        self._put(self._images, (time.time_ns(), image))

    def detections(self, result: ImageResult) -> None:
        """Record what was measured in an image."""
        self._take(DETECTIONS, result.time_s, lambda: format_line(result).encode())

    def state(self, state: WorldState) -> None:
        """Record where all robots are."""
        self._take(STATES, state.time_s, lambda: state_text(state))

    def packet(self, packet: PacketRecord) -> None:
        """Record a packet."""
        self._take(PACKETS, packet.time_s, lambda: packet_text(packet))

    def note(self, topic: str, time_s: float, note: Mapping[str, object]) -> None:
        """Record anything else, by name, on a topic of its own such as `/latency`."""
        self._take(topic, time_s, lambda: json_text(note))

    def line(self, topic: str, time_s: float, text: Callable[[], bytes]) -> None:
        """Record JSON that is made in the recorder's thread, on a topic of its own."""
        self._take(topic, time_s, text)

    def _take(self, topic: str, time_s: float, text: Callable[[], bytes]) -> None:
        """Remember what is to be written; its text is made in the recorder's thread."""
        logged_ns, stamped_ns = time.time_ns(), _nanoseconds(time_s)
        self._put(self._messages, lambda: Entry(topic, logged_ns, stamped_ns, text()))

    def _put(self, queue: deque[T], item: T) -> None:
        """Append to a queue; where it is full, wait for room or drop the oldest."""
        with self._changed:
            while not self._may_drop and len(queue) == queue.maxlen and self._failure is None:
                self._changed.wait(_WAKE_S)
            self._dropped_count += len(queue) == queue.maxlen
            queue.append(item)

    def _run(self) -> None:
        try:
            while not self._is_closing.is_set():
                self._write(self._gathered())
            while self._images or self._messages:
                self._write(self._gathered())
            self._pieces.finish()
        except (OSError, InputError) as error:
            reason = error.strerror if isinstance(error, OSError) and error.strerror else error
            self._failure = f"recording to {self._path} ended: {reason}"

    def _write(self, entries: list[Entry]) -> None:
        if entries:
            self._pieces.write(sorted(entries, key=lambda entry: entry.logged_ns))

    def _gathered(self) -> list[Entry]:
        """Return the entries of one piece, when its time is over or it is large."""
        entries: list[Entry] = []
        size_bytes, end_s = 0, time.monotonic() + PIECE_S
        while time.monotonic() < end_s and size_bytes < _PIECE_BYTES:
            entry = self._next()
            if entry is not None:
                entries.append(entry)
                size_bytes += len(entry.content)
            elif self._is_closing.wait(0.005):
                break
        return entries

    def _next(self) -> Entry | None:
        """Return what waits next; messages first, they are quick."""
        with self._changed:
            make = self._messages.popleft() if self._messages else None
            logged = self._images.popleft() if make is None and self._images else None
            self._changed.notify_all()
        if make is not None:
            return self._made(make)
        if logged is None:
            return None
        logged_ns, image = logged
        content = image_text(image, self._jpeg_quality)
        return Entry(IMAGES, logged_ns, _nanoseconds(image.time_s), content)

    def _made(self, make: Callable[[], Entry]) -> Entry | None:
        try:
            return make()
        except (InputError, TypeError):
            with self._changed:
                self._dropped_count += 1
            return None


def _nanoseconds(time_s: float) -> int:
    return min(max(round(1e9 * time_s), 0), 2**64 - 1)

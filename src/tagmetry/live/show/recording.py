"""A recording that people start and stop while the arena runs."""

import threading
from contextlib import ExitStack
from datetime import datetime
from pathlib import Path

from tagmetry.arena import WorldState
from tagmetry.camera import Image
from tagmetry.errors import InputError
from tagmetry.live.messages import Picture, World
from tagmetry.live.messages.wire import format_message
from tagmetry.record.mcap import Recorder

WORLD, PICTURE = "/live/World", "/live/Picture"  # topics of what pages were told


class Recordings:
    """Writes one file at a time into a folder.

    Attributes:
        folder: Where they lie.
        name: Of the file that is being written; None while none is.
    """

    def __init__(self, folder: Path) -> None:
        self.name: str | None = None
        self.folder = folder
        self._ended = ""
        self._recorder: Recorder | None = None
        self._open = ExitStack()
        self._closing: threading.Thread | None = None

    @property
    def failure(self) -> str:
        """Why the open file, or the last one, ended early; empty while all is well."""
        recorder = self._recorder
        return (recorder.failure if recorder is not None else None) or self._ended

    @property
    def dropped_count(self) -> int:
        """How many messages of the open file could not be written in time."""
        recorder = self._recorder
        return 0 if recorder is None else recorder.dropped_count

    def start(self) -> None:
        """Begin a file that is named after the clock; nothing changes while one is written.

        Raises:
            InputError: It cannot be written.
        """
        if self._recorder is not None:
            return
        self.folder.mkdir(parents=True, exist_ok=True)
        name = f"{datetime.now().astimezone():%Y-%m-%d-%H-%M-%S-%f}.mcap"
        self._recorder = self._open.enter_context(Recorder(self.folder / name))
        self.name, self._ended = name, ""

    def stop(self) -> None:
        """End the file; what still waits is written in a thread of its own."""
        recorder, self._recorder, self.name = self._recorder, None, None
        if recorder is not None:
            still_open = self._open.pop_all()
            self._closing = threading.Thread(target=self._end, args=(still_open,), name="recorded")
            self._closing.start()

    def close(self) -> None:
        """End the file and wait until it is whole."""
        self.stop()
        if self._closing is not None:
            self._closing.join()

    def state(self, world: WorldState) -> None:
        """Record where all robots are, if a file is open."""
        if self._recorder is not None:
            self._recorder.state(world)

    def image(self, image: Image) -> None:
        """Record a picture, if a file is open."""
        recorder = self._recorder
        if recorder is not None:
            recorder.image(image)

    def told(self, message: World | Picture) -> None:
        """Record what pages are told, as it is told, if a file is open."""
        recorder, topic = self._recorder, f"/live/{type(message).__name__}"
        if recorder is not None:
            recorder.line(topic, message.time_s, lambda: format_message(message).encode())

    def _end(self, still_open: ExitStack) -> None:
        try:
            still_open.close()
        except InputError as error:
            self._ended = str(error)

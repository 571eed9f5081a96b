"""The arena as the server's program knows it: it runs in another one, behind a pipe."""

from pathlib import Path
from typing import BinaryIO

from tagmetry.live.beside.parcels import Parcel, write_parcel
from tagmetry.live.beside.words import ASKED, LEFT, VIEWERS, Begin
from tagmetry.live.messages import Asked
from tagmetry.live.messages.wire import format_message


class FarRunner:
    """Passes on what pages ask; to be used from the server's loop alone.

    Attributes:
        scenarios: Names of what can be chosen.
        recordings: Folder of what was recorded; may not be there yet.
        recording: Name of the file that is being written, as the arena said last.
    """

    def __init__(self, begin: Begin, pipe: BinaryIO) -> None:
        self.scenarios, self.recordings = begin.scenarios, Path(begin.recordings)
        self.recording: str | None = None
        self._pipe, self._viewers = pipe, 0

    @property
    def viewers(self) -> int:
        """How many pages are connected."""
        return self._viewers

    @viewers.setter
    def viewers(self, count: int) -> None:
        self._viewers = count
        self._send(Parcel(VIEWERS, {"count": count}))

    def ask(self, page: int, asked: Asked) -> None:
        """Pass on what a page asks for; a refusal comes back as a message."""
        self._send(Parcel(ASKED, {"page": page}, format_message(asked).encode()))

    def leave(self, page: int) -> None:
        """Pass on that a page is gone."""
        self._send(Parcel(LEFT, {"page": page}))

    def _send(self, parcel: Parcel) -> None:
        try:
            write_parcel(self._pipe, parcel)
        except (OSError, ValueError):
            return  # the arena is gone, and this program ends

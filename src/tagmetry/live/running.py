"""What the server needs of the arena that runs behind it."""

from pathlib import Path
from typing import Protocol

from tagmetry.live.messages import Asked


class Runner(Protocol):
    """Something that runs and can be asked.

    Attributes:
        viewers: How many pages are connected, as the server says.
    """

    viewers: int

    @property
    def scenarios(self) -> tuple[str, ...]:
        """Names of what can be chosen."""

    @property
    def recordings(self) -> Path:
        """Folder of what was recorded; may not be there yet."""

    @property
    def recording(self) -> str | None:
        """Name of the file that is being written; None while none is."""

    def ask(self, page: int, asked: Asked) -> None:
        """Take what an operator's page asks for.

        Raises:
            InputError: Too much waits already.
        """

    def leave(self, page: int) -> None:
        """Take that a page is gone."""

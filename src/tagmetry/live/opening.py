"""The live page as a whole: the arena's thread, the door and the server, ready to run."""

import socket
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import uvicorn

from tagmetry.live.rooms.every import Furniture, opened_rooms
from tagmetry.live.server.access import Access
from tagmetry.live.server.hub import Hub
from tagmetry.live.server.serving import listening, server
from tagmetry.live.show.runner import LiveRunner
from tagmetry.live.show.seeing import EyeKind

_STARTING_S = 0.01  # between two looks
_USUAL = Furniture()


@dataclass(frozen=True, eq=False)
class LivePage:
    """A page that can be served.

    Attributes:
        url: Where it is.
        token: That makes an operator of a viewer; a secret.
        runner: The arena, running.
        server: Serves it, once it is run.
        socket: That the server listens at.
    """

    url: str
    token: str
    runner: LiveRunner
    server: uvicorn.Server
    socket: socket.socket

    def serve(self) -> None:
        """Serve until the server is told to end, or by Ctrl-C."""
        self.server.run(sockets=[self.socket])

    @contextmanager
    def served_beside(self) -> Iterator[None]:
        """Serve in a thread of its own until the block ends."""
        thread = threading.Thread(target=self.serve, name="live server")
        thread.start()
        while thread.is_alive() and not self.server.started:
            time.sleep(_STARTING_S)
        try:
            yield
        finally:
            self.server.should_exit = True
            thread.join()


@contextmanager
def opened_page(  # noqa: PLR0913 (each is an option of the command)
    scenario: str,
    robots: int,
    address: str,
    port: int,
    recordings: Path,
    *,
    controllers: Sequence[Path] = (),
    pictures: bool = True,
    eye: EyeKind = "corners",
    furniture: Furniture = _USUAL,
) -> Iterator[LivePage]:
    """Give a page whose arena runs; it ends with the block.

    Args:
        scenario: Name of a ready-made one, or of a controller's file.
        robots: How many.
        address: To listen at: an interface of this computer.
        port: To listen at; 0 for a free one.
        recordings: Folder for recordings.
        controllers: Files of users that can be chosen.
        pictures: Show what the camera sees.
        eye: What is measured: corners with noise, or pictures by the detector.
        furniture: What the other rooms work with.

    Raises:
        InputError: One of them cannot be used.
    """
    with listening(address, port) as opened:
        port = opened.getsockname()[1]
        access, hub = Access(address, port), Hub()
        with (
            LiveRunner(
                scenario,
                robots,
                recordings,
                hub.give,
                controllers=controllers,
                pictures=pictures,
                eye=eye,
            ) as runner,
            opened_rooms(hub.give, runner, furniture) as rooms,
        ):
            host = f"[{address}]" if ":" in address else address
            url = f"http://{host}:{port}/"
            yield LivePage(url, access.token, runner, server(access, hub, runner, rooms), opened)

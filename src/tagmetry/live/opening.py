"""The live page as a whole: the arena's thread in this program, the server in its own."""

from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

from tagmetry.live.beside.process import ServerProcess
from tagmetry.live.beside.words import Begin
from tagmetry.live.rooms.every import Furniture
from tagmetry.live.server.access import Access
from tagmetry.live.server.serving import listening
from tagmetry.live.show.runner import LiveRunner
from tagmetry.live.show.seeing import EyeKind

_USUAL = Furniture()


@dataclass(frozen=True, eq=False)
class LivePage:
    """A page that is served.

    Attributes:
        url: Where it is.
        token: That makes an operator of a viewer; a secret.
        runner: The arena, running in this program.
        server: Serves it, a program of its own.
    """

    url: str
    token: str
    runner: LiveRunner
    server: ServerProcess

    def serve(self) -> None:
        """Wait until the server has ended, or for Ctrl-C."""
        self.server.wait()


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
    """Give a page whose arena runs, served by a program of its own; both end with the block.

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
    with listening(address, port) as opened:  # tries it; the server's program listens itself
        port = opened.getsockname()[1]
    token = Access(address, port).token
    with (
        closing(ServerProcess()) as server,
        LiveRunner(
            scenario,
            robots,
            recordings,
            server.give,
            controllers=controllers,
            pictures=pictures,
            eye=eye,
        ) as runner,
    ):
        begin = Begin(address, port, token, runner.scenarios, recordings, furniture)
        server.begin(begin, runner)
        host = f"[{address}]" if ":" in address else address
        yield LivePage(f"http://{host}:{port}/", token, runner, server)

"""The live page as a whole: the arena's thread in this program, the server in its own."""

from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass

from tagmetry.live.beside.process import ServerProcess
from tagmetry.live.beside.words import Begin
from tagmetry.live.rooms.every import Furniture
from tagmetry.live.server.access import Access
from tagmetry.live.server.serving import listening
from tagmetry.live.show.programme import Programme
from tagmetry.live.show.runner import LiveRunner

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
def opened_page(
    programme: Programme, address: str, port: int, furniture: Furniture = _USUAL
) -> Iterator[LivePage]:
    """Give a page whose arena runs, served by a program of its own; both end with the block.

    Args:
        programme: What the arena shows.
        address: To listen at: an interface of this computer.
        port: To listen at; 0 for a free one.
        furniture: What the other rooms work with.

    Raises:
        InputError: One of them cannot be used.
    """
    with listening(address, port) as opened:  # tries it; the server's program listens itself
        port = opened.getsockname()[1]
    token = Access(address, port).token
    with closing(ServerProcess()) as server, LiveRunner(programme, server.give) as runner:
        begin = Begin(address, port, token, runner.scenarios, programme.recordings, furniture)
        server.begin(begin, runner)
        host = f"[{address}]" if ":" in address else address
        yield LivePage(f"http://{host}:{port}/", token, runner, server)

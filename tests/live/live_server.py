"""A server on a free port with a runner that only remembers, and clients to try it with."""

import http.client
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

import uvicorn
from websockets.sync.client import ClientConnection, connect

from tagmetry.live.messages import Asked
from tagmetry.live.rooms.every import Furniture, opened_rooms
from tagmetry.live.rooms.room import Room
from tagmetry.live.server.access import Access
from tagmetry.live.server.hub import Hub
from tagmetry.live.server.serving import listening, server


@dataclass
class Remembering:
    """A runner that does nothing."""

    recordings: Path = Path("nowhere")
    recording: str | None = None
    viewers: int = 0
    asked: list[tuple[int, Asked]] = field(default_factory=list)
    left: list[int] = field(default_factory=list)

    @property
    def scenarios(self) -> tuple[str, ...]:
        return ("leader_follower",)

    def ask(self, page: int, asked: Asked) -> None:
        self.asked.append((page, asked))

    def leave(self, page: int) -> None:
        self.left.append(page)


@dataclass(frozen=True)
class Served:
    """A server that runs."""

    port: int
    access: Access
    hub: Hub
    runner: Remembering

    @property
    def host(self) -> str:
        return f"127.0.0.1:{self.port}"

    @property
    def origin(self) -> str:
        return f"http://{self.host}"

    def ask(
        self, method: str, path: str, body: bytes | None = None, **headers: str
    ) -> tuple[int, dict[str, str], bytes]:
        """Return status, headers and body; a header None leaves out what is usual."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        try:
            connection.putrequest(method, path, skip_host=True)
            usual = {"Host": self.host, "Origin": self.origin} if method == "POST" else {}
            usual = usual or {"Host": self.host}
            length = {} if body is None else {"Content-Length": str(len(body))}
            for name, value in {**usual, **length, **headers}.items():
                if value is not None:
                    connection.putheader(name, value)
            connection.endheaders(body)
            answer = connection.getresponse()
            told = {name.lower(): value for name, value in answer.getheaders()}
            return answer.status, told, answer.read()
        finally:
            connection.close()

    def session(self) -> str:
        """Return the cookie of an operator."""
        status, headers, _ = self.ask("POST", "/sign-in", self.access.token.encode())
        assert status == 204
        return headers["set-cookie"].split(";")[0]

    def page(self, cookie: str | None = None, **more: object) -> ClientConnection:
        """Return a page's socket."""
        headers = {"Cookie": cookie} if cookie else {}
        address = f"ws://{self.host}/live"
        return connect(address, origin=self.origin, additional_headers=headers, proxy=None, **more)


@contextmanager
def served(
    address: str = "127.0.0.1", port: int = 0, furniture: Furniture | None = None
) -> Iterator[Served]:
    """Give a server that runs in a thread; its rooms do something where they are furnished."""
    hub, runner = Hub(), Remembering()
    with (
        listening("127.0.0.1", port) as opened,
        opened_rooms(hub.give, runner, furniture or Furniture()) as rooms,
    ):
        port = opened.getsockname()[1]
        access = Access(address, port)
        quiet = [without_deeds(room, runner) for room in rooms]
        own = server(access, hub, runner, rooms if furniture else quiet)
        with running(own, opened):
            yield Served(port, access, hub, runner)


def without_deeds(room: Room, runner: Remembering) -> Room:
    """Return a room that only remembers what it is told, as the runner does."""

    def take(asked: Asked) -> None:
        runner.ask(0, asked)

    return replace(room, takers=dict.fromkeys(room.takers, take))


@contextmanager
def running(own: uvicorn.Server, opened: object) -> Iterator[None]:
    """Run a server in a thread until the block ends."""
    thread = threading.Thread(target=own.run, kwargs={"sockets": [opened]})
    thread.start()
    try:
        end_s = time.monotonic() + 20
        while not own.started:
            assert time.monotonic() < end_s, "the server did not start"
            assert thread.is_alive(), "the server ended at once"
            time.sleep(0.01)
        yield
    finally:
        own.should_exit = True
        thread.join(20)
        assert not thread.is_alive()


def drained(page: ClientConnection) -> None:
    """Take all that a page is told until its socket is closed, which raises."""
    while True:
        page.recv(timeout=5)


def heard(page: ClientConnection, part: str) -> str:
    """Return the next text that holds a part; the server tells other things between."""
    while True:
        told = page.recv(timeout=5)
        if isinstance(told, str) and part in told:
            return told


def eventually(is_so: object, seconds: float = 5.0) -> None:
    """Wait until something becomes true."""
    end_s = time.monotonic() + seconds
    while not is_so():
        assert time.monotonic() < end_s, "it never came"
        time.sleep(0.01)

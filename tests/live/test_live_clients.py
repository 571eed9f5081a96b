"""Slow, half-open and many pages: nobody waits for them, and healthy ones get the newest."""

import json
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack

import pytest
from live_server import Served, drained, eventually, heard, served
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection

from tagmetry.live.messages import Picture, Seen, World
from tagmetry.live.messages.wire import format_message, split_picture
from tagmetry.live.server import hub as hub_module

SLOW, HALF_OPEN, HEALTHY = 20, 20, 10
MESSAGES, STEP_S = 60, 0.02


@pytest.fixture
def live() -> Iterator[Served]:
    with served() as own:
        yield own


def picture(number: int) -> Picture:
    """Return one of 200 kB, which no buffer of a slow client holds many of."""
    return Picture(float(number), 0.0, 960, 540, (), 200_000 * b"A")


def number_of(told: str | bytes) -> float | None:
    """Return a picture's number; None for anything else."""
    return json.loads(split_picture(told)[0])["time_s"] if isinstance(told, bytes) else None


def next_number(page: ClientConnection, timeout_s: float = 5.0) -> float:
    """Return the next picture's number."""
    while (number := number_of(page.recv(timeout=timeout_s))) is None:
        pass
    return number


def half_open(live: Served) -> socket.socket:
    """Return a socket that was upgraded and is never read."""
    opened = socket.create_connection(("127.0.0.1", live.port))
    opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    lines = [
        "GET /live HTTP/1.1", f"Host: {live.host}", f"Origin: {live.origin}", "Upgrade: websocket",
        "Connection: Upgrade", "Sec-WebSocket-Version: 13",
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==", "", "",
    ]  # fmt: skip
    opened.sendall("\r\n".join(lines).encode())
    return opened


class Healthy(threading.Thread):
    """A page that takes everything, and notes which pictures it got and how late."""

    def __init__(self, live: Served) -> None:
        super().__init__(daemon=True)
        self._live = live
        self.late_s: list[float] = []
        self.last = -1.0

    def run(self) -> None:
        with self._live.page(max_size=None) as page:
            while self.last < MESSAGES - 1:
                told = page.recv(timeout=10)
                told = json.loads(told) if isinstance(told, str) else {}
                if told.get("type") == "World":
                    self.last = told["time_s"]
                    self.late_s.append(time.monotonic() - float(told["why"]))


def test_slow_pages_delay_neither_the_arena_nor_the_healthy(live: Served) -> None:
    with ExitStack() as stack:
        for _ in range(HALF_OPEN + SLOW):
            stack.enter_context(half_open(live))
        healthy = [Healthy(live) for _ in range(HEALTHY)]
        for one in healthy:
            one.start()
        eventually(lambda: live.hub.pages == HALF_OPEN + SLOW + HEALTHY)
        gave_s = []
        for number in range(MESSAGES):
            began_s = time.thread_time()
            live.hub.give(picture(number))
            live.hub.give(World(float(number), (), (), False, str(time.monotonic())))
            gave_s.append(time.thread_time() - began_s)
            time.sleep(STEP_S)
        for one in healthy:
            one.join(20)
    assert [one.last for one in healthy] == [MESSAGES - 1.0] * HEALTHY
    assert max(gave_s) < 0.02  # processor time of the arena's thread, whatever pages do
    late_s = sorted(late for one in healthy for late in one.late_s)
    assert late_s[len(late_s) // 2] < 1.0


def test_a_slow_page_finds_the_newest_and_nothing_older(live: Served) -> None:
    with live.page(max_size=None, max_queue=1) as page:
        assert "Welcome" in page.recv(timeout=5)
        for number in range(200):
            live.hub.give(picture(number))
            time.sleep(0.001)
        numbers = []
        while not numbers or numbers[-1] < 199:
            numbers.append(next_number(page))
    assert numbers == sorted(numbers)
    assert len(numbers) < 200  # what it had no time for is gone


def test_a_page_that_says_what_it_shows_gets_one_picture_at_a_time(live: Served) -> None:
    with live.page(max_size=None) as page:
        for number in range(3):
            live.hub.give(picture(number))
            assert next_number(page) == number  # it has said nothing yet and gets all
        page.send(format_message(Seen(time.monotonic())))
        eventually(lambda: live.hub.delays.quantile_s(0.5) is not None)
        for number in range(10, 20):
            live.hub.give(picture(number))
            time.sleep(0.005)
        first = next_number(page)
        with pytest.raises(TimeoutError):
            next_number(page, timeout_s=0.2)
        page.send(format_message(Seen(time.monotonic())))
        assert next_number(page) == 19.0  # the newest, whatever came meanwhile
    assert first < 19


def test_pages_are_told_how_messages_reach_them(live: Served) -> None:
    with live.page(max_size=None, max_queue=1) as page:
        page.send(format_message(Seen(time.monotonic() - 0.25)))
        page.send(format_message(Seen(time.monotonic() + 9.0)))  # of a clock that is none
        for number in range(100):
            live.hub.give(picture(number))
            time.sleep(0.002)
        told = {}
        while not told.get("missed_hz"):
            text = page.recv(timeout=5)
            told = json.loads(text) if isinstance(text, str) and "Delivery" in text else told
    assert told["pages"] == 1
    assert told["told_hz"] > 0
    assert 0.25 <= told["shown_median_s"] == told["shown_p99_s"] < 1.0


def test_a_page_that_takes_nothing_for_long_is_cut_off(
    live: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tagmetry.live.server.pages._PATIENCE_S", 0.2)
    with half_open(live):
        eventually(lambda: live.hub.pages == 1)
        end_s = time.monotonic() + 10
        while live.hub.pages:
            assert time.monotonic() < end_s
            live.hub.give(picture(1))
            time.sleep(0.02)


def test_one_page_too_many_is_told_so(live: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hub_module, "MOST_PAGES", 2)
    with live.page() as one, live.page() as two, live.page() as three:
        with pytest.raises(ConnectionClosed, match="connected already"):
            drained(three)
        assert "Welcome" in one.recv(timeout=5)
        assert "Welcome" in two.recv(timeout=5)


def test_a_new_page_is_told_the_newest_at_once(live: Served) -> None:
    live.hub.give(World(7.0, (), ("robot 1",), True, "x"))
    time.sleep(0.1)
    with live.page() as page:
        assert "Welcome" in page.recv(timeout=5)
        assert json.loads(heard(page, "World"))["time_s"] == 7.0

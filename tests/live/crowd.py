"""A thousand pages in a process of their own: healthy, slow and half-open; prints what they saw.

    python tests/live/crowd.py PORT --healthy 900 --slow 50 --half-open 50 --seconds 15

A healthy page reads all that comes; a slow one a little once a second; a half-open one never.
Pictures say when they were taken in the clock of this computer, which this process shares.
"""

import argparse
import asyncio
import json
import re
import socket
import time

import numpy as np

UPGRADE = (
    "GET /live HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: http://127.0.0.1:{port}\r\n"
    "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
)
TAKEN = re.compile(rb'"taken_s":([0-9.]+)')
TEXT, BINARY = 1, 2


class Page(asyncio.Protocol):
    """A page that reads all, and notes how old its pictures are."""

    def __init__(self, port: int) -> None:
        self._hello, self._rest = UPGRADE.format(port=port).encode(), b""
        self._is_open = False
        self.late_s: list[float] = []
        self.taken_s: list[float] = []
        self.texts = 0

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = transport
        transport.write(self._hello)

    def data_received(self, content: bytes) -> None:
        self._rest += content
        if not self._is_open:
            _, mark, self._rest = self._rest.partition(b"\r\n\r\n")
            self._is_open = bool(mark)
        while self._is_open and (frame := first_frame(self._rest)) is not None:
            kind, start, end = frame
            self._take(kind, self._rest[start : min(end, start + 400)])
            self._rest = self._rest[end:]

    def _take(self, kind: int, head: bytes) -> None:
        self.texts += kind == TEXT
        found = TAKEN.search(head) if kind == BINARY else None
        if found:
            self.taken_s.append(float(found[1]))
            self.late_s.append(time.monotonic() - self.taken_s[-1])


def first_frame(content: bytes) -> tuple[int, int, int] | None:
    """Return kind, start and end of the first frame's load; None where it is not whole."""
    if len(content) < 10:
        return None
    size, start = content[1] & 0x7F, 2
    if size == 126:
        size, start = int.from_bytes(content[2:4], "big"), 4
    elif size == 127:
        size, start = int.from_bytes(content[2:10], "big"), 10
    return (content[0] & 0x0F, start, start + size) if len(content) >= start + size else None


async def opened(port: int) -> Page:
    loop = asyncio.get_running_loop()
    _, page = await loop.create_connection(lambda: Page(port), "127.0.0.1", port)
    return page


def silent(port: int) -> socket.socket:
    """Return a page that was upgraded and reads nothing by itself."""
    one = socket.socket()
    one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    one.connect(("127.0.0.1", port))
    one.sendall(UPGRADE.format(port=port).encode())
    one.setblocking(False)
    return one


async def sip(slow: list[socket.socket]) -> None:
    """Read a little from each, once a second."""
    while True:
        for one in slow:
            try:
                one.recv(2000)
            except (BlockingIOError, ConnectionError):
                continue
        await asyncio.sleep(1.0)


async def crowd(port: int, healthy: int, slow: int, half_open: int, seconds: float) -> str:
    pages = [await opened(port) for _ in range(healthy)]
    quiet = [silent(port) for _ in range(slow + half_open)]
    sipping = asyncio.create_task(sip(quiet[:slow]))
    await asyncio.sleep(5.0)  # until all have settled
    for page in pages:
        page.late_s.clear()
    await asyncio.sleep(seconds)
    sipping.cancel()
    late_s = np.concatenate([page.late_s for page in pages] or [[]])
    median_s, p99_s = np.quantile(late_s, (0.5, 0.99)).tolist() if len(late_s) else (None, None)
    return json.dumps(
        {
            "pictures": len(late_s),
            "texts": sum(page.texts for page in pages),
            "median_s": median_s,
            "p99_s": p99_s,
            "in_order": all(page.taken_s == sorted(page.taken_s) for page in pages),
            "cut_off": sum(page.transport.is_closing() for page in pages),
        }
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("port", type=int)
    for name, usual in (("--healthy", 900), ("--slow", 50), ("--half-open", 50)):
        parser.add_argument(name, type=int, default=usual)
    parser.add_argument("--seconds", type=float, default=15.0)
    wish = parser.parse_args()
    told = crowd(wish.port, wish.healthy, wish.slow, wish.half_open, wish.seconds)
    print(asyncio.run(told))


if __name__ == "__main__":
    main()

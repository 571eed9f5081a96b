"""A socket that notes how long each packet lay in the kernel before the program took it."""

import socket
import struct
import time

SO_TIMESTAMPNS = 35  # Linux: the kernel's stamp of arrival, in its real-time clock
_TIMESPEC = struct.Struct("@qq")


class StampedSocket:
    """Has the manners of the socket it wraps, which never blocks.

    Attributes:
        waited_us: Of every packet, from its arrival in the kernel until it was taken.
    """

    def __init__(self, wrapped: socket.socket) -> None:
        wrapped.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self._wrapped = wrapped
        self.waited_us: list[float] = []

    def recvfrom(self, size: int) -> tuple[bytes, tuple[str, int]]:
        packet, notes, _, address = self._wrapped.recvmsg(size, 64)
        for level, kind, content in notes:
            if (level, kind) == (socket.SOL_SOCKET, SO_TIMESTAMPNS):
                seconds, nanoseconds = _TIMESPEC.unpack(content)
                arrived_ns = seconds * 10**9 + nanoseconds
                self.waited_us.append((time.time_ns() - arrived_ns) / 1000)
        return packet, address

    def __getattr__(self, name: str) -> object:
        return getattr(self._wrapped, name)

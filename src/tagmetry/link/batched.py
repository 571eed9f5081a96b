"""Many UDP packets in one call of Linux: `sendmmsg` and `recvmmsg`.

Each call of a socket lets other threads of Python go first, and a thread that has a hundred packets
to send then waits a hundred times for its turn.

Reference: the Linux manual, sendmmsg(2), recvmmsg(2), ip(7).
"""

import ctypes
import socket
import struct
import threading
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tagmetry.link.carrier import Address, Envelope
from tagmetry.link.sockets import UdpCarrier

_MOST = 256
_ROOM_BYTES = 2048  # for a packet
_MOST_KNOWN = 4096  # addresses
_DO_NOT_WAIT = 0x40  # MSG_DONTWAIT
_NAME = struct.Struct("!2s H 4s 8x")  # sockaddr_in, its family in the computer's own order
_FAMILY = struct.pack("=H", socket.AF_INET)


class _Message(ctypes.Structure):
    _fields_ = (
        ("name", ctypes.c_void_p),
        ("name_bytes", ctypes.c_uint32),
        ("piece", ctypes.c_void_p),
        ("pieces", ctypes.c_size_t),
        ("notes", ctypes.c_void_p),
        ("notes_bytes", ctypes.c_size_t),
        ("flags", ctypes.c_int),
    )


class _Header(ctypes.Structure):
    _fields_ = (("message", _Message), ("size_bytes", ctypes.c_uint))


class _Piece(ctypes.Structure):
    _fields_ = (("start", ctypes.c_void_p), ("size_bytes", ctypes.c_size_t))


class _Room:
    """Memory for packets, and the lists of them that the system reads and writes.

    Attributes:
        headers: One for each packet.
        pieces: Where each packet lies.
        names: The other sides' addresses, shape (n, 16).
        content: The packets, one after another.
    """

    def __init__(self) -> None:
        self.headers = np.zeros(_MOST, dtype=np.dtype(_Header))
        self.pieces = np.zeros(_MOST, dtype=np.dtype(_Piece))
        self.names = np.zeros((_MOST, _NAME.size), dtype=np.uint8)
        self.content = np.zeros(_MOST * _ROOM_BYTES, dtype=np.uint8)
        counted = np.arange(_MOST, dtype=np.uint64)
        message = self.headers["message"]
        message["name"] = self.names.ctypes.data + _NAME.size * counted
        message["name_bytes"] = _NAME.size
        message["piece"] = self.pieces.ctypes.data + self.pieces.itemsize * counted
        message["pieces"] = 1
        self.place(np.full(_MOST, _ROOM_BYTES, dtype=np.uint64))

    def place(self, sizes_bytes: NDArray[np.uint64]) -> None:
        """Let the first packets be of these sizes, without gaps."""
        ends = np.cumsum(sizes_bytes)
        self.pieces["start"][: len(ends)] = self.content.ctypes.data + ends - sizes_bytes
        self.pieces["size_bytes"][: len(ends)] = sizes_bytes


class BatchedUdpCarrier(UdpCarrier):
    """Carries packets in UDP, many at once."""

    def __init__(self, address: str, port: int) -> None:
        """Bind the socket, as `open_socket` does."""
        super().__init__(address, port)
        self._file = self._socket.fileno()
        self._coming, self._going = _Room(), _Room()
        self._sending = threading.Lock()
        self._addresses: dict[bytes, Address] = {}
        self._names: dict[Address, bytes] = {}
        # PyDLL keeps other threads waiting: taking what is there is quicker than changing threads
        self._receive = ctypes.PyDLL(None).recvmmsg
        self._send = ctypes.CDLL(None).sendmmsg

    def read_some(self, most: int) -> list[Envelope]:
        """Return packets that are there, at most so many; by one thread at a time."""
        room = self._coming
        start = ctypes.c_void_p(room.headers.ctypes.data)
        count = self._receive(self._file, start, min(most, _MOST), _DO_NOT_WAIT, None)
        if count <= 0:
            return []
        sizes_bytes = room.headers["size_bytes"][:count].tolist()
        content = room.content[: count * _ROOM_BYTES].data
        names = room.names[:count].tobytes()
        return [
            (
                bytes(content[_ROOM_BYTES * k : _ROOM_BYTES * k + size_bytes]),
                self._address(names[_NAME.size * k : _NAME.size * (k + 1)]),
            )
            for k, size_bytes in enumerate(sizes_bytes)
        ]

    def write_all(self, packets: Sequence[Envelope]) -> list[bool]:
        """Send packets; say which left."""
        left: list[bool] = []
        with self._sending:
            for first in range(0, len(packets), _MOST):
                left += self._write_batch(packets[first : first + _MOST])
        return left

    def _write_batch(self, packets: Sequence[Envelope]) -> list[bool]:
        room, count = self._going, len(packets)
        content = b"".join([packet for packet, _ in packets])
        room.content[: len(content)] = np.frombuffer(content, dtype=np.uint8)
        room.place(np.array([len(packet) for packet, _ in packets], dtype=np.uint64))
        names = b"".join([self._name(address) for _, address in packets])
        room.names[:count] = np.frombuffer(names, dtype=np.uint8).reshape(count, -1)
        left: list[bool] = []
        while len(left) < count:
            start = ctypes.c_void_p(room.headers.ctypes.data + room.headers.itemsize * len(left))
            sent = self._send(self._file, start, count - len(left), 0)
            left += [True] * sent if sent > 0 else [False]  # that one is lost, as in the air
        return left

    def _address(self, name: bytes) -> Address:
        if name not in self._addresses:
            _forget_many(self._addresses)
            _, port, host = _NAME.unpack(name)
            self._addresses[name] = socket.inet_ntoa(host), port
        return self._addresses[name]

    def _name(self, address: Address) -> bytes:
        if address not in self._names:
            _forget_many(self._names)
            host, port = address
            self._names[address] = _NAME.pack(_FAMILY, port, socket.inet_aton(host))
        return self._names[address]


def _forget_many(known: dict[bytes, Address] | dict[Address, bytes]) -> None:
    """Keep what strangers can fill from growing."""
    if len(known) >= _MOST_KNOWN:
        known.clear()

"""The host's UDP socket: bound to this computer alone unless an interface is named.

It is the carrier of packets where no other is named.
"""

import errno
import selectors
import socket
import sys

from tagmetry.errors import InputError
from tagmetry.link.carrier import Address, Envelope, OneByOne

LOOPBACK = "127.0.0.1"
_MOST_ERRORS = 256  # at once
_BUFFER_BYTES = 4 * 2**20  # the system grants what it allows


class UdpCarrier(OneByOne):
    """Carries packets in UDP."""

    def __init__(self, address: str, port: int) -> None:
        """Bind the socket, as `open_socket` does."""
        self._socket = open_socket(address, port)
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._socket, selectors.EVENT_READ)

    @property
    def address(self) -> Address:
        """Where robots reach it."""
        host, port = self._socket.getsockname()
        return host, port

    def wait(self, timeout_s: float) -> bool:
        """Wait until a packet is there, at most so long; say whether one is."""
        return bool(self._selector.select(timeout_s))

    def read(self) -> Envelope | None:
        """Return a packet and who sent it; None where none is there."""
        for _ in range(_MOST_ERRORS):
            try:
                return self._socket.recvfrom(2048)
            except BlockingIOError:
                return None
            except OSError:  # what some systems say of a robot that went away
                continue
        return None

    def write(self, packet: bytes, address: Address) -> bool:
        """Send a packet; say whether it left."""
        try:
            self._socket.sendto(packet, address)
        except OSError:  # no way to it, or no room in the buffer: as if lost in the air
            return False
        return True

    def close(self) -> None:
        """Close the socket."""
        self._selector.close()
        self._socket.close()


def open_carrier(address: str, port: int) -> UdpCarrier:
    """Return the quickest carrier of this computer.

    Raises:
        InputError: As of `open_socket`.
    """
    if sys.platform != "linux":
        return UdpCarrier(address, port)
    from tagmetry.link.batched import BatchedUdpCarrier  # with NumPy, which robots need not have

    return BatchedUdpCarrier(address, port)


def open_socket(address: str, port: int) -> socket.socket:
    """Return a socket that never blocks, bound to an interface of this computer.

    Args:
        address: The interface's address; `0.0.0.0` for all has to be said.
        port: The port; 0 for a free one.

    Raises:
        InputError: The address is none of this computer's, or the port is taken.
    """
    if not 0 <= port <= 0xFFFF:
        raise InputError(f"expected a port, 0 to 65535, got {port}")
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        opened.setblocking(False)
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _BUFFER_BYTES)
        opened.bind((address, port))
    except OSError as error:
        opened.close()
        raise InputError(_refusal(address, port, error)) from error
    return opened


def _refusal(address: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"port {port} of {address} is taken; end the other program or choose another port"
    reason = error.strerror or str(error)
    return f"cannot listen at {address[:60]!r}, port {port}: {reason}; name an interface's address"

"""The host's UDP socket: bound to this computer alone unless an interface is named."""

import errno
import socket

from tagmetry.errors import InputError

LOOPBACK = "127.0.0.1"
_BUFFER_BYTES = 4 * 2**20  # the system grants what it allows


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

"""The server in a process or a thread: bounded, without access log, closed within seconds."""

import socket
from collections.abc import Sequence

import uvicorn

from tagmetry.errors import InputError
from tagmetry.live.messages.wire import MOST_BYTES
from tagmetry.live.rooms.room import Room
from tagmetry.live.running import Runner
from tagmetry.live.server.access import Access
from tagmetry.live.server.app import create_app
from tagmetry.live.server.hub import MOST_PAGES, Hub

_MOST_WAITING = 256


def listening(address: str, port: int) -> socket.socket:
    """Return a socket that listens.

    Args:
        address: Of an interface of this computer.
        port: The port; 0 for a free one.

    Raises:
        InputError: The address is none of this computer's, or the port is taken.
    """
    kind = socket.AF_INET6 if ":" in address else socket.AF_INET
    opened = socket.socket(kind, socket.SOCK_STREAM)
    try:
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        opened.bind((address, port))
    except (OSError, OverflowError) as error:
        opened.close()
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            f"cannot listen at {address[:60]}, port {port}: {reason}; choose another --port"
        ) from error
    return opened


def server(access: Access, hub: Hub, runner: Runner, rooms: Sequence[Room] = ()) -> uvicorn.Server:
    """Return a server; its `run` wants the socket that listens."""
    config = uvicorn.Config(
        create_app(access, hub, runner, rooms),
        log_level="error",
        access_log=False,
        server_header=False,
        proxy_headers=False,
        ws="websockets-sansio",
        ws_max_size=MOST_BYTES,
        ws_per_message_deflate=False,
        limit_concurrency=MOST_PAGES + _MOST_WAITING,
        backlog=_MOST_WAITING,
        timeout_keep_alive=5,
        timeout_graceful_shutdown=2,
        h11_max_incomplete_event_size=16 * 1024,
        http="h11",
    )
    return uvicorn.Server(config)

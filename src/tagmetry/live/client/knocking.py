"""The way to a live page's server: sign in with the token, then open the socket."""

from contextlib import ExitStack
from http.client import HTTPConnection, HTTPException
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from tagmetry.errors import InputError, MissingExtraError

if TYPE_CHECKING:
    from websockets.sync.client import ClientConnection

_PATIENCE_S = 10.0
_MOST_BYTES = 1 << 24


def opened(stack: ExitStack, url: str, token: str | None) -> "ClientConnection":
    """Return a socket to a live page's server.

    Args:
        stack: Closes it.
        url: As the program printed it: http://127.0.0.1:8765/.
        token: That it printed; without one the client only looks.

    Raises:
        InputError: Nobody answers there, or this is not the token.
        MissingExtraError: The websockets are not installed.
    """
    try:
        from websockets.exceptions import WebSocketException
        from websockets.sync.client import connect
        from websockets.typing import Origin
    except ImportError:
        raise MissingExtraError("the live page's client", "live") from None
    host = _host(url)
    try:
        cookie = _signed_in(host, token) if token is not None else None
        opening = connect(
            f"ws://{host}/live",
            origin=Origin(f"http://{host}"),
            additional_headers={"Cookie": cookie} if cookie else None,
            compression=None,
            proxy=None,
            open_timeout=_PATIENCE_S,
            max_size=_MOST_BYTES,
        )
        return stack.enter_context(opening)
    except (OSError, HTTPException, WebSocketException) as error:
        raise InputError(
            f"no live page answers at {url[:80]}: {error}; start one with `tagmetry live`"
        ) from error


def _host(url: str) -> str:
    parts = urlsplit(url)
    if parts.scheme != "http" or not parts.netloc or "@" in parts.netloc:
        raise InputError(f"expected an address like http://127.0.0.1:8765/, got {url[:80]!r}")
    return parts.netloc


def _signed_in(host: str, token: str) -> str:
    """Return the cookie of an operator."""
    connection = HTTPConnection(host, timeout=_PATIENCE_S)
    try:
        connection.request("POST", "/sign-in", token.encode(), {"Origin": f"http://{host}"})
        answer = connection.getresponse()
        answer.read()
    finally:
        connection.close()
    if answer.status != 204:
        raise InputError(f"the server at {host} does not take this token; copy it anew")
    return (answer.getheader("set-cookie") or "").partition(";")[0]

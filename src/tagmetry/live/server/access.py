"""Who may do what: the token, the sessions that it opens, and the addresses that are answered.

The token never leaves this computer but by the person who copies it: it is exchanged once, in the
body of a POST, for a session's cookie that no script can read.
"""

import secrets
import threading
import time
from collections import deque
from ipaddress import IPv4Address, IPv6Address, ip_address

from tagmetry.errors import InputError
from tagmetry.live.messages import Role

_TOKEN_BYTES = 32  # 256 bits
_MOST_SESSIONS, _TRIES, _TRIES_S = 64, 10, 60.0


class Access:
    """The keeper of one server's door."""

    def __init__(self, address: str, port: int, token: str | None = None) -> None:
        """Hang the door.

        Args:
            address: That the server listens at: an interface's, not a name.
            port: That it listens at.
            token: That another program of this server drew; None draws one.

        Raises:
            InputError: The address is none, or stands for all interfaces.
        """
        self.token = token or secrets.token_urlsafe(_TOKEN_BYTES)
        self.cookie = f"tagmetry_live_{port}"  # ports of one host share their cookies
        self.is_loopback = _checked(address).is_loopback
        self._hosts = _hosts(address, port, self.is_loopback)
        self._sessions: deque[str] = deque(maxlen=_MOST_SESSIONS)
        self._wrong_s: deque[float] = deque(maxlen=_TRIES)
        self._lock = threading.Lock()

    def is_own_host(self, host: str | None) -> bool:
        """Say whether a Host header names this server; anything else may be a rebound name."""
        return host is not None and host.lower() in self._hosts

    def is_own_origin(self, origin: str | None) -> bool:
        """Say whether an Origin header is that of this server's own page."""
        scheme, _, host = (origin or "").partition("://")
        return scheme == "http" and self.is_own_host(host)

    def sign_in(self, token: str) -> str | None:
        """Return a new session for the token; None for another one, or after too many of them."""
        with self._lock:
            if not self._may_try():
                return None
            if not secrets.compare_digest(token.encode(), self.token.encode()):
                self._wrong_s.append(time.monotonic())
                return None
            session = secrets.token_urlsafe(_TOKEN_BYTES)
            self._sessions.append(session)
            return session

    def role(self, session: str | None) -> Role | None:
        """Return what the holder of a session may do; None where it may not even look."""
        with self._lock:
            shown = (session or "").encode()
            known = [secrets.compare_digest(one.encode(), shown) for one in self._sessions]
        if any(known):
            return "operator"
        return "viewer" if self.is_loopback else None

    def _may_try(self) -> bool:
        """Say whether fewer than ten wrong tokens came in the last minute."""
        is_full = len(self._wrong_s) == _TRIES
        return not is_full or time.monotonic() - self._wrong_s[0] > _TRIES_S


def _checked(address: str) -> IPv4Address | IPv6Address:
    try:
        known = ip_address(address)
    except ValueError:
        raise InputError(
            f"expected the address of an interface such as 127.0.0.1, got {address[:60]!r}"
        ) from None
    if known.is_unspecified:
        raise InputError(f"{address} would be all interfaces; name the address of one")
    return known


def _hosts(address: str, port: int, is_loopback: bool) -> frozenset[str]:
    names = [f"[{address}]" if ":" in address else address]
    if is_loopback:
        names.append("localhost")
    with_port = [f"{name}:{port}" for name in names]
    return frozenset(with_port + (names if port == 80 else []))

"""Hosts and Origins that are not the page's own: no socket, no sign-in, nothing."""

import pytest
from live_server import Served

EVIL = "evil.example"
STRANGE_HOSTS = [
    None, "", EVIL, f"{EVIL}:{{port}}", "127.0.0.1", "localhost", "127.0.0.1:1", "localhost:1",
    "127.0.0.1.{evil}:{port}", "localhost.{evil}:{port}", "{evil}#127.0.0.1:{port}",
    "user@127.0.0.1:{port}", "127.0.0.1:{port}.", "127.0.0.1:{port}/", "[::1]:{port}",
    "[::ffff:127.0.0.1]:{port}", "0.0.0.0:{port}", "127.1:{port}", "2130706433:{port}",
    "0x7f000001:{port}", "127.0.0.2:{port}", "localhost.:{port}", "127.0.0.1:0{port}",
    "127.0.0.1:{port}, {evil}", " ", "null",
]  # fmt: skip
STRANGE_ORIGINS = [
    None, "", "null", "http://{evil}", "http://{evil}:{port}", "https://127.0.0.1:{port}",
    "http://127.0.0.1", "http://localhost", "http://127.0.0.1:1", "http://127.0.0.1:{port}/",
    "http://127.0.0.1:{port}.{evil}", "http://127.0.0.1:{port}@{evil}", "http://{evil}/127.0.0.1",
    "http://[::1]:{port}", "http://0.0.0.0:{port}", "127.0.0.1:{port}", "//127.0.0.1:{port}",
    "file://", "file://127.0.0.1:{port}", "ws://127.0.0.1:{port}", "http://127.0.0.1:{port} ",
    "http://127.0.0.1:{port} http://{evil}", "chrome-extension://abc", "http:127.0.0.1:{port}",
    "HTTP://{evil}:{port}", "http://user@127.0.0.1:{port}", "http://localhost.:{port}",
    "about:blank", "data:", "http://127.0.0.1:{port}?", "http://127.0.0.1:{port}#",
    "http://127.0.0.2:{port}", "http://2130706433:{port}", "blob:http://127.0.0.1:{port}",
]  # fmt: skip
UPGRADE = {
    "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
    "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
}  # fmt: skip


def filled(text: str | None, live: Served) -> str | None:
    return None if text is None else text.replace("{port}", str(live.port)).replace("{evil}", EVIL)


def stripped(text: str | None) -> str:
    return (text or "").strip()


@pytest.mark.parametrize("host", STRANGE_HOSTS, ids=repr)
def test_a_host_that_is_not_its_own_is_refused_everywhere(live: Served, host: str | None) -> None:
    own, same = filled(host, live), f"http://{stripped(filled(host, live))}"
    for origin in (live.origin, same):  # a rebound name sends an Origin that equals its Host
        assert live.ask("POST", "/sign-in", b"x", Host=own, Origin=origin)[0] in (400, 403)
        status, _, _ = live.ask("GET", "/live", Host=own, Origin=origin, **UPGRADE)
        assert status in (400, 403)
    assert live.ask("GET", "/", Host=own)[0] in (400, 403)


@pytest.mark.parametrize("origin", STRANGE_ORIGINS, ids=repr)
def test_an_origin_that_is_not_its_own_gets_no_socket_and_no_post(
    live: Served, origin: str | None
) -> None:
    own = filled(origin, live)
    if own is not None and own.strip() == live.origin:
        pytest.skip("a header's spaces at its ends are no part of it")
    assert live.ask("GET", "/live", Origin=own, **UPGRADE)[0] == 403
    token = live.access.token.encode()
    status, headers, _ = live.ask("POST", "/sign-in", token, Origin=own)
    assert status == 403
    assert "set-cookie" not in headers


def test_the_own_page_gets_its_socket(live: Served) -> None:
    assert live.ask("GET", "/live", Origin=live.origin, **UPGRADE)[0] == 101

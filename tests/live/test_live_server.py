"""The server: every route's role, strangers' requests, the token's secrecy, bounds."""

import json
import logging
from collections.abc import Iterator
from pathlib import Path

import pytest
from live_server import Served, drained, eventually, heard, served
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tagmetry.errors import InputError
from tagmetry.live.messages import CONTRACT, Beat, GoTo, Seen, Stop
from tagmetry.live.messages.wire import format_message
from tagmetry.live.page import PARTS
from tagmetry.live.rooms.every import Furniture, opened_rooms
from tagmetry.live.server.app import ROUTES, create_app
from tagmetry.live.server.hub import Hub
from tagmetry.live.server.serving import listening

EVIL = "evil.example"


@pytest.fixture(scope="module")
def live() -> Iterator[Served]:
    with served() as own:
        yield own


@pytest.fixture(scope="module")
def far() -> Iterator[Served]:
    """Give a server that believes to serve another interface."""
    with served("192.0.2.1") as own:
        yield own


def far_headers(far: Served) -> dict[str, str]:
    return {"Host": f"192.0.2.1:{far.port}", "Origin": f"http://192.0.2.1:{far.port}"}


def test_every_route_of_the_app_is_declared_with_its_role(live: Served) -> None:
    with opened_rooms(live.hub.give, live.runner, Furniture()) as rooms:
        app = create_app(live.access, Hub(), live.runner, rooms)
    methods = {
        route.path: (*sorted(getattr(route, "methods", None) or ["WEBSOCKET"]),)
        for route in app.routes
    }
    assert methods == {path: (method,) for path, (method, _) in ROUTES.items()}


@pytest.mark.parametrize(("path", "method"), [(p, m) for p, (m, _) in ROUTES.items()])
@pytest.mark.parametrize("wrong", ["GET", "POST", "PUT", "DELETE", "OPTIONS", "TRACE"])
def test_a_route_answers_its_method_alone(live: Served, path: str, method: str, wrong: str) -> None:
    status, _, _ = live.ask(wrong, path, None, Origin=live.origin)
    right = wrong == method
    assert status in ({200, 403, 409, 422} if right else {404, 405})  # 409, 422: not now, not so


def test_what_anybody_gets_is_the_page_alone(far: Served) -> None:
    for path, (method, role) in ROUTES.items():
        if method == "GET" and role is None:
            status, _, _ = far.ask("GET", path, **far_headers(far))
            assert status == 200


def test_beyond_this_computer_a_room_answers_nobody_without_the_token(far: Served) -> None:
    for path, (method, role) in ROUTES.items():
        if method != "WEBSOCKET" and role == "viewer":
            status, _, body = far.ask(method, path, **far_headers(far))
            assert (status, body) == (403, b"sign in with the token")


@pytest.mark.parametrize(
    "rule",
    [r for r in CONTRACT if r.sender == "page" and r.message is not Seen],
    ids=lambda r: r.name,
)
def test_a_viewer_is_heard_where_it_may_and_an_operator_always(live: Served, rule) -> None:
    values = {
        "robot_id": 1, "x_m": 0.0, "y_m": 0.0, "name": "disperse", "robots": 2, "why": "x",
        "points_m": ((0.0, 0.5),), "value": 0.5,
        "board": "chessboard:9x6:25mm", "uncertainty": "0.5px",
        "depth_m": 0.4, "turn_deg": 20.0, "tracks": False, "noise_px": 0.1,
        "map_name": "room.yaml", "camera": "camera.yaml", "images": "walk",
    }  # fmt: skip
    asked = rule.message(**{n: values[n] for n in rule.message.__dataclass_fields__})
    before = len(live.runner.asked)
    with live.page() as viewer:
        assert '"role":"viewer"' in viewer.recv(timeout=5)
        viewer.send(format_message(asked))
        if rule.role == "operator":
            heard(viewer, "operator's role")
            assert len(live.runner.asked) == before
        else:
            eventually(lambda: len(live.runner.asked) == before + 1)
            before += 1
    with live.page(live.session()) as operator:
        assert '"role":"operator"' in operator.recv(timeout=5)
        operator.send(format_message(asked))
        eventually(lambda: len(live.runner.asked) == before + 1)
    assert live.runner.asked[-1][1] == asked


def test_beyond_this_computer_looking_needs_the_token(far: Served) -> None:
    headers = far_headers(far)
    status, told, _ = far.ask("POST", "/sign-in", far.access.token.encode(), **headers)
    assert status == 204
    cookie = told["set-cookie"].split(";")[0]
    to = {"address": ("127.0.0.1", far.port), "origin": headers["Origin"], "proxy": None}
    stranger = connect(f"ws://{headers['Host']}/live", **to)
    with stranger as page, pytest.raises(ConnectionClosed, match="sign in with the token"):
        page.recv(timeout=5)
    more = {"additional_headers": {"Cookie": cookie}}
    with connect(f"ws://{headers['Host']}/live", **to, **more) as page:
        assert '"role":"operator"' in page.recv(timeout=5)


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


STEPS = (
    "../", "..%2f", "%2e%2e/", "%2e%2e%2f", "..%5c", "..;/", "....//", "..%252f", "%c0%ae/",
)  # fmt: skip
TRAVERSALS = [
    f"{start}{step * depth}{target}"
    for start in ("/", "/static/", "/page/", "//")
    for step in (
        "../",
        "..%2f",
        "%2e%2e/",
        "%2e%2e%2f",
        "..%5c",
        "..;/",
        "....//",
        "..%252f",
        "%c0%ae/",
    )
    for depth in (1, 3, 8)
    for target in ("etc/passwd", "__init__.py", "access.py", "app.js%00.html", "windows/win.ini")
]


def test_no_path_leads_out_of_the_page(live: Served) -> None:
    assert len(TRAVERSALS) >= 500
    for path in TRAVERSALS:
        status, _, body = live.ask("GET", path)
        assert status in (400, 404), path
        assert b"root:" not in body


@pytest.mark.parametrize("path", [*ROUTES, "/nothing"])
def test_every_answer_carries_the_safety_headers_and_no_cors(live: Served, path: str) -> None:
    _, headers, _ = live.ask("GET", path, Origin=live.origin)
    policy = headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["referrer-policy"] == "no-referrer"
    assert not any(name.startswith("access-control") for name in headers)


def test_the_page_holds_no_script_of_its_own_and_names_no_other_host(live: Served) -> None:
    for path in ROUTES:
        if path in PARTS:
            text = live.ask("GET", path)[2].decode()
            assert "http://" not in text.replace("http://www.w3.org", "")
            assert "https://" not in text
            assert "innerHTML" not in text
            assert "<script>" not in text
            assert " onclick" not in text


def test_the_cookie_is_out_of_reach_of_scripts_and_other_sites(live: Served) -> None:
    _, headers, body = live.ask("POST", "/sign-in", live.access.token.encode())
    cookie = headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie
    assert live.access.token not in headers["set-cookie"]
    assert body == b""


def test_the_token_is_in_no_log_and_no_answer(caplog: pytest.LogCaptureFixture, capfd) -> None:
    caplog.set_level(logging.DEBUG)
    with served() as live:
        token = live.access.token
        answers = [live.ask("POST", "/sign-in", token.encode())]
        cookie = answers[0][1]["set-cookie"].split(";")[0]
        answers.append(live.ask("POST", "/sign-in", b"wrong"))
        answers.append(live.ask("GET", "/", Referer=f"{live.origin}/?t={token}"))
        answers.append(live.ask("GET", "/nothing", Cookie=cookie))
        with live.page(cookie) as page:
            page.send("{" + token)
            told = heard(page, "Welcome") + heard(page, "Refused")
    out = "".join(capfd.readouterr())
    ours = "".join(r.getMessage() for r in caplog.records if not r.name.startswith("websockets"))
    assert token not in told + out + ours
    assert not any(token in str(answer) for answer in answers)


@pytest.mark.parametrize("size", [513, 100_000])
def test_a_large_body_is_refused(live: Served, size: int) -> None:
    status, headers, _ = live.ask("POST", "/sign-in", size * b"x")
    assert status == 413
    assert "set-cookie" not in headers


def test_a_large_message_ends_the_socket_and_others_are_served(live: Served) -> None:
    with live.page(live.session()) as other, live.page() as page:
        page.send(100_000 * "x")
        with pytest.raises(ConnectionClosed):
            drained(page)
        before = len(live.runner.asked)
        other.send(format_message(Beat()))
        eventually(lambda: len(live.runner.asked) > before)


def test_a_page_that_makes_no_sense_is_put_out_and_counts_as_gone(live: Served) -> None:
    with live.page() as page:
        for _ in range(20):
            page.send("nonsense")
        with pytest.raises(ConnectionClosed, match="refused"):
            drained(page)
    eventually(lambda: live.runner.viewers == 0)


def test_a_page_that_closes_has_left(live: Served) -> None:
    before = len(live.runner.left)
    with live.page(live.session()) as page:
        page.send(format_message(GoTo(1, 0.0, 0.0)))
        page.send(format_message(Stop()))
        eventually(lambda: isinstance(live.runner.asked[-1][1], Stop))
    eventually(lambda: len(live.runner.left) == before + 1)
    assert live.runner.left[-1] == live.runner.asked[-1][0]


@pytest.fixture
def shelf(live: Served, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder of recordings beside secrets."""
    folder = tmp_path / "recordings"
    folder.mkdir()
    (folder / "2026-01-01.mcap").write_bytes(b"one")
    (folder / "note.txt").write_bytes(b"root: secret")
    (tmp_path / "secret.mcap").write_bytes(b"root: secret")
    (folder / "link.mcap").symlink_to(tmp_path / "secret.mcap")
    monkeypatch.setattr(live.runner, "recordings", folder)
    return folder


def test_an_operator_lists_and_fetches_recordings(live: Served, shelf: Path) -> None:
    cookie = live.session()
    status, _, body = live.ask("GET", "/recordings", Cookie=cookie)
    assert status == 200
    assert json.loads(body) == [{"name": "2026-01-01.mcap", "size_bytes": 3, "is_growing": False}]
    status, headers, body = live.ask("GET", "/recordings/2026-01-01.mcap", Cookie=cookie)
    assert (status, body) == (200, b"one")
    assert headers["content-disposition"].startswith("attachment")


@pytest.mark.parametrize("cookie", ["", "tagmetry_live_{port}=x", "tagmetry_live_{port}="])
@pytest.mark.parametrize("path", [path for path, (_, role) in ROUTES.items() if role == "operator"])
def test_who_is_no_operator_gets_nothing_of_an_operators_route(
    live: Served, shelf: Path, cookie: str, path: str
) -> None:
    named = path.replace("{name}", "2026-01-01.mcap")
    own = cookie.replace("{port}", str(live.port))
    assert live.ask(ROUTES[path][0], named, Cookie=own)[0] == 403


def test_no_name_leads_out_of_the_recordings(live: Served, shelf: Path) -> None:
    cookie = live.session()
    names = ["note.txt", "link.mcap", "../secret.mcap", "..%2fsecret.mcap", "secret.mcap", "%00"]
    for name in [*names, *(path.lstrip("/") for path in TRAVERSALS)]:
        status, _, body = live.ask("GET", f"/recordings/{name}", Cookie=cookie)
        assert status in (400, 404), name
        assert b"root:" not in body


def test_no_port_twice(live: Served) -> None:
    with pytest.raises(InputError, match="choose another --port"):
        listening("127.0.0.1", live.port)

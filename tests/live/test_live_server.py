"""The server: every route with its role, to viewers, operators and strangers from elsewhere."""

from collections.abc import Iterator

import pytest
from live_server import Served, eventually, heard, served
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tagmetry.errors import InputError
from tagmetry.live.messages import CONTRACT, Seen
from tagmetry.live.messages.wire import format_message
from tagmetry.live.rooms.every import Furniture, opened_rooms
from tagmetry.live.server.app import ROUTES, create_app
from tagmetry.live.server.hub import Hub
from tagmetry.live.server.serving import listening


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


def test_no_port_twice(live: Served) -> None:
    with pytest.raises(InputError, match="choose another --port"):
        listening("127.0.0.1", live.port)

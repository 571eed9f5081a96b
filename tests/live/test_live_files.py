"""The files that a server gives: recordings to operators, and no name leads to any other."""

import json
from pathlib import Path

import pytest
from live_server import Served

from tagmetry.live.server.app import ROUTES

STEPS = (
    "../", "..%2f", "%2e%2e/", "%2e%2e%2f", "..%5c", "..;/", "....//", "..%252f", "%c0%ae/",
)  # fmt: skip
TRAVERSALS = [
    f"{start}{step * depth}{target}"
    for start in ("/", "/static/", "/page/", "//")
    for step in STEPS
    for depth in (1, 3, 8)
    for target in ("etc/passwd", "__init__.py", "access.py", "app.js%00.html", "windows/win.ini")
]


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


def test_no_path_leads_out_of_the_page(live: Served) -> None:
    assert len(TRAVERSALS) >= 500
    for path in TRAVERSALS:
        status, _, body = live.ask("GET", path)
        assert status in (400, 404), path
        assert b"root:" not in body

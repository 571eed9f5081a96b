"""What every answer holds, and what none does: headers, scripts, the token."""

import logging

import pytest
from live_server import Served, heard, served

from tagmetry.live.page import PARTS
from tagmetry.live.server.app import ROUTES


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

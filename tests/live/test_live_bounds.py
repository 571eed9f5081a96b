"""Pages that say too much, or nonsense, or leave: others are served all the same."""

import pytest
from live_server import Served, drained, eventually
from websockets.exceptions import ConnectionClosed

from tagmetry.live.messages import Beat, GoTo, Stop
from tagmetry.live.messages.wire import format_message


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

"""The server as a program of its own: what is told, asked and refused, and what ends it."""

import io
import os
import signal
import socket
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from live_server import Remembering, eventually

from tagmetry.errors import InputError
from tagmetry.live.beside.outbox import Outbox
from tagmetry.live.beside.parcels import Parcel, parcels, write_parcel
from tagmetry.live.beside.process import ServerProcess
from tagmetry.live.beside.words import Begin, begin_of, begin_parcel, news_parcel
from tagmetry.live.client import LiveClient
from tagmetry.live.messages import GoTo, Picture, Refused, Stop, World
from tagmetry.live.rooms.every import Furniture
from tagmetry.live.server.hub import Hub
from tagmetry.live.server.serving import listening

TOKEN = "a token that only this test knows"  # noqa: S105 - no secret
WORLD = World(7.0, (), (), False, "")


class Busy(Remembering):
    """A runner that takes a stop alone."""

    def ask(self, page: int, asked: object) -> None:
        if not isinstance(asked, Stop):
            raise InputError("100 commands wait already; try again")
        super().ask(page, asked)


@pytest.fixture(scope="module")
def begin(tmp_path_factory: pytest.TempPathFactory) -> Begin:
    with listening("127.0.0.1", 0) as opened:
        port = opened.getsockname()[1]
    folder = tmp_path_factory.mktemp("beside")
    return Begin("127.0.0.1", port, TOKEN, ("wander",), folder, Furniture("twin", folder))


@pytest.fixture(scope="module")
def runner() -> Busy:
    return Busy()


@pytest.fixture(scope="module")
def server(begin: Begin, runner: Busy) -> Iterator[ServerProcess]:
    own = ServerProcess()
    try:
        own.give(WORLD)  # before it serves
        own.begin(begin, runner)
        yield own
    finally:
        own.close()


def url(begin: Begin) -> str:
    return f"http://{begin.address}:{begin.port}/"


@given(
    st.lists(st.tuples(st.text(max_size=9), st.dictionaries(st.text(), st.integers()), st.binary()))
)
def test_parcels_arrive_as_they_were_sent(sent: list[tuple[str, dict[str, int], bytes]]) -> None:
    pipe = io.BytesIO()
    own = [Parcel(*one) for one in sent if abs(sum(one[1].values())) < 2**53]
    own = [one for one in own if all(abs(value) < 2**53 for value in one.values.values())]
    for one in own:
        write_parcel(pipe, one)
    assert list(parcels(io.BytesIO(pipe.getvalue()))) == own


@pytest.mark.parametrize("missing", [1, 5, 12, 20])
def test_a_parcel_that_was_cut_off_is_left_out(missing: int) -> None:
    pipe = io.BytesIO()
    write_parcel(pipe, Parcel("first", {"a": 1}, b"load"))
    end = len(pipe.getvalue())
    write_parcel(pipe, Parcel("second", {"page": 3}, b"12345"))
    cut = pipe.getvalue()[:-missing]
    assert len(cut) > end
    assert [one.kind for one in parcels(io.BytesIO(cut))] == ["first"]


def test_the_beginning_is_read_as_it_was_told(begin: Begin) -> None:
    pipe = io.BytesIO()
    write_parcel(pipe, begin_parcel(begin))
    assert begin_of(next(parcels(io.BytesIO(pipe.getvalue())))) == begin


def test_the_newest_news_of_a_kind_replace_older_ones() -> None:
    outbox = Outbox()
    for number in range(5):
        outbox.put("World", Parcel("news", {"number": number}))
        outbox.put("Picture", Parcel("news", {"number": 10 + number}))
    taken = [outbox.take(), outbox.take()]
    assert [one.values["number"] for one in taken if one is not None] == [4, 14]
    outbox.close()
    assert outbox.take() is None


def test_news_are_what_a_page_gets() -> None:
    picture = news_parcel(Picture(1.0, 2.0, 3, 4, (), b"jpeg"), "a.mcap")
    assert picture.values == {"name": "Picture", "is_text": False, "recording": "a.mcap"}
    assert picture.load.endswith(b"jpeg")
    assert b'"type":"World"' in news_parcel(WORLD, None).load


def test_a_page_gets_what_was_told_before_it_came(server: ServerProcess, begin: Begin) -> None:
    with LiveClient(url(begin)) as page:
        assert page.world.time_s == 7.0
        server.give(World(8.0, (), (), False, ""))
        eventually(lambda: page.world.time_s == 8.0)


def test_the_arena_hears_pages_and_that_they_are_gone(
    server: ServerProcess, begin: Begin, runner: Busy
) -> None:
    with LiveClient(url(begin)) as page:
        eventually(lambda: runner.viewers == 1)
        page.send(Stop("by hand"))
        eventually(lambda: any(isinstance(asked, Stop) for _, asked in runner.asked))
    eventually(lambda: runner.viewers == 0)
    assert runner.left


def test_what_the_arena_refuses_the_page_that_asked_is_told(
    server: ServerProcess, begin: Begin
) -> None:
    with LiveClient(url(begin), TOKEN) as page, LiveClient(url(begin)) as other:
        page.send(GoTo(0, 0.1, 0.1))
        eventually(lambda: "100 commands wait already" in page.refused)
        assert not other.refused


def test_a_refusal_of_a_page_that_is_gone_is_nobodys() -> None:
    hub = Hub()
    hub.join()
    hub.refuse(99, Refused("too late"))


def test_the_arena_ends_the_server_which_leaves_its_port(tmp_path: Path) -> None:
    with listening("127.0.0.1", 0) as opened:
        port = opened.getsockname()[1]
    own, begin = ServerProcess(), Begin("127.0.0.1", port, TOKEN, (), tmp_path, Furniture())
    own.begin(begin, Remembering())
    own.close()
    with pytest.raises(OSError, match="refused"):
        socket.create_connection(("127.0.0.1", port), 1.0)


def test_a_server_that_never_began_is_ended_at_once() -> None:
    own, began_s = ServerProcess(), time.monotonic()
    own.close()
    assert time.monotonic() - began_s < 2


@pytest.mark.skipif(os.name != "posix", reason="interrupts by a signal")
def test_ctrl_c_reaches_the_server_as_well_and_ends_it_quietly(
    begin: Begin, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with listening("127.0.0.1", 0) as opened:
        port = opened.getsockname()[1]
    own = ServerProcess()
    own.begin(replace(begin, port=port, recordings=tmp_path), Remembering())
    os.kill(own.id, signal.SIGINT)
    own.wait()
    own.close()
    assert capfd.readouterr().err == ""


@pytest.mark.skipif(os.name != "posix", reason="kills by a signal")
def test_a_server_that_is_killed_is_noticed(tmp_path: Path) -> None:
    with listening("127.0.0.1", 0) as opened:
        port = opened.getsockname()[1]
    own, begin = ServerProcess(), Begin("127.0.0.1", port, TOKEN, (), tmp_path, Furniture())
    own.begin(begin, Remembering())
    os.kill(own.id, signal.SIGKILL)
    own.wait()
    own.give(WORLD)  # nobody takes it
    own.close()


def test_a_port_that_was_taken_meanwhile_is_told(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]  # nobody listens, so it answers nothing
        own = ServerProcess()
        with pytest.raises(InputError, match="did not start"):
            own.begin(Begin("127.0.0.1", port, TOKEN, (), tmp_path, Furniture()), Remembering())
        own.close()
    assert "cannot listen" in capfd.readouterr().err

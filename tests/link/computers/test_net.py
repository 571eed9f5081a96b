"""The net is joined where it is named and nowhere else; what cannot be is one line."""

import socket
import sys
from pathlib import Path

import pytest
from peers import free_endpoint, until

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.link.computers import ArenaBridge, ArenaView, Commander
from tagmetry.link.computers.inbox import Inbox
from tagmetry.link.computers.net import Net

KEY = bytes(range(32))


def test_without_zenoh_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "zenoh", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'tagmetry\[zenoh\]'"):
        Net(connect="tcp/127.0.0.1:7447")


@pytest.mark.parametrize(
    "endpoint",
    ["", "127.0.0.1:7447", "udp/127.0.0.1:7447", "tcp/127.0.0.1", "tcp/127.0.0.1:0",
     "tcp/127.0.0.1:65536", "tcp/:7447", "tcp/*:7447", "tcp/a b:7447", "tcp/1.2.3.4:7447#iface=x"],
)  # fmt: skip
def test_what_is_no_endpoint_is_refused(endpoint: str) -> None:
    with pytest.raises(InputError, match=r"expected an endpoint like tcp/192\.168\.1\.5:7447"):
        Net(listen=endpoint)


@pytest.mark.parametrize("key", [b"", bytes(31), bytes(33)])
def test_a_key_of_another_length_is_refused(key: bytes) -> None:
    with pytest.raises(InputError, match="expected a key of 32 bytes, got"):
        ArenaView("tcp/127.0.0.1:7447", key=key)
    with pytest.raises(InputError, match="expected a key of 32 bytes, got"):
        Commander("tcp/127.0.0.1:7447", [1], key)


def test_ids_and_names_that_cannot_be_are_refused() -> None:
    with pytest.raises(InputError, match="expected robots' ids, 0 to 65534, got 65535"):
        Commander("tcp/127.0.0.1:7447", [65535], KEY)
    with pytest.raises(InputError, match="by name, and two are called 'ada'"):
        ArenaBridge("lab", {1: "ada", 2: "ada"}, listen=free_endpoint())
    for number in (65535, -1):
        with pytest.raises(InputError, match=f"ids from 0 to 65534, got {number}"):
            ArenaBridge("lab", {number: "ada"}, listen=free_endpoint())


@pytest.fixture
def zenoh() -> None:
    pytest.importorskip("zenoh", reason="needs the part zenoh")


@pytest.mark.usefixtures("zenoh")
def test_a_port_that_is_taken_is_named() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        endpoint = f"tcp/127.0.0.1:{taken.getsockname()[1]}"
        with pytest.raises(InputError, match=f"cannot listen at {endpoint}: Address") as refused:
            Net(listen=endpoint)
    assert "\n" not in str(refused.value)
    assert ".rs" not in str(refused.value)


@pytest.mark.usefixtures("zenoh")
def test_an_address_of_another_computer_is_named() -> None:
    with pytest.raises(InputError, match=r"cannot listen at tcp/192\.0\.2\.1:7447: Cannot assign"):
        Net(listen="tcp/192.0.2.1:7447")


@pytest.mark.usefixtures("zenoh")
def test_nobody_who_answers_is_one_line() -> None:
    endpoint = free_endpoint()
    with pytest.raises(InputError, match=f"nobody answers at {endpoint}; is the arena") as refused:
        ArenaView(endpoint)
    assert "\n" not in str(refused.value)


def listening() -> set[str]:
    """Return where this process listens: addresses and ports as the kernel writes them."""
    own = set()
    for link in Path("/proc/self/fd").iterdir():
        try:
            own.add(str(link.readlink()))
        except FileNotFoundError:  # the listing's own
            continue
    found = set()
    for table in ("tcp", "tcp6", "udp", "udp6"):
        for line in Path(f"/proc/self/net/{table}").read_text("ascii").splitlines()[1:]:
            words = line.split()
            is_bound = words[3] == "0A" or table.startswith("udp")
            if is_bound and f"socket:[{words[9]}]" in own:
                found.add(words[1])
    return found


@pytest.mark.skipif(sys.platform != "linux", reason="reads the kernel's tables")
@pytest.mark.usefixtures("zenoh")
def test_it_listens_where_it_is_told_and_nowhere_else() -> None:
    before, endpoint = listening(), free_endpoint()
    port = int(endpoint.rpartition(":")[2])
    with Net(listen=endpoint):
        assert listening() - before == {f"0100007F:{port:04X}"}
        with Net(connect=endpoint):
            assert listening() - before == {f"0100007F:{port:04X}"}


@pytest.mark.usefixtures("zenoh")
def test_what_is_told_is_heard_where_it_belongs() -> None:
    endpoint, heard = free_endpoint(), []
    with Net(listen=endpoint) as here, Net(connect=endpoint) as there:
        there.hear(["tagmetry/lab/robots/*/pose"], lambda *said: heard.append(said))

        def said() -> bool:
            here.tell("tagmetry/lab/robots/a b/pose", b"\x00\xff", is_urgent=True)
            here.tell("tagmetry/other/robots/a b/pose", b"other")
            here.tell("tagmetry/lab/robots/a b/pose", bytes(1201))
            return bool(heard)

        until(said)
    assert set(heard) == {("tagmetry/lab/robots/a b/pose", b"\x00\xff")}
    assert not here.tell("tagmetry/lab/state", b"after the end")


@pytest.mark.usefixtures("zenoh")
def test_an_inbox_keeps_the_newest_and_no_more_than_it_may() -> None:
    endpoint = free_endpoint()
    with Net(listen=endpoint) as here, Net(connect=endpoint) as there:
        inbox = there.inbox("tagmetry/lab/*", kept=10)

        def said() -> bool:
            here.tell("tagmetry/lab/first", b"")
            return inbox.wait(0.05)

        until(said)
        for number in range(50):
            here.tell("tagmetry/lab/state", bytes([number]))
            here.tell("tagmetry/lab/state", bytes(1201))
        until(lambda: said_last(inbox))
        assert inbox.take() is None
        assert not inbox.wait(0.01)
    assert inbox.take() is None


def said_last(inbox: Inbox) -> bool:
    """Read what is there; say whether the last of fifty packets came, and with it ten at most."""
    came = [packet for _, packet in inbox.all(1000)]
    assert len(came) <= 11
    assert all(len(packet) <= 1 for packet in came)
    return came[-1:] == [bytes([49])]

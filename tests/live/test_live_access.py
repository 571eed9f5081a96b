"""The door: the token, sessions, and which Host and Origin are this server's own."""

import pytest

from tagmetry.errors import InputError
from tagmetry.live.messages import Role
from tagmetry.live.server import access as access_module
from tagmetry.live.server.access import Access


@pytest.fixture
def access() -> Access:
    return Access("127.0.0.1", 8765)


def test_the_token_is_long_and_new_every_time() -> None:
    tokens = {Access("127.0.0.1", 1).token for _ in range(50)}
    assert len(tokens) == 50
    assert all(len(token) * 6 >= 192 for token in tokens)


def test_a_session_is_not_the_token_and_makes_an_operator(access: Access) -> None:
    session = access.sign_in(access.token)
    assert session is not None
    assert session != access.token
    assert access.role(session) == "operator"
    assert access.role(access.token) == "viewer"


@pytest.mark.parametrize("session", [None, "", "x", "é", "\0", 1000 * "a"])
@pytest.mark.parametrize(("address", "role"), [("127.0.0.1", "viewer"), ("192.0.2.1", None)])
def test_without_a_session_one_may_look_on_this_computer_only(
    session: str | None, address: str, role: Role | None
) -> None:
    access = Access(address, 8765)
    access.sign_in(access.token)
    assert access.role(session) == role


def test_ten_wrong_tokens_close_the_door_for_a_minute(
    access: Access, monkeypatch: pytest.MonkeyPatch
) -> None:
    now_s = [100.0]
    monkeypatch.setattr(access_module.time, "monotonic", lambda: now_s[0])
    assert [access.sign_in("wrong é") for _ in range(10)] == [None] * 10
    assert access.sign_in(access.token) is None
    now_s[0] += 61
    assert access.sign_in(access.token) is not None


def test_old_sessions_end_when_there_are_too_many(access: Access) -> None:
    first = access.sign_in(access.token)
    for _ in range(64):
        access.sign_in(access.token)
    assert access.role(first) == "viewer"


@pytest.mark.parametrize("address", ["0.0.0.0", "::", "localhost", "", "evil.example", "127.1"])  # noqa: S104
def test_refuses_to_serve_at_what_is_no_single_interface(address: str) -> None:
    with pytest.raises(InputError, match=r"interface"):
        Access(address, 8765)


@pytest.mark.parametrize(
    ("address", "port", "host"),
    [
        ("127.0.0.1", 8765, "127.0.0.1:8765"),
        ("127.0.0.1", 8765, "localhost:8765"),
        ("127.0.0.1", 8765, "LOCALHOST:8765"),
        ("127.0.0.1", 80, "localhost"),
        ("::1", 8765, "[::1]:8765"),
        ("192.0.2.1", 8765, "192.0.2.1:8765"),
    ],
)
def test_knows_its_own_names(address: str, port: int, host: str) -> None:
    access = Access(address, port)
    assert access.is_own_host(host)
    assert access.is_own_origin(f"http://{host}")
    assert not access.is_own_origin(f"https://{host}")

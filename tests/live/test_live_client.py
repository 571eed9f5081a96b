"""The client for programs: it gets what was told, asks what it may, and drives while it is open."""

import asyncio
import time
from dataclasses import fields, is_dataclass, replace
from types import UnionType
from typing import Literal, get_args, get_origin, get_type_hints

import cv2
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from live_server import Served, eventually, served

from tagmetry.errors import InputError
from tagmetry.live.client import LiveClient
from tagmetry.live.client.mailbox import Mailbox
from tagmetry.live.client.reading import parse_told
from tagmetry.live.messages import (
    CONTRACT,
    Beat,
    FloorErrors,
    FollowPath,
    GoTo,
    Halt,
    LiveMarker,
    LiveRobot,
    MeasureErrors,
    Picture,
    Refused,
    Resume,
    Rule,
    SetParameter,
    Stop,
    World,
)
from tagmetry.live.messages.wire import packed
from tagmetry.live.server.hub import Hub

ROBOT = LiveRobot(
    3, "é <b>", 1.0, -0.5, 0.25, 0.0, 0.08, (1.0, 0.5, 0.1), 0.0, True, False, "", "walk",
    ((0.0, 1.0), (2.0, 3.0)), None, (1.0, -1.0), 8.1, 0.0, None, (1, 2),
)  # fmt: skip
JPEG = cv2.imencode(".jpg", np.full((12, 16), 200, np.uint8))[1].tobytes()
PICTURE = Picture(
    2.0, 3.0, 16, 12, (LiveMarker(3, ((0.0, 1.0), (2.0, 1.0)), (1.0, 0.5)),), JPEG
)  # fmt: skip
RULES = [rule for rule in CONTRACT if rule.sender == "server"]


def client(live: Served, *, operator: bool = True) -> LiveClient:
    return LiveClient(live.origin, live.access.token if operator else None)


def plain(hint: object) -> st.SearchStrategy[object]:
    """Return values of a field's type that JSON can tell apart."""
    inner = get_args(hint)
    if is_dataclass(hint) and isinstance(hint, type):
        hints = get_type_hints(hint)
        return st.builds(hint, **{field.name: plain(hints[field.name]) for field in fields(hint)})
    if get_origin(hint) is UnionType:
        return st.one_of(*map(plain, inner))
    if get_origin(hint) is Literal:
        return st.sampled_from(inner)
    if get_origin(hint) is tuple and inner[-1] is Ellipsis:
        return st.lists(plain(inner[0]), max_size=3).map(tuple)
    if get_origin(hint) is tuple:
        return st.tuples(*map(plain, inner))
    return SIMPLE[hint]


SIMPLE: dict[object, st.SearchStrategy[object]] = {
    float: st.floats(allow_nan=False, allow_infinity=False),
    int: st.integers(-(2**53), 2**53),
    str: st.text(max_size=20),
    bool: st.booleans(),
    bytes: st.binary(max_size=20),
    type(None): st.none(),
}


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
@settings(max_examples=15, suppress_health_check=[HealthCheck.too_slow])
@given(data=st.data())
def test_whatever_the_server_tells_survives_its_way(rule: Rule, data: st.DataObject) -> None:
    told = data.draw(plain(rule.message))
    assert parse_told(packed(told)) == told


def test_what_is_not_finite_is_nan() -> None:
    told = parse_told(
        packed(World(float("inf"), (replace(ROBOT, x_m=float("nan")),), (), True, ""))
    )
    assert isinstance(told, World)
    assert np.isnan([told.time_s, told.robots[0].x_m]).all()


def test_what_a_newer_server_adds_is_left_out() -> None:
    assert parse_told('{"type": "Weather", "rain": true}') is None
    assert parse_told('{"type": "Refused", "why": "no", "more": 1}') == Refused("no")


@pytest.mark.parametrize(
    ("frame", "told"),
    [
        ("", "JSON object"),
        ("[]", "JSON object"),
        (b"", "picture's length"),
        (b"\xff\xff\xff\xff{}", "picture's length"),
        ('{"type": "Refused"}', "Refused: expected an object with why"),
        ('{"type": "Refused", "why": 3}', "why: expected str, got 3"),
        ('{"type": "Welcome", "role": "king", "scenarios": [], "floor_m": [1, 1], "beat_s": 1}',
         "role: expected one of"),
        ('{"type": "Welcome", "role": "viewer", "scenarios": [], "floor_m": [1], "beat_s": 1}',
         "floor_m: expected a list of 2"),
    ],
)  # fmt: skip
def test_refuses_what_is_no_message(frame: str | bytes, told: str) -> None:
    with pytest.raises(InputError, match=told):
        parse_told(frame)


@given(st.text(max_size=100) | st.binary(max_size=100))
def test_no_frame_does_harm(frame: str | bytes) -> None:
    with pytest.raises(InputError):
        parse_told(frame)


def test_what_was_told_before_the_server_ran_waits_for_the_first_page() -> None:
    hub = Hub()
    hub.give(World(7.0, (), (), False, ""))
    frames = hub.join().frames()

    async def first() -> str | bytes:
        return await anext(frames)

    assert parse_told(asyncio.run(first())) == World(7.0, (), (), False, "")


def test_gets_the_newest_world_and_never_the_same_twice(live: Served) -> None:
    with client(live) as own:
        live.hub.give(World(1.0, (ROBOT,), (), False, ""))
        worlds = own.worlds(seconds=5.0)
        assert next(worlds).robots == (ROBOT,)
        for time_s in (2.0, 3.0, 4.0):
            live.hub.give(World(time_s, (), (), False, ""))
        eventually(lambda: own.world.time_s == 4.0)
        assert next(worlds).time_s == 4.0
        assert list(own.worlds(seconds=0.2)) == [own.world]


def test_pictures_are_arrays_and_the_next_one_is_asked_for(live: Served) -> None:
    with client(live) as own:
        live.hub.give(replace(PICTURE, taken_s=time.monotonic()))
        picture, pixels = next(own.pictures(seconds=5.0))
        assert (pixels.shape, pixels.dtype) == ((12, 16), np.uint8)
        assert abs(pixels.mean() - 200) < 2
        assert picture.markers == PICTURE.markers
        live.hub.give(replace(PICTURE, time_s=9.0))
        eventually(lambda: own._mail.count(Picture) >= 2)
        eventually(lambda: live.hub.delays.quantile_s(0.5) is not None)


def test_commands_arrive_as_messages(live: Served) -> None:
    with client(live) as own:
        own.stop("me")
        own.go_to(1, 0, 0.5)
        own.follow_path(2, np.array([[0.0, 1.0], [0.5, 0.25]]))
        own.halt(3)
        own.resume(3)
        own.set_parameter("gap_m", 1)
        want = [
            Stop("me"), GoTo(1, 0.0, 0.5), FollowPath(2, ((0.0, 1.0), (0.5, 0.25))), Halt(3),
            Resume(3), SetParameter("gap_m", 1.0),
        ]  # fmt: skip
        eventually(lambda: commands(live)[-6:] == want)


def commands(live: Served) -> list[object]:
    return [asked for _, asked in live.runner.asked if not isinstance(asked, Beat)]


def test_an_operator_says_that_it_is_there_until_it_is_closed(live: Served) -> None:
    with client(live):
        before = len(live.runner.asked)
        time.sleep(0.55)
        beats = [asked for _, asked in live.runner.asked[before:] if isinstance(asked, Beat)]
        assert 4 <= len(beats) <= 7
    left = len(live.runner.left)
    eventually(lambda: live.runner.viewers == 0)
    assert left <= len(live.runner.left)


def test_without_the_token_it_looks_and_may_stop_and_says_nothing_else(live: Served) -> None:
    with client(live, operator=False) as own:
        assert own.welcome.role == "viewer"
        before = len(live.runner.asked)
        own.stop()
        eventually(lambda: len(live.runner.asked) == before + 1)
        with pytest.raises(InputError, match="Release needs the token"):
            own.release()
        time.sleep(0.3)
        assert len(live.runner.asked) == before + 1


def test_the_error_map_is_waited_for(live: Served) -> None:
    with client(live) as own:
        live.hub.give(FloorErrors(False, 1.0, 0.0, ()))
        eventually(lambda: own._mail.count(FloorErrors) >= 1)
        with pytest.raises(InputError, match=r"not there after 0\.1 s"):
            own.measure_errors(seconds=0.1)
        assert commands(live)[-1] == MeasureErrors()


def test_a_server_that_is_gone_ends_what_waits() -> None:
    with served() as live:
        own = client(live)
    with pytest.raises(InputError, match="connection to the live page has ended"):
        list(own.worlds(seconds=5.0))
    with pytest.raises(InputError, match="connection to the live page has ended"):
        own.stop()
    own.close()


def test_a_wrong_token_is_refused_and_not_told(live: Served) -> None:
    with pytest.raises(InputError, match="does not take this token") as caught:
        LiveClient(live.origin, "a-wrong-token")
    assert "a-wrong-token" not in str(caught.value)


@pytest.mark.parametrize("url", ["", "127.0.0.1:1", "ftp://127.0.0.1:1/", "http://", "http://a@b/"])
def test_refuses_what_is_no_address(url: str) -> None:
    with pytest.raises(InputError, match="expected an address like"):
        LiveClient(url)


def test_says_that_nobody_answers() -> None:
    with pytest.raises(InputError, match="start one with `tagmetry live`"):
        LiveClient("http://127.0.0.1:9/")
    with pytest.raises(InputError, match="start one with `tagmetry live`"):
        LiveClient("http://127.0.0.1:notaport/", "token")


def test_the_mailbox_gives_up_when_time_is_over() -> None:
    mail = Mailbox()
    assert mail.after(World, 0, 0.05) is None
    assert mail.newest(World) is None
    mail.put(World(1.0, (), (), False, ""))
    assert mail.after(World, 0, 0.0) == (1, World(1.0, (), (), False, ""))
    mail.end("gone")
    with pytest.raises(InputError, match="gone"):
        mail.after(World, 1, 1.0)

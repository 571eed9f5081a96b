"""The contract: every message is declared once, survives its way, and nothing else is taken."""

import json
from dataclasses import fields
from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.errors import InputError
from tagmetry.live.messages import (
    CONTRACT,
    DRIVING,
    Asked,
    Beat,
    ChooseScenario,
    FollowPath,
    GoTo,
    Halt,
    LiveRobot,
    MeasureErrors,
    Picture,
    Release,
    Resume,
    Seen,
    SetParameter,
    StartRecording,
    Stop,
    StopRecording,
    Told,
    World,
)
from tagmetry.live.messages.wire import (
    MOST_BYTES,
    format_message,
    packed,
    parse_asked,
    split_picture,
)

ASKED = [
    Beat(), Seen(0.5), Stop(), Stop("a person"), Release(), GoTo(3, -0.5, 0.25), Resume(3),
    FollowPath(3, ((0.0, 0.5), (-1.0, 0.25))), Halt(3), SetParameter("gap_m", 0.1),
    ChooseScenario("disperse", 5), MeasureErrors(), StartRecording(), StopRecording(),
]  # fmt: skip


def test_every_message_is_declared_once_with_its_sender() -> None:
    declared = {rule.message: rule.sender for rule in CONTRACT}
    assert len(declared) == len(CONTRACT)
    expected = dict.fromkeys(get_args(Told), "server") | dict.fromkeys(get_args(Asked), "page")
    assert declared == expected


def test_all_that_a_page_may_ask_needs_the_operator_but_to_see_and_stop() -> None:
    free = {rule.message for rule in CONTRACT if rule.sender == "page" and rule.role == "viewer"}
    assert free == {Seen, Stop}


def test_what_lets_robots_move_is_driving() -> None:
    assert set(DRIVING) == {Release, GoTo, FollowPath, Resume, SetParameter, ChooseScenario}


@pytest.mark.parametrize("asked", ASKED, ids=lambda one: type(one).__name__)
def test_what_a_page_asks_survives_its_way(asked: Asked) -> None:
    assert parse_asked(format_message(asked), "operator") == asked


@pytest.mark.parametrize("asked", ASKED, ids=lambda one: type(one).__name__)
def test_a_viewer_is_refused_whatever_it_asks_but_a_stop(asked: Asked) -> None:
    if isinstance(asked, Stop | Seen):
        assert parse_asked(format_message(asked), "viewer") == asked
        return
    with pytest.raises(InputError, match="needs the operator's role"):
        parse_asked(format_message(asked), "viewer")


def test_what_the_server_tells_is_plain_json() -> None:
    robot = LiveRobot(
        1, "<img onerror>", 1.0, float("nan"), 0.5, 0.1, 0.08, (1.0, 0.5, float("inf")), 0.0,
        True, False, "", "own", (), (1.0, 2.0, 3.0), (0.5, -0.5), None, 0.0, None, (2, 3),
    )  # fmt: skip
    told = json.loads(format_message(World(2.5, (robot,), ("b",), False, "")))
    assert told["type"] == "World"
    (one,) = told["robots"]
    assert set(one) == {field.name for field in fields(LiveRobot)}
    assert (one["name"], one["y_m"], one["ellipse"]) == ("<img onerror>", None, [1.0, 0.5, None])


def test_a_picture_follows_its_json() -> None:
    picture = Picture(1.5, 7.0, 960, 540, (), b"\xff\xd8 picture")
    text, jpeg = split_picture(packed(picture))
    assert jpeg == picture.jpeg
    told = json.loads(text)
    assert (told["type"], told["time_s"], told["taken_s"], told["width_px"]) == (
        "Picture", 1.5, 7.0, 960,
    )  # fmt: skip
    assert packed(world := World(0.0, (), (), True, "")) == format_message(world)


@pytest.mark.parametrize("content", [b"", b"\1", b"\0\0\0\0", b"\5\0\0\0{}", b"\xff\xff\xff\xff{}"])
def test_refuses_what_is_no_picture(content: bytes) -> None:
    with pytest.raises(InputError, match="a picture's length, JSON and file"):
        split_picture(content)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "JSON object"),
        ("[]", "type"),
        ("{}", "type"),
        ('{"type": 3}', "type"),
        ('{"type": "Fly"}', "one of Beat, Seen, Stop"),
        ('{"type": "World"}', "a page does not send World"),
        ('{"type": "GoTo", "robot_id": 1, "x_m": 0}', "y_m"),
        ('{"type": "GoTo", "robot_id": 1.5, "x_m": 0, "y_m": 0}', "robot_id"),
        ('{"type": "GoTo", "robot_id": "1", "x_m": 0, "y_m": 0}', "robot_id"),
        ('{"type": "GoTo", "robot_id": 1, "x_m": NaN, "y_m": 0}', "JSON object"),
        ('{"type": "GoTo", "robot_id": 1, "x_m": 1e999, "y_m": 0}', "x_m"),
        ('{"type": "FollowPath", "robot_id": 1, "points_m": [[0]]}', "points_m"),
        ('{"type": "FollowPath", "robot_id": 1, "points_m": [[0, null]]}', "points_m"),
        ('{"type": "FollowPath", "robot_id": 1, "points_m": 3}', "points_m"),
        ('{"type": "SetParameter", "name": "gap_m", "value": "x"}', "value"),
        ('{"type": "Beat", "more": 1}', "more"),
        ('{"type": "Stop", "why": "' + 200 * "x" + '"}', "why"),
        ('{"type": "Stop", "why": "' + MOST_BYTES * "x" + '"}', "at most 1024 bytes"),
        (500 * "[", "JSON object"),
    ],
)
def test_refuses_what_is_no_message(text: str, told: str) -> None:
    with pytest.raises(InputError, match=told):
        parse_asked(text, "operator")


@given(st.text(max_size=200))
def test_no_text_does_harm(text: str) -> None:
    with pytest.raises(InputError):
        parse_asked(text, "operator")

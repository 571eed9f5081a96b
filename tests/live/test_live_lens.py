"""The lens room: a marker is measured to the truth, in bounds; the bank is told; one drive."""

import json
import math
import re

import pytest
from live_server import eventually, served

from tagmetry.errors import InputError
from tagmetry.live.messages import Told
from tagmetry.live.rooms.every import Furniture
from tagmetry.live.rooms.lens.bank import bank_table
from tagmetry.live.rooms.lens.messages import LensPicture, LensTrace, StartLens, StopLens
from tagmetry.live.rooms.lens.room import lens_room
from tagmetry.live.rooms.lens.scene import true_depth_m
from tagmetry.live.rooms.room import Room

WAITS_S = 240.0  # on a busy computer


class Heard:
    """Remembers what the room tells."""

    def __init__(self) -> None:
        self.traces: list[LensTrace] = []
        self.pictures: list[LensPicture] = []

    def __call__(self, message: Told) -> None:
        kept = self.pictures if isinstance(message, LensPicture) else self.traces
        kept.append(message)

    def ended(self) -> bool:
        return bool(self.traces) and self.traces[-1].phase == "ended"


def asked(room: Room, message: object) -> None:
    room.takers[type(message)](message)


@pytest.fixture(scope="module")
def heard() -> Heard:
    """Return what a room told while it measured a marker that stands."""
    heard = Heard()
    room = lens_room(heard)
    asked(room, StartLens(0.3, 20.0, False))
    with pytest.raises(InputError, match="being driven already"):
        asked(room, StartLens(0.3, 20.0, False))
    eventually(heard.ended, WAITS_S)
    room.close()
    return heard


def test_measures_the_depth_within_its_own_uncertainty(heard: Heard) -> None:
    last = heard.traces[-1]
    assert last.converged_s > 0, last.why
    points = [one for one in last.points if math.isfinite(one.depth_m)]
    assert abs(points[-1].depth_m - 0.3) < 4 * points[-1].depth_sd_m
    assert points[-1].depth_sd_m < 0.003
    assert {one.true_m for one in last.points} == {0.3}


def test_tells_every_image_and_some_pictures(heard: Heard) -> None:
    told = [one.images for one in heard.traces]
    assert told == sorted(told)
    assert set(range(1, told[-1] + 1)) <= set(told)
    assert heard.pictures
    assert all(one.jpeg[:2] == b"\xff\xd8" and one.width_px == 960 for one in heard.pictures)


def test_a_moving_marker_is_followed_until_somebody_stops_it() -> None:
    heard = Heard()
    room = lens_room(heard)
    asked(room, StartLens(0.4, 0.0, True))
    eventually(lambda: any(one.phase == "track" for one in heard.traces), WAITS_S)
    asked(room, StopLens())
    eventually(heard.ended, WAITS_S)
    assert heard.traces[-1].why == "stopped by hand"
    room.close()


def test_the_marker_moves_about_where_it_was_put() -> None:
    swings = [true_depth_m(StartLens(0.4, 0.0, True), n / 10) for n in range(80)]
    assert min(swings) == pytest.approx(0.34, abs=1e-3)
    assert max(swings) == pytest.approx(0.46, abs=1e-3)
    assert true_depth_m(StartLens(1.05, 0.0, True), 2.0) == 1.05  # never farther than is looked


@pytest.mark.parametrize(
    ("message", "why"),
    [
        (StartLens(0.01, 0.0, False), "expected a depth of 0.05 to 1.05 m"),
        (StartLens(2.0, 0.0, True), "expected a depth of 0.05 to 1.05 m"),
        (StartLens(0.4, -66.0, False), "a turn of at most 65 degrees"),
        (StartLens(float("nan"), 0.0, False), "expected a depth"),
        (StopLens(), "the lens is not being driven"),
    ],
)
def test_what_cannot_be_done_is_refused(message: object, why: str) -> None:
    room = lens_room(Heard())
    with pytest.raises(InputError, match=re.escape(why)):
        asked(room, message)


def test_the_bank_and_the_focus_curve_are_told() -> None:
    with served(furniture=Furniture()) as live:
        eventually(lambda: live.ask("GET", "/lens/bank")[0] == 200, WAITS_S)
        status, _, body = live.ask("GET", "/lens/bank")
    told = json.loads(body)
    assert status == 200
    assert told == json.loads(json.dumps(bank_table()))
    focuses = [one["focus"] for one in told["nodes"]]
    assert focuses == sorted(focuses)
    assert (focuses[0], focuses[-1]) == (0.0, 150.0)
    values = [focus for _, focus in told["curve"]]
    assert values == sorted(values, reverse=True)  # nearer is a larger focus value

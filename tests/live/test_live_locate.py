"""The locate room: places are as sure as they say, residuals are those of the noise, bounds."""

import re
from itertools import islice

import numpy as np
import pytest
from live_server import eventually

from tagmetry.errors import InputError
from tagmetry.live.rooms.locate.messages import LocateTrace, StartLocate, StopLocate
from tagmetry.live.rooms.locate.room import locate_room
from tagmetry.live.rooms.locate.told import told_marker, told_point, told_residuals
from tagmetry.live.rooms.locate.walk import Looked, Walk
from tagmetry.live.rooms.room import Room

NOISE_PX = 0.1
WAITS_S = 120.0  # on a busy computer


@pytest.fixture(scope="module")
def walk() -> Walk:
    return Walk(NOISE_PX, seed=5)


@pytest.fixture(scope="module")
def looked(walk: Walk) -> list[Looked]:
    return list(islice(walk.looks(), 16))


def test_places_are_as_sure_as_they_say(looked: list[Looked]) -> None:
    """Sixteen times six squared normal numbers: 6 on average, with a deviation of 0.87."""
    points = [told_point(one, one.pose.best) for one in looked]
    assert 3.0 < np.mean([one.mahalanobis2 for one in points]) < 9.5
    for one in points:
        off_m = np.array([one.x_m, one.y_m, one.z_m]) - one.true_m
        assert (np.abs(off_m) < 5 * np.array(one.sd_m)).all()
        assert max(one.sd_m) < 0.02


def test_the_camera_looks_where_the_markers_are(looked: list[Looked], walk: Walk) -> None:
    point = told_point(looked[0], looked[0].pose.best)
    seen = {one.id for one in looked[0].detections}
    middles = [
        np.add(one.left_m, one.right_m) / 2
        for one in map(told_marker, walk.marker_map.markers)
        if one.id in seen
    ]
    ahead = np.array([np.cos(point.heading_rad), np.sin(point.heading_rad)])
    assert all((middle - [point.x_m, point.y_m]) @ ahead > 0 for middle in middles)


def test_markers_are_as_wide_from_above_as_they_are(walk: Walk) -> None:
    told = [told_marker(one) for one in walk.marker_map.markers]
    assert len({one.id for one in told}) == len(told) == 12
    widths = [np.linalg.norm(np.subtract(one.left_m, one.right_m)) for one in told]
    np.testing.assert_allclose(
        widths, [one.size_m for one in walk.marker_map.markers], rtol=5e-3
    )  # hung a little askew


def test_residuals_are_those_of_the_noise(looked: list[Looked], walk: Walk) -> None:
    told = [told_residuals(one, one.pose.best, walk.marker_map) for one in looked]
    rms_px = np.array([one.rms_px for of_image in told for one in of_image if one.is_used])
    assert 0.4 * NOISE_PX < np.sqrt((rms_px**2).mean()) < 2**0.5 * NOISE_PX
    assert all(one.why for of_image in told for one in of_image if not one.is_used)


def asked(room: Room, message: object) -> None:
    room.takers[type(message)](message)


def test_is_carried_until_somebody_stops_it() -> None:
    told: list[LocateTrace] = []
    room = locate_room(told.append)
    asked(room, StartLocate(NOISE_PX))
    with pytest.raises(InputError, match="being carried already"):
        asked(room, StartLocate(NOISE_PX))
    eventually(lambda: told and len(told[-1].path) >= 2, WAITS_S)
    asked(room, StopLocate())
    eventually(lambda: not told[-1].is_running, WAITS_S)
    assert told[-1].why == "stopped by hand"
    assert len(told[-1].markers) == 12
    room.close()


@pytest.mark.parametrize(
    ("message", "why"),
    [
        (StartLocate(0.0), "expected a noise of 0.01 to 2.0 px, got 0"),
        (StartLocate(3.0), "expected a noise of 0.01 to 2.0 px"),
        (StartLocate(float("nan")), "expected a noise"),
        (StopLocate(), "the camera is not being carried"),
    ],
)
def test_what_cannot_be_done_is_refused(message: object, why: str) -> None:
    room = locate_room(lambda _: None)
    with pytest.raises(InputError, match=re.escape(why)):
        asked(room, message)

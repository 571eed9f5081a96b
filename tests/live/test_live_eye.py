"""The live camera: what is measured, what is shown, and that both are of the same moment."""

import threading
import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import cv2
import numpy as np
import pytest
from live_server import eventually

from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.live.messages import Picture
from tagmetry.live.show.eye import Look, WatchedEye
from tagmetry.live.show.feed import Feed
from tagmetry.live.show.painter import Painter, measured
from tagmetry.live.show.programme import Programme
from tagmetry.live.show.recording import Recordings
from tagmetry.live.show.runner import LiveRunner
from tagmetry.live.show.seeing import seeing
from tagmetry.live.show.stage import Performance, performance
from tagmetry.pipeline.arena_twin import Moment
from tagmetry.pipeline.arena_twin.ready import ready_scenario

HERE = RigidTransform.from_components([[0.0, 0.0, 0.0]], Rotation.identity(1))


class Blind:
    """An eye that sees nothing."""

    def look(self, time_s: float, Ts_world_robot: RigidTransform) -> tuple[()]:  # noqa: ARG002
        return ()


def test_waits_for_a_look_that_is_newer() -> None:
    eye = WatchedEye(Blind())
    assert eye.later(None, 0.01) is None
    eye.look(1.0, HERE)
    first = eye.later(None, 0.01)
    assert first is not None
    assert (first.time_s, first.pixels) == (1.0, None)
    assert 0 <= time.monotonic() - first.taken_s < 5
    assert eye.later(first, 0.01) is None
    threading.Timer(0.05, eye.look, (2.0, HERE)).start()
    second = eye.later(first, 5.0)
    assert second is not None
    assert second.time_s == 2.0


def test_paints_looks_that_came_after_it_was_ready_and_none_twice() -> None:
    eye, shown = WatchedEye(Blind()), []
    eye.look(1.0, HERE)
    ready = threading.Event()

    def prepare():
        ready.set()
        return lambda _: np.zeros((2, 2), np.uint8)

    painter = Painter(eye, prepare, lambda look, _: shown.append(look.time_s))
    ready.wait(5)
    time.sleep(0.05)
    for number in range(2, 40):
        eye.look(float(number), HERE)
        time.sleep(0.01)
    painter.close()
    assert len(shown) >= 2
    assert shown[0] > 1.0
    assert shown == sorted(set(shown))
    assert len(shown) < 10  # no more often than people can use


def test_there_is_no_picture_where_corners_were_measured() -> None:
    with pytest.raises(InputError, match="measures corners alone"):
        measured(Look(0.0, 0.0, 0.0, HERE, ()))


def test_corners_are_measured_as_often_as_the_scenario_says() -> None:
    assert seeing("corners", ready_scenario("aggregate", 2)).image_rate_hz == 30.0


@pytest.fixture(scope="module")
def by_pictures() -> Iterator[tuple[Performance, Moment, list[tuple[Look, AnyPixels]]]]:
    """Give a show that measures pictures, its first moment, and what was painted of it."""
    given: list[tuple[Look, AnyPixels]] = []
    scenario = ready_scenario("aggregate", 3)
    with closing(
        performance(
            "aggregate", scenario, lambda look, pixels: given.append((look, pixels)), "pictures"
        )
    ) as show:
        first = next(show.arena.run(1.0))
        eventually(lambda: given)
        yield show, first, given


def test_pictures_are_measured_by_the_detector_as_often_as_the_computer_affords(
    by_pictures,
) -> None:
    show, first, given = by_pictures
    assert 2.0 <= show.arena.scenario.image_rate_hz <= 30.0
    assert {one.id for one in first.detections} == {0, 1, 2}
    for state in first.turn.step.world:
        true = first.places[state.id]
        assert np.hypot(state.x_m - true.x_m, state.y_m - true.y_m) < 0.002
    look, pixels = given[-1]
    assert pixels is look.pixels
    assert pixels.shape == (1080, 1920)
    assert np.std(pixels[500:520, 500:520].astype(float)) > 1.0  # a sensor's noise


def test_the_markers_lie_where_the_painted_picture_shows_them(tmp_path: Path) -> None:
    pictures: list[Picture] = []

    def take(message: object) -> None:
        if isinstance(message, Picture):
            pictures.append(message)

    with LiveRunner(Programme("aggregate", 3, tmp_path, eye="corners"), take):
        eventually(lambda: len(pictures) >= 2, 60)
    check_markers(pictures[-1])


def test_the_markers_lie_where_the_measured_picture_shows_them(by_pictures, tmp_path: Path) -> None:
    show, _, given = by_pictures
    pictures: list[Picture] = []
    Feed(pictures.append, Recordings(tmp_path)).picture(*given[-1], show)
    check_markers(pictures[-1])


def check_markers(shown: Picture) -> None:
    """Check that every marker's black frame lies within its corners, and paper around."""
    pixels = cv2.imdecode(np.frombuffer(shown.jpeg, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert pixels.shape == (shown.height_px, shown.width_px) == (540, 960)
    assert len(shown.markers) == 3
    for one in shown.markers:
        corners = np.array(one.corners_px)
        middle = corners.mean(axis=0)
        inside, outside = (pixels_at(pixels, middle + f * (corners - middle)) for f in (0.9, 1.15))
        assert inside.mean() < 0.6 * outside.mean()


def pixels_at(pixels: np.ndarray, places: np.ndarray) -> np.ndarray:
    columns, rows = np.rint(places).astype(int).T
    return pixels[rows, columns].astype(float)

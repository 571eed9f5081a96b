"""Calibration on the page: the twin's camera is found, in bounds, and saved under checked names."""

import re
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from live_server import eventually, served

from tagmetry.calibrate.guidance import Plan, Session
from tagmetry.calibrate.targets import explain_board
from tagmetry.calibrate.view import BoardView
from tagmetry.camera import Image
from tagmetry.errors import InputError
from tagmetry.files import load_camera
from tagmetry.live.messages import Told
from tagmetry.live.rooms.calibrate.cameras import PRACTICE_CAMERA, Practice, opened_camera
from tagmetry.live.rooms.calibrate.hand import Hand
from tagmetry.live.rooms.calibrate.messages import (
    CalibrationPicture,
    CalibrationState,
    EndCalibration,
    SaveCalibration,
    StartCalibration,
)
from tagmetry.live.rooms.calibrate.room import calibrate_room
from tagmetry.live.rooms.calibrate.solved import checked_name
from tagmetry.live.rooms.room import Room
from tagmetry.markers import CharucoBoard
from tagmetry.record import open_overlay

BOARD = CharucoBoard(7, 5, 0.030, 0.022, "5x5_100")
LINE = "charuco:7x5:30mm:22mm:5x5_100"
WAITS_S = 240.0  # on a busy computer


class Heard:
    """Remembers what the room tells."""

    def __init__(self) -> None:
        self.states: list[CalibrationState] = []
        self.pictures: list[CalibrationPicture] = []

    def __call__(self, message: Told) -> None:
        kept = self.pictures if isinstance(message, CalibrationPicture) else self.states
        kept.append(message)

    def state(self) -> CalibrationState:
        return self.states[-1]


def asked(room: Room, message: object) -> None:
    room.takers[type(message)](message)


def test_the_hand_shows_the_board_where_it_is_wanted() -> None:
    session = Session.begin(Plan(BOARD, PRACTICE_CAMERA.size_px, 0.5))
    hand = Hand(BOARD, PRACTICE_CAMERA, seed=1)
    for _ in range(4):
        hand.follow(session)
    x, y = BOARD.width_m / 2, BOARD.height_m / 2
    corners_m = np.array([[-x, y, 0], [x, y, 0], [x, -y, 0], [-x, -y, 0]])
    shown_px = PRACTICE_CAMERA.project(hand.pose().apply(corners_m))
    wanted_px = session.next.outline_px[::12]
    assert np.abs(shown_px - wanted_px).max() < 60  # it misses a little, as people do
    before = hand.pose().as_matrix()
    hand.follow(session)
    np.testing.assert_array_equal(hand.pose().as_matrix(), before)  # it holds still
    for _ in range(7):
        hand.follow(session)
    assert np.abs(hand.pose().as_matrix() - before).max() > 1e-4  # and tries again


def test_the_simulated_camera_shows_the_board_where_it_is() -> None:
    practice = Practice(BOARD, seed=3)
    image = next(practice.images())
    found = explain_board(image.pixels, BOARD).result
    assert isinstance(found, BoardView)
    true_px = PRACTICE_CAMERA.project(practice._hand.pose().apply(BOARD.corners_m[found.points]))
    assert np.sqrt(((found.corners_px - true_px) ** 2).sum(axis=1).mean()) < 0.2


@pytest.fixture(scope="module")
def told() -> Heard:
    return Heard()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("page") / "cameras"


@pytest.fixture(scope="module")
def room(told: Heard, folder: Path) -> Room:
    """Return a room in which the twin's camera was calibrated from a few views."""
    room = calibrate_room(told, "twin", folder)
    asked(room, StartCalibration(LINE, "0.5px"))
    with pytest.raises(InputError, match="runs already"):
        asked(room, StartCalibration(LINE, "0.5px"))
    eventually(lambda: len(told.state().uncertainty_px) >= 4, WAITS_S)
    asked(room, EndCalibration())
    eventually(lambda: told.state().phase in ("done", "failed"), WAITS_S)
    yield room
    room.close()


def test_finds_the_twins_camera_within_its_own_uncertainty(room: Room, told: Heard) -> None:
    result = told.state().result
    assert result is not None, told.state()
    numbers = {one.name: one for one in result.numbers}
    true = {"fx": 520.0, "fy": 520.0, "cx": 324.6, "cy": 236.9, "k1": -0.21}
    for name, value in true.items():
        assert abs(numbers[name].value - value) < 6 * numbers[name].sd + 1e-3 * abs(value)
    assert result.rms_px < 0.1
    assert result.hold_out_px < 0.2
    assert result.words


def test_tells_pictures_with_corners_and_the_outline(room: Room, told: Heard) -> None:
    assert told.pictures
    seen = [one for one in told.pictures if one.corners_px]
    assert seen
    assert all(one.jpeg[:2] == b"\xff\xd8" for one in told.pictures)
    corners = np.array(seen[-1].corners_px)
    assert ((corners >= 0) & (corners <= (640, 480))).all()
    assert len(seen[-1].outline_px) >= 4


def test_coverage_counts_every_corner_of_the_views(room: Room, told: Heard) -> None:
    coverage = np.array(told.state().coverage)
    assert coverage.shape == (6, 8)
    views = len(told.state().uncertainty_px)
    assert 12 * views <= coverage.sum() <= len(BOARD.corners_m) * views


def test_saves_a_camera_once_under_a_name(room: Room, told: Heard, folder: Path) -> None:
    asked(room, SaveCalibration("door_1"))
    eventually(lambda: told.state().saved == "door_1")
    camera = load_camera(folder / "door_1.yaml")
    fx = next(one for one in told.state().result.numbers if one.name == "fx")
    assert camera.focal_px[0] == pytest.approx(fx.value, rel=1e-9)
    assert camera.provenance is not None
    assert LINE in camera.provenance
    assert (folder / "door_1.html").read_text().startswith("<!doctype html>")
    written = (folder / "door_1.yaml").read_bytes()
    asked(room, SaveCalibration("door_1"))
    eventually(lambda: "there is door_1.yaml already" in told.state().why)
    assert (folder / "door_1.yaml").read_bytes() == written


def test_follows_no_link_out_of_the_folder(room: Room, told: Heard, folder: Path) -> None:
    folder.mkdir(exist_ok=True)
    (folder / "away.yaml").symlink_to(folder.parent / "outside.yaml")
    asked(room, SaveCalibration("away"))
    eventually(lambda: "there is away.yaml already" in told.state().why)
    assert not (folder.parent / "outside.yaml").exists()


NAMES = ["", ".", "..", "a/b", "../a", "a.yaml", "-a", "a b", "a\x00", "ä", "a" * 41, "C:a", "~a"]


@pytest.mark.parametrize("name", NAMES)
def test_a_name_that_is_no_plain_one_is_refused(room: Room, name: str) -> None:
    with pytest.raises(InputError, match="expected a name of 1 to 40 letters"):
        asked(room, SaveCalibration(name))


def test_plain_names_are_taken() -> None:
    assert [checked_name(one) for one in ("a", "Cam-2_b", "9" * 40)] == ["a", "Cam-2_b", "9" * 40]


@pytest.fixture
def empty(tmp_path: Path) -> Callable[[str], tuple[Room, Heard]]:
    def make(camera: str) -> tuple[Room, Heard]:
        told = Heard()
        return calibrate_room(told, camera, tmp_path), told

    return make


@pytest.mark.parametrize(
    ("message", "why"),
    [
        (StartCalibration("poster:1x1", "0.5px"), "expected a board as"),
        (StartCalibration("chessboard:80x80:1mm", "0.5px"), "up to 1500 corners, got 6400"),
        (StartCalibration(LINE, "often"), "expected an uncertainty above 0"),
        (StartCalibration(LINE, "nan"), "expected an uncertainty above 0"),
        (EndCalibration(), "no calibration runs"),
        (SaveCalibration("a"), "no camera to save yet"),
    ],
)
def test_what_cannot_be_done_is_refused(empty, message: object, why: str) -> None:
    room, told = empty("twin")
    with pytest.raises(InputError, match=re.escape(why)):
        asked(room, message)
    assert not told.states
    room.close()


def test_a_camera_that_is_not_there_is_told_in_words(empty) -> None:
    room, told = empty("nowhere/at-all.mp4")
    asked(room, StartCalibration(LINE, "0.5px"))
    eventually(lambda: told.states and told.state().phase == "failed")
    assert "nowhere" in told.state().why
    room.close()


@pytest.fixture(scope="module")
def video(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a video of the simulated camera, as a hand holds the board still in four places."""
    practice, path = Practice(BOARD), tmp_path_factory.mktemp("video") / "board.mp4"
    session = Session.begin(Plan(BOARD, PRACTICE_CAMERA.size_px, 0.3))
    with open_overlay(path) as video:
        for image in practice.images():
            video.write(replace(image, pixels=np.dstack([image.pixels] * 3)))
            found = explain_board(image.pixels, BOARD)
            if isinstance(found.result, BoardView):
                session = session.step(found.result, image.time_s, found.quality)
            else:
                session = session.step(found.result.reason, image.time_s)
            practice.follow(session)
            if len(session.uncertainty_px) == 4:
                return path
    raise AssertionError("the simulated camera ended")


def test_a_camera_that_is_lost_is_told_and_solved_from_what_was_seen(empty, video: Path) -> None:
    room, told = empty(str(video))
    asked(room, StartCalibration(LINE, "0.01px"))
    eventually(lambda: told.states and told.state().phase in ("done", "failed"), WAITS_S)
    assert told.state().phase == "done", told.state().why
    assert told.state().why == "the camera gives no more images"
    fx = next(one for one in told.state().result.numbers if one.name == "fx")
    assert abs(fx.value - 520.0) < 6 * fx.sd + 2.0
    room.close()


def test_a_camera_that_is_lost_too_early_leaves_none(
    empty, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(self: Practice) -> Iterator[Image]:
        yield Image(np.zeros((480, 640), np.uint8), 0.0, "capture")
        raise OSError("no such device any more")

    monkeypatch.setattr(Practice, "images", broken)
    room, told = empty("twin")
    asked(room, StartCalibration(LINE, "0.5px"))
    eventually(lambda: told.states and told.state().phase == "failed")
    assert told.state().why.startswith("the camera was lost: no such device any more; a camera")
    room.close()


def test_pictures_on_disk_are_no_camera(tmp_path: Path) -> None:
    import cv2

    cv2.imwrite(str(tmp_path / "one.png"), np.zeros((8, 8), np.uint8))
    with pytest.raises(InputError, match="expected a camera, a stream or a video"):
        opened_camera(str(tmp_path), BOARD)


def test_ended_without_views_says_how_many_are_needed(empty) -> None:
    room, told = empty("twin")
    asked(room, StartCalibration(LINE, "0.5px"))
    asked(room, EndCalibration())
    eventually(lambda: told.state().phase == "failed", 60)
    assert "needs at least 3 views, 0 were taken" in told.state().why
    asked(room, StartCalibration(LINE, "0.5px"))  # another one may begin
    began_s = time.monotonic()
    room.close()
    assert time.monotonic() - began_s < 10


def test_the_report_is_a_file_and_not_before_there_is_one() -> None:
    with served() as live:
        assert live.ask("GET", "/calibrate/report")[0] == 409


def test_a_16_bit_picture_is_sent_in_8_bits() -> None:
    from tagmetry.live.rooms.calibrate.told import told_picture

    session = Session.begin(Plan(BOARD, PRACTICE_CAMERA.size_px, 0.5))
    image = next(Practice(BOARD).images())
    deep = replace(image, pixels=image.pixels.astype(np.uint16) * 257)
    assert told_picture(deep, session).jpeg == told_picture(image, session).jpeg

"""The room of recordings: what was told is told again, and only what the list names is touched."""

import errno
import json
import time
from pathlib import Path

import numpy as np
import pytest
from live_server import Served, eventually

from tagmetry.arena import RobotState, WorldState
from tagmetry.camera import Image
from tagmetry.live.messages import LiveMarker, Picture, World
from tagmetry.live.messages.wire import split_picture
from tagmetry.live.show.recording import Recordings
from tagmetry.record.mcap import Recorder
from tagmetry.record.mcap.pieces import PieceWriter

NAME = "one.mcap"
MARKER = LiveMarker(3, ((1.0, 2.0), (3.0, 4.0), (5.0, 6.0), (7.0, 8.0)), (9.0, 10.0))


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a recording of one second: worlds, and every other time a picture."""
    folder = tmp_path_factory.mktemp("recorded")
    recordings = Recordings(folder)
    recordings.start()
    name = recordings.name
    for number in range(20):
        recordings.told(World(float(number), (), (f"<b>{number}</b>",), number > 10, "x"))
        if number % 2:
            pixels = np.full((48, 64), 10 * number, np.uint8)
            recordings.image(Image(pixels, float(number), "capture", source="twin"))
            recordings.told(Picture(float(number), 0.0, 64, 48, (MARKER,), b""))
        time.sleep(0.05)
    recordings.close()
    assert recordings.failure == ""
    return folder / str(name)


@pytest.fixture
def folder(live: Served, recorded: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / NAME).write_bytes(recorded.read_bytes())
    monkeypatch.setattr(live.runner, "recordings", tmp_path)
    return tmp_path


def test_a_disk_that_becomes_full_is_told_at_once_and_until_the_next_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    recordings = Recordings(tmp_path)
    recordings.start()
    assert recordings.failure == ""
    with monkeypatch.context() as broken:
        broken.setattr(PieceWriter, "write", full)
        recordings.told(World(0.0, (), (), False, ""))
        eventually(lambda: "No space left" in recordings.failure)
    recordings.close()
    assert "No space left" in recordings.failure
    recordings.start()
    assert recordings.failure == ""
    recordings.close()


def asked(live: Served, what: str, name: str = NAME) -> tuple[int, bytes]:
    status, _, body = live.ask("GET", f"/recordings/{name}/{what}", Cookie=live.session())
    return status, body


def test_tells_again_what_was_told(live: Served, folder: Path) -> None:
    status, body = asked(live, "length")
    length_s = json.loads(body)["length_s"]
    assert status == 200
    assert 0.9 < length_s < 5.0
    told = [
        json.loads(asked(live, f"world?at={at_s}")[1]) for at_s in (0.0, length_s / 2, length_s)
    ]
    assert [one["type"] for one in told] == ["World"] * 3
    assert (told[0]["time_s"], told[-1]["time_s"]) == (0.0, 19.0)
    assert 5 < told[1]["time_s"] < 15
    assert told[-1]["missing"] == ["<b>19</b>"]
    assert told[-1]["is_stopped"]


def test_shows_again_what_was_seen(live: Served, folder: Path) -> None:
    import cv2

    status, body = asked(live, "picture?at=1000")
    text, jpeg = split_picture(body)
    told = json.loads(text)
    pixels = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert status == 200
    assert (told["type"], told["time_s"], told["width_px"]) == ("Picture", 19.0, 64)
    assert told["markers"][0]["robot_id"] == 3
    assert pixels.shape == (48, 64)
    assert abs(float(pixels.mean()) - 190) < 3
    assert asked(live, "picture?at=0")[0] == 204  # no picture yet


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a recording as `tagmetry arena run --record` writes it: states and lossless images."""
    path = tmp_path_factory.mktemp("run") / NAME
    with Recorder(path) as recorder:
        for number in range(10):
            covariance = np.diag([4e-6, 1e-6, 1e-4, 1e-4, 1e-4])
            robot = RobotState(
                7, "<i>", 0.1 * number, -0.2, 0.3, 0.4, 0.0, covariance, 0.0, True, float(number)
            )
            recorder.state(WorldState(float(number), (robot,)))
            recorder.image(Image(np.full((50, 2000), 10 * number, np.uint8), number, "capture"))
            time.sleep(0.02)
    return path


def test_a_run_that_no_page_saw_is_seen_as_well(live: Served, folder: Path, run: Path) -> None:
    import cv2

    (folder / NAME).write_bytes(run.read_bytes())
    first, last = (json.loads(asked(live, f"world?at={at_s}")[1]) for at_s in (0, 1000))
    assert (first["time_s"], last["time_s"]) == (0.0, 9.0)
    robot = last["robots"][0]
    assert (robot["id"], robot["name"], robot["is_seen"]) == (7, "<i>", True)
    assert robot["x_m"] == pytest.approx(0.9)
    assert robot["ellipse"][:2] == pytest.approx([2e-3, 1e-3])
    assert robot["battery_v"] is None
    text, jpeg = split_picture(asked(live, "picture?at=1000")[1])
    pixels = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE)
    told = json.loads(text)
    assert (told["time_s"], told["width_px"], told["height_px"]) == (9.0, 1000, 25)
    assert told["markers"] == []
    assert pixels.shape == (25, 1000)
    assert abs(float(pixels.mean()) - 90) < 2


def test_markers_are_shown_on_their_own_picture_or_not_at_all(
    live: Served, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    recordings = Recordings(tmp_path)
    recordings.start()
    pixels = np.zeros((48, 64), np.uint8)
    recordings.image(Image(pixels, 1.0, "capture", source="twin"))
    recordings.told(Picture(1.0, 0.0, 64, 48, (MARKER,), b""))
    time.sleep(0.4)
    recordings.told(Picture(2.0, 0.0, 64, 48, (MARKER,), b""))  # its image was dropped
    name = str(recordings.name)
    recordings.close()
    monkeypatch.setattr(live.runner, "recordings", tmp_path)
    assert asked(live, "picture?at=0.1", name)[0] == 200
    assert asked(live, "picture?at=9", name)[0] == 204


@pytest.mark.parametrize("at", ["x", "nan", "inf", "1e999", 400 * "1", ""])
def test_refuses_what_is_no_moment(live: Served, folder: Path, at: str) -> None:
    status, body = asked(live, f"world?at={at}")
    assert status == (200 if at == 400 * "1" else 422)
    assert status == 200 or b"in seconds since the recording began" in body


@pytest.mark.parametrize("what", ["length", "world", "picture"])
def test_refuses_what_is_no_recording(live: Served, folder: Path, what: str) -> None:
    (folder / "broken.mcap").write_bytes(b"nothing")
    assert asked(live, what, "broken.mcap") == (
        422, f"{folder / 'broken.mcap'}: expected an MCAP file, found something else".encode(),
    )  # fmt: skip
    assert asked(live, what, "other.mcap")[0] == 404


def test_what_is_being_written_is_neither_replayed_nor_deleted(
    live: Served, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live.runner, "recording", NAME)
    status, body = asked(live, "length")
    assert (status, b"being written" in body) == (422, True)
    cookie = live.session()
    assert live.ask("POST", f"/recordings/{NAME}/delete", b"", Cookie=cookie)[0] == 409
    (listed,) = json.loads(live.ask("GET", "/recordings", Cookie=cookie)[2])
    assert listed["is_growing"]
    assert (folder / NAME).exists()


def test_deletes_what_the_list_names_and_nothing_else(live: Served, folder: Path) -> None:
    cookie = live.session()
    (folder.parent / "secret.mcap").write_bytes(b"")
    (folder / "note.txt").write_bytes(b"")
    (folder / "link.mcap").symlink_to(folder.parent / "secret.mcap")
    for name in ("..%2fsecret.mcap", "../secret.mcap", "note.txt", "link.mcap", "%00", "x.mcap"):
        assert live.ask("POST", f"/recordings/{name}/delete", b"", Cookie=cookie)[0] in (400, 404)
    assert live.ask("POST", f"/recordings/{NAME}/delete", b"", Cookie=cookie)[0] == 204
    assert live.ask("POST", f"/recordings/{NAME}/delete", b"", Cookie=cookie)[0] == 404
    assert {one.name for one in folder.iterdir()} == {"note.txt", "link.mcap"}
    assert (folder.parent / "secret.mcap").exists()


def test_a_page_of_another_site_deletes_nothing(live: Served, folder: Path) -> None:
    cookie = live.session()
    where = f"/recordings/{NAME}/delete"
    assert live.ask("POST", where, b"", Cookie=cookie, Origin="http://evil.example")[0] == 403
    assert live.ask("POST", where, b"", Cookie=cookie, Origin=None)[0] == 403
    assert (folder / NAME).exists()


def test_many_moments_at_once_are_answered_or_put_off(live: Served, folder: Path) -> None:
    from concurrent.futures import ThreadPoolExecutor

    cookie = live.session()

    def ask(number: int) -> int:
        at_s = f"{0.02 * number:.2f}"
        return live.ask("GET", f"/recordings/{NAME}/world?at={at_s}", Cookie=cookie)[0]

    with ThreadPoolExecutor(40) as pool:
        answers = list(pool.map(ask, range(60)))
    assert set(answers) <= {200, 503}
    assert answers.count(200) >= 16
    eventually(lambda: ask(1) == 200)

"""One call opens everything, and says what it understands when it does not."""

import numpy as np
import pytest
from encoded_pictures import encode

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.sources import LiveSource, Pictures, VideoFile, cameras, open_source
from tagmetry.sources import open as opening
from tagmetry.sources.paths import natural_key
from tagmetry.sources.streams import public_address


@pytest.fixture
def folder(tmp_path):
    for name in ("img10.png", "img2.PNG", "img1.png", "b/img3.png", ".hidden.png"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(encode(".png", np.zeros((2, 3), np.uint8)))
    (tmp_path / "notes.txt").write_text("notes")
    return tmp_path


def names(source):
    return [image.source.rpartition("/")[2] for image in source]


def test_a_folder_is_read_in_the_order_people_count_in(folder):
    assert names(open_source(folder)) == ["img1.png", "img2.PNG", "img10.png"]


def test_a_pattern_is_read_in_order_and_takes_only_pictures(folder):
    assert names(open_source(f"{folder}/*")) == ["img1.png", "img2.PNG", "img10.png"]
    assert names(open_source(f"{folder}/**/*3.png")) == ["img3.png"]


def test_several_are_read_in_the_given_order(folder):
    specs = [folder / "img10.png", str(folder / "b"), f"{folder}/img1.*"]
    source = open_source(specs)
    assert names(source) == ["img10.png", "img3.png", "img1.png"]
    assert (source.name, source.length) == ("3 pictures", 3)


def test_natural_order_of_mixed_names():
    shuffled = ["a10b2", "a2b10", "1", "a2b9", "a", "01", "A2b1"]
    assert sorted(shuffled, key=natural_key) == ["01", "1", "a", "A2b1", "a2b9", "a2b10", "a10b2"]


def test_a_picture_is_told_by_its_content_where_the_name_says_nothing(folder):
    path = (folder / "img1.png").rename(folder / "picture")
    assert isinstance(open_source(path), Pictures)


@pytest.mark.parametrize(
    ("spec", "words"),
    [
        ("missing.png", "no such file, folder or camera: 'missing.png'; understood are pictures"),
        ("", "got an empty name"),
        ("  ", "got an empty name"),
        ("nothing*.png", r"no picture or video matches 'nothing\*\.png'; understood are \.jpg"),
        ("a\0b", "no such file"),
        ("x" * 5000, "cannot be read: File name too long"),
        ("ftp://host/a.mp4", "streams of ftp:// are not understood; understood are rtsp://"),
        ("99999999999", "no such file, folder or camera"),
        ("256", "a camera's number, 0 to 255, got 256"),
        (-1, "a camera's number, 0 to 255, got -1"),
        (True, "a camera's number, 0 to 255, got True"),
        ([], "at least one picture"),
    ],
)
def test_what_is_not_understood(spec, words):
    with pytest.raises(InputError, match=words):
        open_source(spec)


def test_a_folder_without_pictures_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"no pictures in the folder .*; understood are \.jpg"):
        open_source(tmp_path)


def test_several_videos_are_refused(folder):
    (folder / "a.mp4").write_bytes(b"\0\0\0\x20ftypisom")
    with pytest.raises(InputError, match="2 files, and videos among them: open one video at a"):
        open_source([folder / "img1.png", folder / "a.mp4"])


def test_one_video_that_matches_a_pattern_is_opened(folder, monkeypatch):
    (folder / "a.mp4").write_bytes(b"\0\0\0\x20ftypisom")
    monkeypatch.setattr(opening, "VideoFile", lambda path, **_: path)
    assert open_source(f"{folder}/*.mp4") == folder / "a.mp4"
    assert VideoFile is not opening.VideoFile


@pytest.mark.parametrize(
    ("spec", "device", "name"),
    [(0, 0, "camera 0"), ("1", 1, "camera 1"), ("/dev/video7", "/dev/video7", "/dev/video7")],
)
def test_cameras_are_asked_for_by_number_or_device(spec, device, name, monkeypatch):
    asked = []
    monkeypatch.setattr(opening, "LiveSource", lambda *live, **_: live)
    monkeypatch.setattr(opening, "camera_opener", lambda *a, **k: asked.append((a, k)))
    found, _ = open_source(spec, camera=Camera(64, 48, (9.0, 9.0), (3.0, 3.0)), grey=True)
    assert found == name
    assert asked == [((device,), {"size_px": (64, 48), "grey": True})]


def test_a_live_source_cannot_be_repeated():
    with pytest.raises(InputError, match="camera 3 is live and cannot begin again"):
        open_source(3, loop=True)


@pytest.mark.parametrize("spec", ["250", "/dev/video250", "/dev/null"])
def test_a_camera_that_is_not_there_is_said_to_be_so(spec, capfd):
    with open_source(spec) as source:
        assert isinstance(source, LiveSource)
        with pytest.raises(InputError, match=rf"{spec}: the camera cannot be opened"):
            next(iter(source))
    assert capfd.readouterr().err == ""


class FakeCapture:
    def __init__(self, images):
        self.images, self.settings, self.is_released = images, {}, False

    def isOpened(self):  # noqa: N802
        return True

    def set(self, key, value):
        self.settings[key] = value

    def read(self):
        return (True, self.images.pop(0)) if self.images else (False, None)

    def release(self):
        self.is_released = True


def test_a_camera_is_asked_for_the_size_of_its_intrinsics_and_gives_grey(monkeypatch):
    import cv2

    capture = FakeCapture([np.full((4, 6, 3), 9, np.uint8), np.full((4, 6), 7, np.uint8)])
    monkeypatch.setattr(cv2, "VideoCapture", lambda *_: capture)
    connection = cameras.camera_opener(0, size_px=(6, 4), grey=True)()
    assert capture.settings[cv2.CAP_PROP_FRAME_WIDTH] == 6
    assert capture.settings[cv2.CAP_PROP_FRAME_HEIGHT] == 4
    np.testing.assert_array_equal(connection.read(), np.full((4, 6), 9))
    np.testing.assert_array_equal(connection.read(), np.full((4, 6), 7))
    with pytest.raises(cameras.ConnectionLostError, match="still plugged in"):
        connection.read()
    connection.close()
    assert capture.is_released


def test_passwords_stay_out_of_names():
    assert public_address("rtsp://me:secret@cam:554/live?x=1") == "rtsp://cam:554/live?x=1"
    assert public_address("http://cam/video.mjpg") == "http://cam/video.mjpg"

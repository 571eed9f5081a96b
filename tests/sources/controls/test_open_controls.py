"""Which controls belong to a source, and OpenCV's."""

import platform
import threading

import cv2
import numpy as np
import pytest

from tagmetry.camera import ControlRefusedError, Controls
from tagmetry.errors import InputError
from tagmetry.sources import LiveSource, Pictures
from tagmetry.sources.cameras import CameraOpener, camera_opener
from tagmetry.sources.controls import OpenCvControls, by_hand, open_controls
from tagmetry.twin.camera import ready_camera


class FakeCapture:
    """An open `cv2.VideoCapture` of a camera with zoom, exposure and auto exposure."""

    def __init__(self) -> None:
        self.values = {
            cv2.CAP_PROP_ZOOM: 100.0,
            cv2.CAP_PROP_EXPOSURE: -6.0,
            cv2.CAP_PROP_AUTO_EXPOSURE: 1.0,
        }
        self.released = threading.Event()

    def get(self, prop: int) -> float:
        return self.values.get(prop, -1.0)

    def set(self, prop: int, value: float) -> bool:
        if prop not in self.values or (prop == cv2.CAP_PROP_ZOOM and value > 500):
            return False
        self.values[prop] = value
        return True

    def read(self) -> tuple[bool, np.ndarray]:
        self.released.wait(0.005)
        return True, np.random.default_rng().integers(0, 255, (8, 8, 3), np.uint8)

    def release(self) -> None:
        self.released.set()


def test_a_source_s_own_controls_are_given() -> None:
    twin = ready_camera("webcam")
    assert open_controls(twin) is twin.controls


def test_what_has_no_controls_is_refused(tmp_path) -> None:
    path = tmp_path / "one.png"
    cv2.imwrite(str(path), np.zeros((20, 20), np.uint8))
    with Pictures([path]) as pictures, pytest.raises(InputError, match="has no controls: expected"):
        open_controls(pictures)


def opened(monkeypatch, system: str) -> tuple[LiveSource, FakeCapture]:
    capture = FakeCapture()
    monkeypatch.setattr("tagmetry.sources.cameras._open", lambda *_: capture)
    monkeypatch.setattr(platform, "system", lambda: system)
    return LiveSource("camera 254", camera_opener(254)), capture


def test_under_linux_a_camera_is_its_video_device(monkeypatch) -> None:
    source, _ = opened(monkeypatch, "Linux")
    with source, pytest.raises(InputError, match="/dev/video254: No such file"):
        open_controls(source)


def test_elsewhere_opencv_sets_the_open_camera(monkeypatch) -> None:
    source, capture = opened(monkeypatch, "Windows")
    with source:
        next(iter(source))
        controls = open_controls(source)
        assert isinstance(controls, OpenCvControls)
        with by_hand(controls):
            assert capture.values[cv2.CAP_PROP_AUTO_EXPOSURE] == 0
            assert controls.write("zoom", 300) == 300 == capture.values[cv2.CAP_PROP_ZOOM]
    assert capture.values[cv2.CAP_PROP_ZOOM] == 100
    assert capture.values[cv2.CAP_PROP_AUTO_EXPOSURE] == 1


def test_a_camera_that_is_not_open_says_what_to_do() -> None:
    with pytest.raises(InputError, match="camera 3 is not open yet: take an image first"):
        CameraOpener(3).get(0)


def test_opencv_has_the_controls_that_the_camera_takes() -> None:
    capture = FakeCapture()
    controls = OpenCvControls(capture)
    assert isinstance(controls, Controls)
    assert set(controls.available) == {"zoom", "exposure", "auto_exposure"}
    assert controls.read("exposure") == 2**-6
    assert controls.write("exposure", 0.0028) == 2**-8 == controls.read("exposure")
    assert capture.values[cv2.CAP_PROP_EXPOSURE] == -8
    with pytest.raises(ControlRefusedError, match="zoom: the camera does not take 700"):
        controls.write("zoom", 700)
    with pytest.raises(InputError, match="no control 'focus'; it has: zoom, exposure"):
        controls.write("focus", 1)

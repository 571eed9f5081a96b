"""Which controls belong to a source, and OpenCV's."""

import os
import platform
import threading

import cv2
import numpy as np
import pytest
from fake_video_device import webcam

from tagmetry.camera import ControlledSource, ControlRefusedError, Controls
from tagmetry.errors import InputError
from tagmetry.sources import LiveSource, Pictures
from tagmetry.sources.cameras import CameraOpener, camera_opener
from tagmetry.sources.controls import (
    OpenCvControls,
    V4l2Controls,
    by_hand,
    controlled,
    open_controls,
)
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
        controls = open_controls(source)
        assert isinstance(controls, OpenCvControls)
        with by_hand(controls):
            assert capture.values[cv2.CAP_PROP_AUTO_EXPOSURE] == 0
            assert controls.write("zoom", 300) == 300 == capture.values[cv2.CAP_PROP_ZOOM]
    assert capture.values[cv2.CAP_PROP_ZOOM] == 100
    assert capture.values[cv2.CAP_PROP_AUTO_EXPOSURE] == 1


def test_a_camera_that_does_not_open_is_named(monkeypatch) -> None:
    monkeypatch.setattr("tagmetry.sources.cameras._OPENING_S", 0.05)
    with pytest.raises(InputError, match="camera 3 is not open: is it plugged in"):
        CameraOpener(3).get(0)


def test_a_camera_that_hangs_is_named(monkeypatch) -> None:
    monkeypatch.setattr("tagmetry.sources.cameras._PATIENCE_S", 0.05)
    source, _ = opened(monkeypatch, "Windows")
    with source:
        next(iter(source))
        with source.opener._turn, pytest.raises(InputError, match="camera 254 does not answer"):
            source.opener.get(cv2.CAP_PROP_ZOOM)


def test_a_source_and_its_controls_become_one(monkeypatch) -> None:
    twin = ready_camera("webcam")
    assert controlled(twin) is twin
    source, capture = opened(monkeypatch, "Windows")
    with controlled(source) as both:
        assert isinstance(both, ControlledSource)
        assert (both.name, both.is_live, both.length) == ("camera 254", True, None)
        assert next(iter(both)).pixels.shape == (8, 8, 3)
        both.controls.write("zoom", 200)
        assert capture.values[cv2.CAP_PROP_ZOOM] == 200
    assert list(source) == []


def test_a_video_device_is_let_go_of_with_its_source(monkeypatch) -> None:
    source, _ = opened(monkeypatch, "Linux")
    read_end, write_end = os.pipe()
    os.close(write_end)
    own = V4l2Controls(read_end, webcam().ioctl)
    monkeypatch.setattr(V4l2Controls, "open", lambda path: own if path == "/dev/video254" else None)
    with controlled(source) as both:
        assert both.controls is own
    with pytest.raises(OSError, match="Bad file descriptor"):
        os.fstat(read_end)
    own.close()


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

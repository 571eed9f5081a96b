"""Video4Linux against a driver written from the kernel's documentation."""

import os
from dataclasses import replace

import pytest
from fake_video_device import INTEGER, FakeControl, FakeDevice, webcam

from tagmetry.camera import ControlRefusedError, Controls
from tagmetry.errors import InputError
from tagmetry.sources.controls import V4l2Controls, by_hand, v4l2


def controls_of(device: FakeDevice) -> V4l2Controls:
    return V4l2Controls(-1, device.ioctl)


def test_requests_are_those_that_a_c_compiler_makes_of_videodev2_h() -> None:
    assert v4l2.VIDIOC_QUERYCAP == 0x80685600
    assert v4l2.VIDIOC_G_CTRL == 0xC008561B
    assert v4l2.VIDIOC_S_CTRL == 0xC008561C
    assert v4l2.VIDIOC_QUERYCTRL == 0xC0445624
    assert v4l2.VIDIOC_QUERYMENU == 0xC02C5625


def test_controls_have_their_ranges_in_our_units() -> None:
    controls = controls_of(webcam())
    assert isinstance(controls, Controls)
    assert set(controls.available) == {
        "zoom", "focus", "exposure", "gain", "auto_focus", "auto_exposure",
    }  # fmt: skip
    zoom, focus = controls.available["zoom"], controls.available["focus"]
    assert (zoom.least, zoom.most, zoom.step, zoom.unit) == (100, 500, 1, "percent")
    assert (focus.least, focus.most, focus.step, focus.unit) == (0, 250, 5, "")
    exposure = controls.available["exposure"]
    assert (exposure.least, exposure.most) == pytest.approx((0.0003, 0.2047))
    assert (exposure.default, exposure.unit) == (pytest.approx(0.025), "s")


def test_values_go_there_and_come_back() -> None:
    device = webcam()
    controls = controls_of(device)
    assert controls.write("auto_focus", 0) == 0
    assert controls.write("focus", 83.0) == 85.0 == controls.read("focus")
    assert controls.write("zoom", 321) == 321 == controls.read("zoom")
    assert controls.write("exposure", 0.0123) == pytest.approx(0.0123)
    assert device.controls[0x009A0902].value == 123
    assert controls.read("exposure") == pytest.approx(0.0123)
    assert controls.read("gain") == 12


def test_negative_numbers_are_numbers() -> None:
    device = webcam()
    device.controls[0x00980913] = FakeControl("Gain", INTEGER, -20, 20, 1, -3, -7)
    controls = controls_of(device)
    assert controls.read("gain") == -7
    assert controls.available["gain"].default == -3
    controls.write("gain", -20)
    assert device.controls[0x00980913].value == -20


@pytest.mark.parametrize("automatic", [3, 0, 2])
def test_automatic_exposure_goes_back_to_the_mode_it_was_in(automatic: int) -> None:
    device = webcam()
    mode = device.controls[0x009A0901]
    mode.items, mode.value = (0, 1, 2, 3), automatic
    controls = controls_of(device)
    assert controls.read("auto_exposure") == 1
    controls.write("auto_exposure", 0)
    assert mode.value == 1
    assert controls.read("auto_exposure") == 0
    controls.write("auto_exposure", 1)
    assert mode.value == automatic


def test_found_in_manual_mode_automatic_exposure_is_the_mode_that_there_is() -> None:
    device = webcam()
    mode = device.controls[0x009A0901]
    mode.items, mode.value = (0, 1), 1
    controls = controls_of(device)
    assert controls.read("auto_exposure") == 0
    controls.write("auto_exposure", 1)
    assert mode.value == 0


@pytest.mark.parametrize("items", [(), (3,), (1,)])
def test_without_both_kinds_of_exposure_there_is_nothing_to_switch(items: tuple[int, ...]) -> None:
    device = webcam()
    device.controls[0x009A0901].items = items
    device.controls[0x009A0901].value = 1
    assert "auto_exposure" not in controls_of(device).available


@pytest.mark.parametrize("flags", [0x1, 0x4, 0x40])
def test_what_is_disabled_or_cannot_be_set_or_read_is_left_out(flags: int) -> None:
    device = webcam()
    device.controls[0x009A090D].flags = flags
    assert "zoom" not in controls_of(device).available


def test_what_an_auto_mode_rules_is_there_though_it_is_inactive() -> None:
    device = webcam()
    device.controls[0x009A090A].flags = 0x10
    assert "focus" in controls_of(device).available


def test_a_driver_that_tells_nonsense_does_no_harm() -> None:
    device = webcam()
    device.controls[0x009A090D] = FakeControl("Zoom", INTEGER, 10, 5, 0, 99, 10)
    zoom = controls_of(device).available["zoom"]
    assert (zoom.least, zoom.most, zoom.step, zoom.default) == (10, 10, 1, 10)


def test_what_the_driver_refuses_is_named_with_what_to_do() -> None:
    device = webcam()
    controls = controls_of(device)
    with pytest.raises(
        ControlRefusedError, match=r"focus: .* 85: Permission denied; auto_focus is"
    ):
        controls.write("focus", 85)
    device.busy.add(0x009A090D)
    with pytest.raises(
        ControlRefusedError, match=r"zoom: .*not take 300: Device or resource busy$"
    ):
        controls.write("zoom", 300)
    with pytest.raises(InputError, match="zoom: expected 100 to 500 percent"):
        controls.write("zoom", 501)
    with pytest.raises(InputError, match="no control 'iris'"):
        controls.read("iris")


def test_a_camera_that_was_unplugged_is_named() -> None:
    device = webcam()
    controls = controls_of(device)
    device.controls.clear()
    with pytest.raises(ControlRefusedError, match="zoom: the camera does not tell"):
        controls.read("zoom")


def test_by_hand_everything_is_as_it_was_found() -> None:
    device = webcam()
    before = {number: replace(control) for number, control in device.controls.items()}
    with by_hand(controls_of(device)) as controls:
        assert (controls.read("auto_focus"), controls.read("auto_exposure")) == (0, 0)
        controls.write("focus", 100)
        controls.write("exposure", 0.005)
        controls.write("zoom", 400)
    assert device.controls == before


def test_what_is_no_camera_is_refused() -> None:
    with pytest.raises(InputError, match=r"/dev/video254: No such file"):
        V4l2Controls.open("/dev/video254")
    with pytest.raises(InputError, match="/dev/null is no video device"):
        V4l2Controls.open(os.devnull)

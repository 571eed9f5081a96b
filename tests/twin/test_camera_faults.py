"""What a simulated camera's controls do wrong on request, and what it refuses."""

from dataclasses import replace

import pytest
from plain_camera import PLAIN, camera, picture

from tagmetry.camera import ControlRefusedError
from tagmetry.errors import InputError
from tagmetry.twin.camera import (
    DioptreFocus,
    Faults,
    FixedFocus,
    LogFocus,
    Setting,
    mono_camera,
)


def test_a_refused_control_says_so_and_stays() -> None:
    controls = camera(faults=Faults(refused=frozenset({"zoom"}))).controls
    with pytest.raises(ControlRefusedError, match="zoom: the camera does not take 300"):
        controls.write("zoom", 300)
    assert controls.read("zoom") == 100
    assert controls.write("focus", 3.0) == 3.0


def test_a_stuck_control_reads_back_what_was_written_and_does_nothing() -> None:
    twin = camera(faults=Faults(stuck=frozenset({"gain"})))
    before = picture(twin).mean()
    twin.controls.write("gain", 4.0)
    assert twin.controls.read("gain") == 4.0
    assert picture(twin).mean() == before


def test_a_misread_control_obeys_all_the_same() -> None:
    twin = camera(faults=Faults(misread={"gain": 0.5}))
    twin.controls.write("gain", 1.5)
    assert twin.controls.read("gain") == 2.0
    assert picture(twin).mean() == pytest.approx(0.375, rel=1e-3)


def test_a_late_control_comes_that_many_images_later() -> None:
    device = replace(PLAIN, delay_images={"gain": 1})
    twin = camera(device=device, faults=Faults(late_images={"gain": 2}))
    twin.take()
    twin.controls.write("gain", 1.5)
    gains = [twin.take() and twin.setting().gain for _ in range(5)]
    assert gains == [1.0, 1.0, 1.0, 1.5, 1.5]


def test_refuses_faults_of_controls_that_are_not_there() -> None:
    with pytest.raises(InputError, match="faults of controls that mono does not have: zoom"):
        camera(device=mono_camera(), faults=Faults(stuck=frozenset({"zoom"})))


def test_refuses_unknown_controls_and_values_out_of_range() -> None:
    controls = camera().controls
    with pytest.raises(InputError, match="no control 'iris'; it has: zoom, focus"):
        controls.read("iris")
    with pytest.raises(InputError, match="no control 'iris'"):
        controls.write("iris", 1.0)
    with pytest.raises(
        InputError, match="zoom: expected 100 to 500 percent in steps of 1, got 501"
    ):
        controls.write("zoom", 501)
    assert controls.write("zoom", 250.4) == 250.0
    assert controls.read("zoom") == 250.0


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"size_px": (320, 240)}, "shape of the sensor, 640x360, got 320x240"),
        ({"images_per_s": 0.0}, "images_per_s and sensitivity_per_s must be positive"),
        ({"images_per_s": 200.0}, "0.01 s does not fit into 200 images per second"),
        ({"latency_s": -1.0}, "latency_s must not be negative"),
        ({"delay_images": {"iris": 1}}, "unknown controls \\['iris'\\]"),
        ({"delay_images": {"zoom": -1}}, "delays must not be negative"),
        ({"speed_per_s": {"focus": 0.0}}, "speeds must be positive"),
    ],
)
def test_refuses_hardware_that_cannot_be(change: dict[str, object], text: str) -> None:
    with pytest.raises(InputError, match=text):
        replace(PLAIN, **change)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: Setting(zoom_percent=50.0), "100 percent or more"),
        (lambda: Setting(focus=float("nan")), "focus must be finite"),
        (lambda: Setting(exposure_s=0.0), "exposure_s must be positive"),
        (lambda: LogFocus(alpha=0.0), "positive alpha"),
        (lambda: DioptreFocus(0.0), "value_m must be positive"),
        (lambda: FixedFocus(-1.0), "focus_m must be positive"),
    ],
)
def test_refuses_numbers_that_cannot_be(make, text: str) -> None:
    with pytest.raises(InputError, match=text):
        make()

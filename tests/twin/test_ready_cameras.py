"""The ready-made simulated cameras: webcam, overhead and mono."""

from dataclasses import replace

import numpy as np
import pytest
from plain_camera import camera

from tagmetry.camera import Image
from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.twin.camera import (
    Breathing,
    FixedFocus,
    LogFocus,
    TwinCamera,
    marker_before_camera,
    mono_camera,
    overhead_camera,
    ready_camera,
    webcam,
)
from tagmetry.twin.optics.sensor import Sensor


def test_images_know_their_intrinsics_only_where_that_is_wanted() -> None:
    assert camera().take().camera is None
    twin = camera(tells_camera=True)
    image: Image = twin.take()
    assert image.camera is not None
    image.camera.check_image(image.width_px, image.height_px)


@pytest.mark.parametrize("make", [webcam, overhead_camera, mono_camera])
def test_ready_made_cameras_give_images_of_their_size(make) -> None:
    device = make()
    image = camera(device=device).take()
    assert image.pixels.shape == device.size_px[::-1]
    assert image.pixels.dtype == np.uint8
    assert 20 < image.pixels.mean() < 235


def test_the_webcam_sees_90_degrees_along_its_diagonal() -> None:
    twin = camera(device=replace(webcam(), focus_law=FixedFocus(np.inf), breathing=Breathing(0.0)))
    twin.controls.write("auto_focus", 0)
    own = twin.true_camera()
    assert np.degrees(2 * np.arctan(np.hypot(960, 540) / own.focal_px[0])) == pytest.approx(90)
    assert twin.controls.available["focus"].most == 150
    assert twin.controls.available["zoom"].most == 500


@pytest.mark.parametrize(("name", "markers"), [("webcam", 1), ("overhead", 12), ("mono", 1)])
def test_a_ready_camera_has_something_before_it(name: str, markers: int) -> None:
    image = ready_camera(name, tells_camera=True).take()
    found = Detector(["tag36h11"]).detect(image.pixels, image.camera)
    assert sorted(one.id for one in found) == (list(range(12)) if markers == 12 else [7])


def test_an_unknown_ready_camera_is_named_with_those_that_there_are() -> None:
    with pytest.raises(
        InputError, match="expected twin:webcam, twin:overhead, twin:mono, got twin:x"
    ):
        ready_camera("x")


def webcam_at(depth_m: float, focus: float) -> TwinCamera:
    """The webcam with a linear response and the seed's zoom, some time after it was set."""
    device = replace(webcam(), output=Sensor())
    twin = TwinCamera(marker_before_camera(0.01, depth_m), device)
    for auto in ("auto_focus", "auto_exposure"):
        twin.controls.write(auto, 0)
    twin.controls.write("zoom", round(np.clip(1000 * (depth_m - 0.05) + 100, 100, 500)))
    twin.controls.write("focus", round(focus))
    twin.advance(0.3)
    twin.take()
    return twin


@pytest.mark.parametrize("depth_m", [0.05, 0.1, 0.5, 1.0])
def test_the_webcam_shows_a_10_mm_marker_over_a_metre(depth_m: float) -> None:
    """With the seed's zoom and focus its corners are where they belong."""
    twin = webcam_at(depth_m, LogFocus().value(depth_m))
    own = twin.true_camera()
    (found,) = Detector(["tag36h11"]).detect(twin.take().pixels, own)
    corners_m = 0.005 * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    expected_px = own.project(np.column_stack([corners_m, np.full(4, depth_m)]))
    np.testing.assert_allclose(found.corners_px, expected_px, atol=0.3)


@pytest.mark.parametrize("depth_m", [0.5, 1.0])
def test_far_out_of_focus_there_is_no_marker_to_be_found(depth_m: float) -> None:
    image = webcam_at(depth_m, 150.0).take()
    assert not Detector(["tag36h11"]).detect(image.pixels)
    assert np.ptp(image.pixels) < 30

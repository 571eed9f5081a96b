"""Images that are made quickly are those that are made as a whole; and the truth of each."""

from dataclasses import replace

import numpy as np
import pytest
from plain_camera import EMPTY, FACING, PLAIN, camera, square, step_edges_px, white_square

from tagmetry.detect import Detector
from tagmetry.geometry import RigidTransform
from tagmetry.twin.camera import (
    BeforeCamera,
    LogFocus,
    Setting,
    TwinCamera,
    facing_camera,
    markers_before_camera,
    webcam,
)
from tagmetry.twin.camera.development import Taking, image_pixels
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.rendering.box import Box
from tagmetry.twin.scenes import Along, Scene, Steady, Still

AT_ORIGIN = Still(RigidTransform.identity())
NOISY = replace(
    PLAIN,
    pixels=Sensor(bits=12, full_well_e=3000.0, read_noise_e=12.0),
    output=Sensor(bits=16),
    vignetting=webcam().vignetting,
)


def both(scene: Scene, device=PLAIN, focus: float = 2.0, zoom: float = 100.0):
    """The same image as a whole and quickly."""
    twins = [camera(scene, device, quick=quick) for quick in (False, True)]
    for twin in twins:
        twin.controls.write("focus", focus)
        twin.controls.write("zoom", zoom)
    return [twin.take().pixels for twin in twins]


@pytest.mark.parametrize("zoom", [100, 137, 200, 333])
@pytest.mark.parametrize("focus", [2.0, 5.0, 9.0])
def test_without_noise_they_are_the_same(zoom: float, focus: float) -> None:
    """Two squares apart, one of them cut by the edge of the image."""
    scene = Scene((square(0.5, 0.004, 0.003), square(0.5, 0.004, -0.011, 0.002)), background=0.1)
    device = replace(PLAIN, blur_px=0.5, vignetting=webcam().vignetting)
    whole, quick = both(scene, device, focus, zoom)
    assert np.ptp(whole) > 4000
    np.testing.assert_allclose(quick / 65535, whole / 65535, rtol=0, atol=5e-5)


@pytest.mark.parametrize("zoom", [100, 137, 333])
def test_a_window_is_what_the_whole_image_shows_there(zoom: float) -> None:
    """Right through an edge, where softened pixels have neighbours outside."""
    device = replace(PLAIN, blur_px=1.5, vignetting=webcam().vignetting)
    taking = Taking(device, Setting(zoom, focus=2.0), white_square(0.5, 0.02), AT_ORIGIN, 0.0)
    rng = np.random.default_rng(0)
    window = Box(137, 74, 177, 113)
    whole, part = image_pixels(taking, rng), image_pixels(taking, rng, window)
    np.testing.assert_allclose(part / 65535, whole[window.pixels] / 65535, rtol=0, atol=5e-5)


def test_a_thing_that_fills_the_image_is_taken_as_a_whole() -> None:
    whole, quick = both(white_square(0.5, 0.2), NOISY)
    np.testing.assert_array_equal(whole, quick)


@pytest.mark.parametrize("zoom", [100, 150, 200, 370])
def test_the_background_has_the_mean_and_the_noise_of_a_whole_image(zoom: float) -> None:
    whole, quick = (image / 65535 for image in both(EMPTY, NOISY, zoom=zoom))
    for part in (slice(0, 60), slice(60, 120), slice(120, 180)):
        assert quick[part].mean() == pytest.approx(whole[part].mean(), abs=5e-4)
        assert quick[part].std() == pytest.approx(whole[part].std(), rel=0.05)


def test_its_noise_is_another_in_every_image_and_the_same_for_a_seed() -> None:
    first, second = (camera(device=NOISY, quick=True, seed=4) for _ in range(2))
    images = [first.take().pixels for _ in range(3)]
    np.testing.assert_array_equal(second.take().pixels, images[0])
    shared = np.corrcoef(images[0].ravel(), images[1].ravel())[0, 1]
    alike = np.corrcoef(images[1].ravel(), images[2].ravel())[0, 1]
    assert max(abs(shared), abs(alike)) < 0.3  # of which the vignetting has most


def test_what_moves_fast_is_not_cut_off() -> None:
    start = RigidTransform.from_components([-0.02, 0.0, 0.5], FACING)
    moving = Steady(start, np.array([1.5, 0.4, 0.0]), np.zeros(3))
    scene = Scene((replace(square(0.5, 0.006), path=moving),), background=0.1)
    device = replace(PLAIN, line_s=2e-5, blur_px=0.5)
    whole, quick = both(scene, device, focus=3.0)
    np.testing.assert_allclose(quick / 65535, whole / 65535, atol=3e-4)


@pytest.mark.parametrize("zoom", [100, 200])
def test_motion_is_the_mean_of_its_moments(zoom: float) -> None:
    """Nine pixels of the sensor, against a hundred still images along the way."""
    device = replace(PLAIN, blur_px=0.5)
    speed_m_s = 9 / 2000 * 0.5 / 5e-3

    def light(path) -> np.ndarray:
        scene = Scene((replace(square(0.5, 0.006), path=path),), background=0.1)
        taking = Taking(device, Setting(zoom, 2.0, 5e-3), scene, AT_ORIGIN, 0.0)
        return image_pixels(taking, np.random.default_rng(0)) / 65535

    at = np.linspace(-0.5, 0.5, 101)[:-1] * 5e-3 + 0.25e-4
    here = RigidTransform.from_components([0.0, 0.0, 0.5], FACING)
    moving = Steady(here, np.array([speed_m_s, 0.0, 0.0]), np.zeros(3))
    expected = np.mean([light(Still(moving.at(np.array([t]))[0])) for t in at], axis=0)
    found = light(moving)
    assert np.ptp(found) > 0.2
    np.testing.assert_allclose(found, expected, rtol=0, atol=0.01 * np.ptp(expected))
    assert step_edges_px(found) == pytest.approx(step_edges_px(expected), abs=2e-3)


def test_a_function_of_time_is_followed_between_thousandths_of_a_second() -> None:
    def swing(time_s: float) -> RigidTransform:
        return facing_camera(0.3 + 0.05 * np.sin(9 * time_s), 40 * np.sin(5 * time_s))

    times_s = np.random.default_rng(0).uniform(-0.1, 2.0, 50)
    found = Along(swing).at(times_s)
    for pose, time_s in zip(found, times_s, strict=True):
        off = pose.inv() * swing(time_s)
        assert np.linalg.norm(off.translation) < 0.05 * 81 * 1e-6 / 8 * 1.01
        assert off.rotation.magnitude() < np.radians(40) * 25 * 1e-6 / 8 * 1.01
    assert Along(swing).moves


def micro(depth_m: float, turn_deg: float, **others: object) -> TwinCamera:
    """The webcam, set for a depth as the paper sets it, before a 10 mm marker."""
    scene = markers_before_camera(BeforeCamera(Still(facing_camera(depth_m, turn_deg))))
    twin = TwinCamera(scene, webcam(), quick=True, **others)
    for name in ("auto_focus", "auto_exposure"):
        twin.controls.write(name, 0)
    twin.controls.write("zoom", np.clip(1000 * (depth_m - 0.05) + 100, 100, 500))
    twin.controls.write("focus", round(LogFocus().value(depth_m)))
    twin.advance(0.3)
    return twin


@pytest.mark.parametrize("depth_m", [0.05, 0.2, 1.0])
def test_the_truth_is_where_the_detector_finds_the_marker(depth_m: float) -> None:
    twin = micro(depth_m, 30.0)
    image = twin.take()
    (truth,) = twin.truth().markers
    (found,) = Detector(["tag36h11"]).detect(image.pixels, twin.true_camera())
    np.testing.assert_allclose(found.corners_px, truth.corners_px, atol=0.4)
    assert truth.depth_m == pytest.approx(depth_m)
    assert truth.tilt_deg == pytest.approx(30.0)
    assert twin.truth().camera.focal_px == pytest.approx(twin.true_camera().focal_px, rel=1e-12)
    assert twin.truth().time_s == image.time_s


def test_the_truth_of_the_blur_is_the_thin_lens_s_in_pixels_of_the_image() -> None:
    """R = A v |1 / z - 1 / d| / 2 on the sensor; f 3.194 mm at f / 2, 1.45 um, zoom 5."""
    twin = micro(0.5, 0.0)
    twin.controls.write("focus", 73)
    twin.advance(0.3)
    twin.take()
    focal_m, focus_m = np.hypot(3840, 2160) / 2 * 1.45e-6, np.exp((4 - 73) / 42.11)
    image_m = 1 / (1 / focal_m - 1 / focus_m)
    radius_m = focal_m / 2 * image_m * abs(1 / 0.5 - 1 / focus_m) / 2
    (truth,) = twin.truth().markers
    assert truth.disc_px == pytest.approx(radius_m / 1.45e-6 * 5 * 1920 / 3840, rel=1e-9)


def test_several_markers_each_go_where_a_function_of_time_says() -> None:
    scene = markers_before_camera(
        BeforeCamera(Along(lambda t: facing_camera(0.15 + 0.2 * t, x_m=-0.03)), id=1),
        BeforeCamera(Still(facing_camera(0.15, 20.0, x_m=0.02, y_m=-0.01)), id=2, size_m=0.02),
    )
    twin = TwinCamera(scene, webcam(), quick=True)
    for name in ("auto_focus", "auto_exposure"):
        twin.controls.write(name, 0)
    twin.controls.write("focus", 84)
    twin.advance(0.2)
    image = twin.take()
    moving, still = twin.truth().markers
    assert moving.depth_m == pytest.approx(0.15 + 0.2 * image.time_s, abs=1e-9)
    assert still.T_camera_marker.translation == pytest.approx([0.02, -0.01, 0.15])
    found = Detector(["tag36h11"]).detect(image.pixels, twin.true_camera())
    assert sorted(one.id for one in found) == [1, 2]

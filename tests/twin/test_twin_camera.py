"""The simulated camera against clocks, closed forms of optics, and its own faults.

The truth of where edges are and how wide they are is written here again: sizes by similar
triangles with the thin lens's image distance, widths by second moments.
"""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from tagmetry.camera import (
    BrownLens,
    Camera,
    Control,
    ControlledSource,
    ControlRefusedError,
    Controls,
    Image,
    Source,
)
from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker
from tagmetry.twin.camera import (
    Breathing,
    Device,
    DioptreFocus,
    Faults,
    FixedFocus,
    LogFocus,
    Setting,
    TwinCamera,
    marker_before_camera,
    mono_camera,
    overhead_camera,
    ready_camera,
    webcam,
)
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.scenes import Scene, Steady, Still, Thing, marker_thing, surface

FACING = Rotation.from_euler("x", 180, degrees=True)
EMPTY = Scene((), background=0.5)
F_M, PIXEL_M, APERTURE_M = 4e-3, 2e-6, 2e-3
MANUAL = (
    Control("zoom", 100.0, 500.0, 1.0, 100.0, "percent"),
    Control("focus", 0.0, 20.0, 0.0, 2.0),
    Control("exposure", 1e-3, 10e-3, 1e-3, 5e-3, "s"),
    Control("gain", 1.0, 8.0, 0.0, 1.0, "factor"),
)
AUTO = (Control("auto_focus", 0.0, 1.0, 1.0, 0.0), Control("auto_exposure", 0.0, 1.0, 1.0, 0.0))
PLAIN = Device(  # 16 bits without noise, 320 x 180 out of 640 x 360, focus in dioptres
    "plain",
    Camera(640, 360, (2000.0, 2000.0), (311.7, 186.2)),
    (320, 180),
    50.0,
    ThinLens(F_M, APERTURE_M, PIXEL_M),
    DioptreFocus(1.0),
    pixels=Sensor(bits=16),
    output=Sensor(bits=16),
    blur_px=0.0,
    controls=MANUAL + AUTO,
)


def square(z_m: float, side_m: float, x_m: float = 0.0, y_m: float = 0.0) -> Thing:
    at = Still(RigidTransform.from_components([x_m, y_m, z_m], FACING))
    return surface("square", side_m, side_m, at, brightness=0.9)


def white_square(z_m: float, side_m: float, x_m: float = 0.0, y_m: float = 0.0) -> Scene:
    return Scene((square(z_m, side_m, x_m, y_m),), background=0.1)


def camera(scene: Scene = EMPTY, device: Device = PLAIN, **others: object) -> TwinCamera:
    return TwinCamera(scene, device, **others)


def picture(twin: TwinCamera) -> np.ndarray:
    """The next image's light, 0 to 1."""
    return twin.take().pixels / twin._device.output.white_grey


def step_edges_px(light: np.ndarray) -> tuple[float, float]:
    """Where a bright square of the middle row begins and ends, by the area of its profile."""
    row = light[light.shape[0] // 2 - 5 : light.shape[0] // 2 + 5].mean(axis=0)
    middle = int(np.average(np.arange(len(row)), weights=row - row.min()))
    share = (row - row[0]) / (row[middle] - row[0])
    return middle - 0.5 - share[:middle].sum(), middle - 0.5 + share[middle:].sum()


# --- time


def test_it_is_a_source_and_has_controls() -> None:
    twin = camera()
    assert isinstance(twin, Source)
    assert isinstance(twin, ControlledSource)
    assert isinstance(twin.controls, Controls)
    assert twin.is_live
    assert twin.length is None
    assert twin.name == "twin plain"


def test_images_come_at_the_image_rate_with_the_middle_of_their_exposure() -> None:
    images = list(itertools.islice(camera(), 5))
    assert [image.sequence for image in images] == [0, 1, 2, 3, 4]
    np.testing.assert_allclose([i.time_s for i in images], np.arange(5) * 0.02 + 0.0025, atol=1e-12)
    assert {image.time_kind for image in images} == {"capture"}
    assert {image.source for image in images} == {"twin plain"}


def test_an_image_arrives_when_its_exposure_and_transfer_are_over() -> None:
    twin = camera(device=replace(PLAIN, latency_s=0.007))
    twin.take()
    assert twin.now_s == pytest.approx(0.005 + 0.007)
    twin.take()
    assert twin.now_s == pytest.approx(0.02 + 0.005 + 0.007)


@pytest.mark.parametrize(
    ("busy_s", "then"), [(0.0, 1), (0.0199, 1), (0.0201, 1), (0.0401, 2), (0.0599, 2), (1.0, 50)]
)
def test_who_is_busy_gets_the_newest_image_that_has_arrived(busy_s: float, then: int) -> None:
    twin = camera()
    twin.take()  # at 5 ms, the next arrive at 25 ms, 45 ms, ...
    twin.advance(busy_s)
    assert twin.take().sequence == then
    assert twin.now_s == pytest.approx(max(0.005 + busy_s, then * 0.02 + 0.005))


def test_no_image_is_given_twice() -> None:
    twin = camera()
    numbers = []
    for busy_s in np.random.default_rng(1).uniform(0, 0.05, 60):
        numbers.append(twin.take().sequence)
        twin.advance(float(busy_s))
    assert (np.diff(numbers) >= 1).all()
    assert max(np.diff(numbers)) == 3


def test_time_does_not_go_back() -> None:
    with pytest.raises(InputError, match="time only goes on"):
        camera().advance(-0.1)
    with pytest.raises(InputError, match="time only goes on"):
        camera().advance(float("nan"))


def test_closed_it_gives_no_more() -> None:
    with camera() as twin:
        taken = [next(iter(twin)).sequence for _ in range(2)]
    assert taken == [0, 1]
    assert list(twin) == []
    twin.close()
    with pytest.raises(InputError, match="twin plain is closed"):
        twin.take()


def test_a_moving_square_is_where_it_is_in_the_middle_of_the_exposure() -> None:
    start = RigidTransform.from_components([-0.02, 0.0, 0.5], FACING)
    moving = Steady(start, np.array([0.4, 0.0, 0.0]), np.zeros(3))
    scene = Scene((surface("square", 0.01, 0.01, moving, brightness=0.9),), background=0.1)
    twin = camera(scene)
    for _ in range(3):
        image = twin.take()
        found_px = np.mean(step_edges_px(image.pixels / 65535))
        x_m = -0.02 + 0.4 * image.time_s
        focal_px = twin.true_camera().focal_px[0]
        assert found_px == pytest.approx(
            twin.true_camera().center_px[0] + focal_px * x_m / 0.5, abs=0.02
        )


# --- delays and motors


@pytest.mark.parametrize("delay", [0, 1, 3])
@pytest.mark.parametrize("busy_s", [0.0, 0.004, 0.0155])
def test_a_change_shows_after_exactly_the_delay(delay: int, busy_s: float) -> None:
    """With 0 in the next image that begins; a command during an exposure is too late for it."""
    twin = camera(device=replace(PLAIN, delay_images={"gain": delay}))
    before = twin.take().pixels.mean()
    twin.advance(busy_s)
    begins_next = int(np.ceil(twin.now_s / 0.02 - 1e-9))
    twin.controls.write("gain", 1.5)
    brighter = (i.sequence for i in twin if i.pixels.mean() > 1.2 * before)
    assert next(brighter) == begins_next + delay


def test_a_command_does_not_change_an_image_that_began_before_it() -> None:
    twin = camera()
    before = twin.take().pixels.mean()
    twin.advance(0.012)  # 17 ms: image 1 begins at 20 ms
    twin.advance(0.005)  # 22 ms: it has begun
    twin.controls.write("gain", 1.5)
    assert twin.take().pixels.mean() == pytest.approx(before, rel=1e-3)
    assert twin.take().pixels.mean() == pytest.approx(1.5 * before, rel=1e-3)


def test_the_focus_motor_takes_its_time() -> None:
    twin = camera(device=replace(PLAIN, speed_per_s={"focus": 100.0}))
    twin.take()
    twin.controls.write("focus", 10.0)  # from 2, at 5 ms; image k begins at 20 k ms
    reached = [twin.take() and twin.setting().focus for _ in range(6)]
    np.testing.assert_allclose(reached, [3.5, 5.5, 7.5, 9.5, 10.0, 10.0], atol=1e-9)
    assert twin.controls.read("focus") == 10.0


def test_a_motor_that_is_called_back_turns_where_it_is() -> None:
    twin = camera(device=replace(PLAIN, speed_per_s={"focus": 100.0}))
    twin.take()
    twin.controls.write("focus", 10.0)
    twin.take()  # at 25 ms it is at 4
    twin.controls.write("focus", 2.0)
    reached = [twin.take() and twin.setting().focus for _ in range(3)]
    np.testing.assert_allclose(reached, [2.5, 2.0, 2.0], atol=1e-9)


# --- optics


@pytest.mark.parametrize("zoom", [100, 101, 137, 200, 333, 500])
def test_zoomed_edges_are_where_similar_triangles_put_them(zoom: int) -> None:
    """In focus, through a pinhole: u = zoom (out / in) (f x / z + cx - middle) + middle out."""
    device = replace(PLAIN, lens=ThinLens(F_M, 0.0, PIXEL_M), breathing=Breathing(0.0))
    scene = white_square(0.5, 0.01, x_m=0.0019)
    twin = camera(scene, device)
    twin.controls.write("zoom", zoom)
    found_px = np.array(step_edges_px(picture(twin)))
    sensor_px = 2000 * (0.0019 + np.array([-0.005, 0.005])) / 0.5 + 311.7
    expected_px = zoom / 100 / 2 * (sensor_px - 319.5) + 159.5
    np.testing.assert_allclose(found_px, expected_px, atol=0.01)
    corners_m = np.array([[0.0019 - 0.005, 0, 0.5], [0.0019 + 0.005, 0, 0.5]])
    np.testing.assert_allclose(twin.true_camera().project(corners_m)[:, 0], expected_px, atol=1e-9)


def test_zoom_of_pixels_that_are_read_two_by_two() -> None:
    """At 150 % a quarter of the sensor's size takes 2 x 2 as one, and shrinks them by 3 / 4."""
    lens = ThinLens(F_M, 0.0, PIXEL_M)
    device = replace(PLAIN, lens=lens, breathing=Breathing(0.0), size_px=(160, 90))
    twin = camera(white_square(0.5, 0.03), device)
    twin.controls.write("zoom", 150)
    sensor_px = 2000 * np.array([-0.015, 0.015]) / 0.5 + 311.7
    expected_px = 1.5 / 4 * (sensor_px - 319.5) + 79.5
    np.testing.assert_allclose(step_edges_px(picture(twin)), expected_px, atol=0.01)


@pytest.mark.parametrize("focus", [0.5, 2.0, 5.0, 12.0, 19.0])
@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_nearer_focus_magnifies_as_the_lens_moves_out(focus: float, share: float) -> None:
    """The disc is symmetric, so a square out of focus keeps its size by area."""
    device = replace(PLAIN, breathing=Breathing(share))
    twin = camera(white_square(0.5, 0.06), device)
    twin.controls.write("focus", focus)
    left_px, right_px = step_edges_px(picture(twin))
    image_distance_m = 1 / (1 / F_M - focus)
    focal_px = 2000 * (1 + share * (image_distance_m / F_M - 1)) / 2
    assert right_px - left_px == pytest.approx(focal_px * 0.06 / 0.5, rel=2e-4)
    assert twin.true_camera().focal_px == pytest.approx((focal_px, focal_px), rel=1e-12)
    assert twin.true_camera().focus == focus


def test_distortion_breathes_with_the_dioptres() -> None:
    sensor = replace(PLAIN.sensor, lens=BrownLens((0.1, -0.2, 0.0, 0.0)))
    device = replace(PLAIN, sensor=sensor, breathing=Breathing(0.0, (0.01, 0.02, 0.0, 0.0)))
    twin = camera(device=device)
    twin.controls.write("focus", 4.0)
    twin.take()
    assert twin.true_camera().lens.coefficients == pytest.approx((0.14, -0.12, 0.0, 0.0))


def test_breathing_needs_a_number_for_each_coefficient() -> None:
    twin = camera(device=replace(PLAIN, breathing=Breathing(1.0, (0.1,))))
    with pytest.raises(InputError, match="each of the lens's 0 distortion coefficients, got 1"):
        twin.take()


def edge_variance_px2(light: np.ndarray) -> float:
    """The second moment of the left edge's line spread, from the rows of the middle."""
    half = light.shape[0] // 2
    row = light[half - 5 : half + 5, : light.shape[1] // 2].mean(axis=0)
    slope = np.diff(row) / (row[-1] - row[0])
    places = np.arange(len(slope))
    return float(slope @ (places - slope @ places) ** 2)


@pytest.mark.parametrize(
    ("focus", "zoom"), [(6.0, 100), (9.0, 100), (12.0, 100), (5.0, 200), (8.0, 300), (18.0, 200)]
)
def test_an_edge_out_of_focus_is_as_wide_as_the_thin_lens_says(focus: float, zoom: int) -> None:
    """A disc of radius R has the second moment R^2 / 4 along an axis.

    R = A v |1/z - 1/d| / 2 pixel. A pixel that is read adds 1/12 of its side squared; the zoom adds
    1/6 for its linear interpolation and the 1/12 of a pixel given, unless it takes pixels as they
    are; and so does the difference of neighbours another 1/12.
    """
    twin = camera(white_square(0.5, 0.1, x_m=0.03), PLAIN)
    twin.controls.write("zoom", zoom)
    twin.controls.write("focus", focus)
    image_distance_m = 1 / (1 / F_M - focus)
    radius_m = APERTURE_M * image_distance_m * abs(1 / 0.5 - focus) / 2
    radius_px = radius_m / PIXEL_M * zoom / 100 / 2
    read_px = max(zoom / 200, 1)  # two by two as one at 100, as they are at 200
    expected = radius_px**2 / 4 + read_px**2 / 12 + 1 / 12
    expected += (zoom > 200) * (read_px**2 / 6 + 1 / 12)
    assert edge_variance_px2(picture(twin)) == pytest.approx(expected, rel=0.012)


def test_in_focus_an_edge_is_sharp() -> None:
    assert edge_variance_px2(picture(camera(white_square(0.5, 0.1, x_m=0.03)))) < 0.26


def test_the_seeds_focus_law() -> None:
    """F(0.05) = 130, F(0.1) = 101, F(0.5) = 33, F(1.0) = 4."""
    law = LogFocus()
    for distance_m, value in ((0.05, 130.15), (0.1, 100.96), (0.5, 33.19), (1.0, 4.0)):
        assert law.value(distance_m) == pytest.approx(value, abs=0.01)
        assert law.distance_m(law.value(distance_m)) == pytest.approx(distance_m, rel=1e-12)
    assert DioptreFocus(8.0).distance_m(0.0) == np.inf
    assert DioptreFocus(8.0).distance_m(DioptreFocus(8.0).value(0.3)) == pytest.approx(0.3)
    assert FixedFocus(2.0).distance_m(77.0) == 2.0


# --- light


def test_twice_the_exposure_is_twice_the_light_and_so_is_twice_the_gain() -> None:
    twin = camera()
    light = [picture(twin).mean()]
    twin.controls.write("exposure", 10e-3)
    light.append(picture(twin).mean())
    twin.controls.write("gain", 1.7)
    twin.controls.write("exposure", 5e-3)
    light.append(picture(twin).mean())
    np.testing.assert_allclose(light, [0.25, 0.5, 0.425], rtol=2e-4)


def test_exposure_averages_noise_away_and_gain_does_not() -> None:
    """Photon transfer: variance = gain mean / well, both as shares of full scale."""
    device = replace(PLAIN, pixels=Sensor(bits=16, full_well_e=5000.0), size_px=(640, 360))
    twin = camera(device=device)
    for exposure_s, gain in ((5e-3, 1.0), (10e-3, 1.0), (5e-3, 2.0)):
        twin.controls.write("exposure", exposure_s)
        twin.controls.write("gain", gain)
        light = picture(twin)
        assert light.var() == pytest.approx(gain * light.mean() / 5000, rel=0.02)


def test_pixels_read_as_one_have_the_noise_of_their_sum() -> None:
    """2 x 2 pixels of 5000 electrons each with 20 of reading: 20000 and 40."""
    device = replace(PLAIN, pixels=Sensor(bits=16, full_well_e=5000.0, read_noise_e=20.0))
    light = picture(camera(device=device))
    expected = light.mean() / 20000 + (40 / 20000) ** 2
    assert light.var() == pytest.approx(expected, rel=0.02)


def test_noise_depends_on_the_seed_and_the_images_number_alone() -> None:
    noisy = replace(PLAIN, pixels=Sensor(bits=16, full_well_e=5000.0))
    one, other, third = camera(device=noisy), camera(device=noisy), camera(device=noisy, seed=1)
    images = [one.take() for _ in range(3)]
    other.advance(0.0461)
    np.testing.assert_array_equal(other.take().pixels, images[2].pixels)
    assert (images[0].pixels != images[1].pixels).mean() > 0.9
    assert (third.take().pixels != images[0].pixels).mean() > 0.9


def test_vignetting_is_the_cos4_law_at_any_zoom() -> None:
    device = replace(
        PLAIN, vignetting=replace(webcam().vignetting, cos4=1.0), focus_law=FixedFocus(np.inf)
    )
    for zoom in (100, 260):
        twin = camera(device=device)
        twin.controls.write("zoom", zoom)
        u, v = np.meshgrid(np.arange(320.0), np.arange(180.0))
        light, own = picture(twin), twin.true_camera()
        tangent2 = ((u - own.center_px[0]) / own.focal_px[0]) ** 2
        tangent2 += ((v - own.center_px[1]) / own.focal_px[1]) ** 2
        np.testing.assert_allclose(light, 0.25 / (1 + tangent2) ** 2, rtol=3e-4)


# --- auto modes


@pytest.mark.parametrize("background", [0.02, 0.1, 0.8])
def test_auto_exposure_settles_on_a_medium_grey(background: float) -> None:
    device = replace(PLAIN, delay_images={"exposure": 2, "gain": 2})
    twin = camera(Scene((), background=background), device)
    twin.controls.write("auto_exposure", 1)
    means = [image.pixels.mean() / 65535 for image in itertools.islice(twin, 20)]
    reachable = min(0.45, background * 100 * 10e-3 * 8)
    np.testing.assert_allclose(means[10:], reachable, rtol=0.12)
    assert np.ptp(means[-5:]) < 1e-3  # it does not hunt


def test_manual_values_are_refused_while_an_auto_mode_has_the_control() -> None:
    controls = camera().controls
    controls.write("auto_exposure", 1)
    with pytest.raises(
        ControlRefusedError, match="gain: auto_exposure is on; write auto_exposure 0"
    ):
        controls.write("gain", 2.0)
    controls.write("auto_exposure", 0)
    assert controls.write("gain", 2.0) == 2.0


@pytest.mark.parametrize("z_m", [0.08, 0.2, 0.45])
def test_auto_focus_finds_what_there_is_to_see(z_m: float) -> None:
    pattern = marker_thing(
        [MountedMarker("tag36h11", 3, 0.12 * z_m, RigidTransform.identity())],
        Still(RigidTransform.from_components([0.0, 0.0, z_m], FACING)),
    )
    twin = camera(Scene((pattern,)), replace(PLAIN, speed_per_s={"focus": 200.0}))
    twin.controls.write("auto_focus", 1)
    for _ in itertools.islice(twin, 60):
        pass
    assert twin.setting().focus == pytest.approx(1 / z_m, abs=0.5)  # below 0.5 px of blur
    assert twin.controls.read("focus") == pytest.approx(twin.setting().focus)


# --- faults and refusals


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


# --- the ready-made ones


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

"""Exposure, gain, noise and vignetting of the simulated camera, and its auto modes."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from plain_camera import FACING, PLAIN, camera, picture

from tagmetry.camera import ControlRefusedError
from tagmetry.geometry import RigidTransform
from tagmetry.markers import MountedMarker
from tagmetry.twin.camera import FixedFocus, webcam
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.scenes import Scene, Still, marker_thing


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

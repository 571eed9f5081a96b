"""The quick sensor against the law of photon transfer and against the full one."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.twin.optics.quick_sensor import quick_development
from tagmetry.twin.optics.response import Srgb
from tagmetry.twin.optics.sensor import Sensor, developed
from tagmetry.twin.rendering import exposed
from tagmetry.twin.rendering.binned import binned
from tagmetry.twin.scenes import Light, Scene, Still, surface
from tagmetry.twin.scenes.path import looking
from tagmetry.twin.scenes.ready.photographer import machine_camera

SENSOR = Sensor(full_well_e=10_500, read_noise_e=7, black_level=0.01)
SIZE_PX = 320, 240


def flat(exposure: float) -> np.ndarray:
    return np.full(SIZE_PX[::-1], exposure, np.float32)


@pytest.mark.parametrize("exposure", [0.05, 0.3, 0.9])
def test_mean_and_variance_follow_the_law_of_photon_transfer(exposure: float) -> None:
    develop = quick_development(SENSOR, SIZE_PX)
    pixels = develop(flat(exposure), np.random.default_rng(1)).astype(float)
    dark, k = 255 * 0.01, 255 * 0.99 / 10_500
    mean = dark + 255 * 0.99 * exposure
    variance = k * (mean - dark) + (k * 7) ** 2 + 1 / 12
    assert pixels.mean() == pytest.approx(mean, abs=0.05)
    assert pixels.var() == pytest.approx(variance, rel=0.03)


@pytest.mark.parametrize("exposure", [0.0, 0.02, 0.5, 1.5])
def test_it_is_like_the_full_sensor(exposure: float) -> None:
    rng = np.random.default_rng(2)
    quick = quick_development(SENSOR, SIZE_PX)(flat(exposure), rng).astype(float)
    full = developed(flat(exposure), SENSOR, rng).astype(float)
    assert quick.mean() == pytest.approx(full.mean(), abs=0.08)
    assert quick.std() == pytest.approx(full.std(), abs=0.06)


def test_pixels_and_pictures_are_independent() -> None:
    develop, rng = quick_development(SENSOR, SIZE_PX), np.random.default_rng(3)
    one, two = (develop(flat(0.5), rng).astype(float) for _ in range(2))
    for first, second in ((one, two), (one[:, :-1], one[:, 1:]), (one[:-1], one[1:])):
        assert abs(np.corrcoef(first.ravel(), second.ravel())[0, 1]) < 0.02


def test_the_exposure_is_untouched() -> None:
    exposure = flat(0.5)
    quick_development(SENSOR, SIZE_PX)(exposure, np.random.default_rng(0))
    assert (exposure == 0.5).all()


@pytest.mark.parametrize(
    "sensor",
    [Sensor(), replace(SENSOR, bits=12), replace(SENSOR, response=Srgb()), Sensor(noise_grey=2.0)],
)
def test_any_other_sensor_is_the_full_one(sensor: Sensor) -> None:
    quick = quick_development(sensor, SIZE_PX)(flat(0.4), np.random.default_rng(5))
    full = developed(flat(0.4), sensor, np.random.default_rng(5))
    np.testing.assert_array_equal(quick, full)


def test_a_binned_camera_sees_the_same_with_half_the_pixels() -> None:
    shot = machine_camera(Still(looking(np.array([0.0, 0.0, 2.6]), np.zeros(3))), 70.0)
    half = binned(shot)
    assert half.camera.size_px == (960, 540)
    p_camera = np.array([[0.3, -0.2, 2.0], [-1.0, 0.4, 2.5]])
    whole_px, half_px = shot.camera.project(p_camera), half.camera.project(p_camera)
    np.testing.assert_allclose(half_px + 0.5, (whole_px + 0.5) / 2, atol=1e-9)


def test_a_binned_pixel_gathers_what_four_do() -> None:
    shot = machine_camera(Still(looking(np.array([0.0, 0.0, 2.6]), np.zeros(3))), 70.0)
    light = Scene((surface("sheet", 0.8, 0.5, brightness=0.5),), Light())
    whole, half = exposed(light, shot), exposed(light, binned(shot))
    means = whole.reshape(540, 2, 960, 2).mean(axis=(1, 3))
    assert np.abs(means - half).max() < 0.1  # at the sheet's edge, where blurs differ in shape
    assert np.abs(means - half).mean() < 2e-3
    assert binned(shot).sensor.full_well_e == 4 * 10_500
    assert binned(shot).sensor.read_noise_e == 2 * 7

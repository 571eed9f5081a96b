"""A sensor's noise obeys the photon transfer law, and its ends are where they should be."""

import numpy as np
import pytest
from scipy import stats

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import FloatImage
from tagmetry.twin.optics.response import Gamma, Hdr, Srgb
from tagmetry.twin.optics.sensor import Sensor, developed

WHITE_8 = 255


def even(exposure: float, size_px: int = 300) -> FloatImage:
    return np.full((size_px, size_px), exposure, np.float32)


def rng(seed: int = 0) -> np.random.Generator:
    return np.random.default_rng(seed)


def ramp() -> FloatImage:
    return np.tile(np.linspace(0, 1, 512, dtype=np.float32), (8, 1))


def test_a_plain_sensor_only_rounds() -> None:
    seen = developed(ramp(), Sensor(), rng())
    assert seen.dtype == np.uint8
    np.testing.assert_array_equal(seen, np.rint(255 * ramp()))
    np.testing.assert_array_equal(developed(np.float32([[-0.5, 1.7]]), Sensor(), rng()), [[0, 255]])


@pytest.mark.parametrize("bits", [8, 10, 12, 16])
def test_grey_values_have_the_bits_asked_for(bits: int) -> None:
    seen = developed(ramp(), Sensor(bits=bits), rng())
    assert seen.dtype == (np.uint8 if bits == 8 else np.uint16)
    assert seen.min() == 0
    assert seen.max() == 2**bits - 1
    np.testing.assert_allclose(seen / (2**bits - 1), ramp(), atol=0.501 / (2**bits - 1))


@pytest.mark.parametrize("bits", [8, 12])
@pytest.mark.parametrize("gain", [1.0, 2.5])
@pytest.mark.parametrize("exposure", [0.002, 0.02, 0.1, 0.35])
def test_variance_follows_the_photon_transfer_law(bits: int, gain: float, exposure: float) -> None:
    sensor = Sensor(bits, full_well_e=4000.0, read_noise_e=12.0, gain=gain, black_level=0.06)
    seen = developed(even(exposure), sensor, rng(1)).astype(np.float64)
    grey_per_e = gain * 0.94 * (2**bits - 1) / 4000.0
    dark = 0.06 * (2**bits - 1)
    mean = dark + grey_per_e * 4000.0 * exposure
    variance = grey_per_e * (mean - dark) + (grey_per_e * 12.0) ** 2 + 1 / 12
    spread = np.sqrt(variance / seen.size)
    assert seen.mean() == pytest.approx(mean, abs=5 * spread)
    assert seen.var() == pytest.approx(variance, rel=5 * np.sqrt(2 / seen.size))


@pytest.mark.parametrize("mean_e", [0.3, 4.0, 60.0])
def test_few_electrons_are_counted_as_poisson_counts(mean_e: float) -> None:
    sensor = Sensor(bits=16, full_well_e=500.0)
    seen = developed(even(mean_e / 500.0), sensor, rng(2))
    counts = np.rint(seen / 65535 * 500).astype(int)
    np.testing.assert_allclose(seen, counts / 500 * 65535, atol=0.51)
    values = np.arange(counts.max() + 1)
    share = stats.poisson.pmf(values, mean_e)
    kept = share * counts.size > 10
    seen_in = np.bincount(counts.ravel())[kept]
    expected = share[kept] / share[kept].sum() * seen_in.sum()
    assert stats.chisquare(seen_in, expected).pvalue > 1e-3


def test_counting_and_its_normal_form_meet_without_a_step() -> None:
    """The law of the mean and variance holds on both sides of where one takes over."""
    sensor = Sensor(bits=16, full_well_e=2000.0)
    few, many = (developed(even(e / 2000.0), sensor, rng(3)) / 65535 * 2000 for e in (999, 1001))
    for electrons, mean_e in ((few, 999), (many, 1001)):
        assert electrons.mean() == pytest.approx(mean_e, abs=5 * np.sqrt(1000 / few.size))
        assert electrons.var() == pytest.approx(mean_e, rel=5 * np.sqrt(2 / few.size))


def test_noise_in_grey_values_is_added_to_them() -> None:
    seen = developed(even(0.5), Sensor(noise_grey=3.0, response=Gamma()), rng(4))
    assert seen.mean() == pytest.approx(255 * 0.5 ** (1 / 2.2), abs=0.05)
    assert seen.var() == pytest.approx(9 + 1 / 12, rel=0.03)


def test_the_well_is_full_at_full_scale_however_the_signal_is_amplified() -> None:
    half = Sensor(bits=12, full_well_e=1e4, gain=0.5)
    seen = developed(even(8.0), half, rng(5))
    assert (seen == np.rint(4095 / 2)).all()
    double = Sensor(bits=12, full_well_e=1e4, gain=2.0)
    assert (developed(even(0.6), double, rng(5)) == 4095).all()


def test_an_hdr_sensor_still_tells_lights_beyond_full_scale_apart() -> None:
    sensor = Sensor(full_well_e=2e4, response=Hdr(stops=5.0))
    levels = [developed(even(2.0**stop, 50), sensor, rng(6)).mean() for stop in range(7)]
    assert (np.diff(levels[:6]) > 10).all()
    assert levels[5] == levels[6] == WHITE_8


def test_darkness_is_the_black_level() -> None:
    sensor = Sensor(bits=12, full_well_e=1e4, read_noise_e=20.0, black_level=0.05)
    seen = developed(even(0.0), sensor, rng(7))
    assert seen.mean() == pytest.approx(0.05 * 4095, abs=0.2)
    assert seen.std() == pytest.approx(20.0 * 0.95 * 4095 / 1e4, rel=0.03)


def test_the_response_is_applied_before_rounding() -> None:
    np.testing.assert_array_equal(
        developed(ramp(), Sensor(response=Srgb()), rng()), np.rint(255 * Srgb().code(ramp()))
    )


def test_more_light_is_never_darker() -> None:
    sensor = Sensor(black_level=0.02, gain=1.3, response=Gamma())
    seen = developed(ramp() * 1.5, sensor, rng()).astype(int)
    assert (np.diff(seen, axis=1) >= 0).all()


def test_jpeg_of_the_best_quality_changes_hardly_a_grey_value() -> None:
    rough = np.random.default_rng(8).random((64, 80), dtype=np.float32)
    plain = developed(rough, Sensor(), rng()).astype(int)
    packed = developed(rough, Sensor(jpeg_quality=100), rng())
    assert packed.dtype == np.uint8
    assert packed.shape == plain.shape
    assert np.abs(packed - plain).max() <= 2


def test_jpeg_of_low_quality_leaves_less() -> None:
    rough = np.random.default_rng(9).random((64, 80), dtype=np.float32)
    plain = developed(rough, Sensor(), rng()).astype(int)
    errors = [
        np.abs(developed(rough, Sensor(jpeg_quality=quality), rng()) - plain).mean()
        for quality in (95, 60, 10)
    ]
    assert errors[0] < errors[1] < errors[2]
    assert errors[2] > 10


def test_the_same_seed_gives_the_same_image_and_another_another() -> None:
    sensor = Sensor(full_well_e=3000.0, read_noise_e=4.0, noise_grey=0.5)
    one, two, other = (developed(ramp(), sensor, rng(seed)) for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, two)
    assert (one != other).mean() > 0.3


def test_neither_the_light_nor_the_generator_of_a_silent_sensor_is_touched() -> None:
    light, before, noise = ramp(), ramp(), rng(3)
    developed(light, Sensor(response=Gamma(), jpeg_quality=90), noise)
    developed(light, Sensor(), noise)
    np.testing.assert_array_equal(light, before)
    assert noise.random() == rng(3).random()


def test_one_pixel_is_an_image() -> None:
    assert developed(even(1.0, 1), Sensor(full_well_e=100.0, jpeg_quality=90), rng()).shape == (
        1,
        1,
    )


@pytest.mark.parametrize(
    ("numbers", "text"),
    [
        ({"bits": 7}, "8 to 16 bits, got 7"),
        ({"bits": 10, "jpeg_quality": 90}, "JPEG holds 8 bits, got 10"),
        ({"jpeg_quality": 0}, "jpeg_quality is 1 to 100, got 0"),
        ({"full_well_e": 0.0}, "full_well_e must be positive, got 0.0"),
        ({"full_well_e": float("nan")}, "full_well_e must be positive, got nan"),
        ({"read_noise_e": 3.0}, "needs full_well_e"),
        ({"full_well_e": 1.0, "read_noise_e": -3.0}, "read_noise_e must be 0 or more, got -3.0"),
        ({"gain": 0.0}, "gain must be positive, got 0.0"),
        ({"black_level": 1.0}, "black_level is a share of the range"),
        ({"noise_grey": -1.0}, "noise_grey must be 0 or more, got -1.0"),
    ],
)
def test_refuses_sensors_that_cannot_be(numbers: dict[str, float], text: str) -> None:
    with pytest.raises(InputError, match=text):
        Sensor(**numbers)


def test_refuses_light_that_is_no_image() -> None:
    with pytest.raises(InputError, match=r"expected an exposure of shape \(height, width\)"):
        developed(np.zeros((0, 3), np.float32), Sensor(), rng())
    with pytest.raises(InputError, match="exposure has values that are not finite"):
        developed(np.float32([[np.nan, 0.5]]), Sensor(), rng())

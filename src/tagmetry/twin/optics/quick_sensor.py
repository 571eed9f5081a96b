"""A sensor's image in some milliseconds, for pictures that come many a second.

    grey = round(k (mean_e + sqrt(mean_e + read_noise_e^2) n) + dark)

n is a field of normal numbers, drawn once and laid elsewhere for every picture: the noise of two
pixels of a picture is independent, but pictures share it, shifted. The skewness of few electrons,
and that a full well is full before its reading, are left out.
"""

from collections.abc import Callable
from functools import partial

import cv2
import numpy as np

from tagmetry.geometry.arrays import FloatImage, GreyPixels
from tagmetry.twin.optics.response import Linear
from tagmetry.twin.optics.sensor import CodedPixels, Sensor, developed

_SHIFT_PX = 64  # so many places along each axis, for one field of noise

Development = Callable[[FloatImage, np.random.Generator], CodedPixels]


def quick_development(sensor: Sensor, size_px: tuple[int, int]) -> Development:
    """Return what `developed` does to exposures of one size, quicker where the sensor allows it.

    Args:
        sensor: Linear, of 8 bits and with shot noise, to be quick.
        size_px: (width, height) of the exposures.
    """
    if not _is_simple(sensor):
        return partial(_slowly, sensor)
    width_px, height_px = size_px
    shape = height_px + _SHIFT_PX, width_px + _SHIFT_PX
    noise = np.random.default_rng(0).standard_normal(shape, np.float32)
    return partial(_quickly, sensor, noise)


def _is_simple(sensor: Sensor) -> bool:
    has_one_noise = sensor.full_well_e is not None and sensor.noise_grey == 0
    is_plain = sensor.bits == 8 and sensor.gain >= 1 and sensor.jpeg_quality is None
    return has_one_noise and is_plain and isinstance(sensor.response, Linear)


def _slowly(sensor: Sensor, exposure: FloatImage, rng: np.random.Generator) -> CodedPixels:
    return developed(exposure, sensor, rng)


def _quickly(
    sensor: Sensor, noise: FloatImage, exposure: FloatImage, rng: np.random.Generator
) -> GreyPixels:
    full_well_e = sensor.full_well_e or 1.0
    down, right = rng.integers(_SHIFT_PX, size=2).tolist()
    height_px, width_px = exposure.shape
    laid = noise[down : down + height_px, right : right + width_px]
    mean_e = exposure * np.float32(full_well_e)
    noise_e = laid * np.sqrt(mean_e + np.float32(sensor.read_noise_e**2))
    grey_per_e = sensor.gain * (1 - sensor.black_level) * sensor.white_grey / full_well_e
    dark = sensor.white_grey * sensor.black_level
    pixels = cv2.addWeighted(mean_e, grey_per_e, noise_e, grey_per_e, dark, dtype=cv2.CV_8U)
    return np.asarray(pixels, np.uint8)

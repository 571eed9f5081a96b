"""The sensor: from the light on every pixel to the numbers in the image.

    electrons ~ Poisson(full_well_e * exposure), up to the full well
    signal    = gain * (electrons + read noise) / full_well_e
    code      = response(black_level + (1 - black_level) * signal)
    grey      = round((2^bits - 1) * code + noise_grey), clipped; then JPEG

With a linear response this obeys the law of photon transfer: with k = gain (1 - black_level)
(2^bits - 1) / full_well_e grey values an electron, the variance of a grey value is
k (mean - dark) + (k read_noise_e)^2 + 1/12.
"""

from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.typing import NDArray

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import FloatImage
from tagmetry.twin.optics.response import Linear, Response

_MANY_E = 1000.0  # from here on Poisson's skewness, below 0.032, is lost in the rounding

CodedPixels = NDArray[np.uint8] | NDArray[np.uint16]


@dataclass(frozen=True)
class Sensor:
    """What a sensor and its converter do to light; by default they only round to 8 bits.

    Attributes:
        bits: Of a grey value, 8 to 16.
        full_well_e: Electrons at exposure 1; None is light without shot noise.
        read_noise_e: Standard deviation of the reading, electrons; needs a full well.
        gain: Factor on the signal after the well.
        black_level: Share of the range that a dark pixel reports, before the response.
        response: From signal to code.
        noise_grey: Standard deviation of noise added to the grey values themselves.
        jpeg_quality: 1 to 100, for 8 bits; None is without.
    """

    bits: int = 8
    full_well_e: float | None = None
    read_noise_e: float = 0.0
    gain: float = 1.0
    black_level: float = 0.0
    response: Response = field(default_factory=Linear)
    noise_grey: float = 0.0
    jpeg_quality: int | None = None

    def __post_init__(self) -> None:
        self._check_electrons()
        if self.bits not in range(8, 17):
            raise InputError(f"a grey value has 8 to 16 bits, got {self.bits}")
        if not (np.isfinite(self.gain) and self.gain > 0):
            raise InputError(f"gain must be positive, got {self.gain}")
        if not 0 <= self.black_level < 1:
            raise InputError(f"black_level is a share of the range, 0 to 1, got {self.black_level}")
        if not (np.isfinite(self.noise_grey) and self.noise_grey >= 0):
            raise InputError(f"noise_grey must be 0 or more, got {self.noise_grey}")
        if self.jpeg_quality is not None and self.bits != 8:
            raise InputError(f"JPEG holds 8 bits, got {self.bits}")
        if self.jpeg_quality is not None and self.jpeg_quality not in range(1, 101):
            raise InputError(f"jpeg_quality is 1 to 100, got {self.jpeg_quality}")

    def _check_electrons(self) -> None:
        if not (np.isfinite(self.read_noise_e) and self.read_noise_e >= 0):
            raise InputError(f"read_noise_e must be 0 or more, got {self.read_noise_e}")
        if self.full_well_e is None and self.read_noise_e > 0:
            raise InputError("read_noise_e is in electrons and needs full_well_e to scale it")
        if self.full_well_e is not None and not (
            np.isfinite(self.full_well_e) and self.full_well_e > 0
        ):
            raise InputError(f"full_well_e must be positive, got {self.full_well_e}")

    @property
    def white_grey(self) -> int:
        """The greatest grey value."""
        return int(2**self.bits - 1)


def developed(exposure: FloatImage, sensor: Sensor, rng: np.random.Generator) -> CodedPixels:
    """Return the image that a sensor makes of light, shape (height, width), uint8 or uint16.

    Args:
        exposure: Light on every pixel as a share of full scale, shape (height, width); may exceed
            1, and is taken as 0 below.
        sensor: What happens to it.
        rng: Where all noise comes from.
    """
    if exposure.ndim != 2 or exposure.size == 0:
        raise InputError(f"expected an exposure of shape (height, width), got {exposure.shape}")
    if not np.isfinite(exposure).all():
        raise InputError("the exposure has values that are not finite")
    signal = sensor.gain * _gathered(np.maximum(exposure, 0), sensor, rng)
    code = sensor.response.code(sensor.black_level + (1 - sensor.black_level) * signal)
    pixels = _rounded(sensor.white_grey * code, sensor, rng)
    return pixels if sensor.jpeg_quality is None else through_jpeg(pixels, sensor.jpeg_quality)


def _gathered(exposure: FloatImage, sensor: Sensor, rng: np.random.Generator) -> FloatImage:
    """Return the exposure as read in electrons, up to the full well."""
    if sensor.full_well_e is None:
        return exposure
    most_e = sensor.full_well_e * sensor.response.full_exposure
    electrons = np.minimum(_shot(exposure * np.float32(sensor.full_well_e), rng), most_e)
    if sensor.read_noise_e > 0:
        electrons += sensor.read_noise_e * rng.standard_normal(exposure.shape, np.float32)
    return np.asarray(electrons / sensor.full_well_e)


def _shot(mean_e: FloatImage, rng: np.random.Generator) -> FloatImage:
    """Return counts of electrons: Poisson where they are few, normal where it looks the same."""
    electrons = mean_e + np.sqrt(mean_e) * rng.standard_normal(mean_e.shape, np.float32)
    few = mean_e < _MANY_E
    electrons[few] = rng.poisson(mean_e[few])
    return np.asarray(electrons)


def _rounded(grey: FloatImage, sensor: Sensor, rng: np.random.Generator) -> CodedPixels:
    """Return whole grey values of the sensor's bits."""
    if sensor.noise_grey > 0:
        grey = grey + sensor.noise_grey * rng.standard_normal(grey.shape, np.float32)
    whole = np.clip(np.rint(grey), 0, sensor.white_grey)
    return whole.astype(np.uint8) if sensor.bits == 8 else whole.astype(np.uint16)


def through_jpeg(pixels: CodedPixels, quality: int) -> CodedPixels:
    """Return what is left of 8-bit pixels after JPEG."""
    _, packed = cv2.imencode(".jpg", pixels, [cv2.IMWRITE_JPEG_QUALITY, quality])
    return np.asarray(cv2.imdecode(packed, cv2.IMREAD_GRAYSCALE), np.uint8)

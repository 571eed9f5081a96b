"""An image of a background alone, made quickly: its mean is smooth, and so is its noise.

    signal   = gain light, variance gain light / well + (gain read / well)^2 + 1 / (12 white^2)
    shown    = sums of signals with weights w: variance times the sum of w^2
    grey     = white code(signal), its deviation that of the signal times the curve's slope

Exact to first order in the noise; that neighbours share some of it after a digital zoom is left
out. Means and deviations are computed for every 16th pixel and interpolated.
"""

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from tagmetry.camera import Camera
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels, FloatImage
from tagmetry.twin.camera.device import Device
from tagmetry.twin.camera.intrinsics import image_camera
from tagmetry.twin.camera.readout import EDGE, Readout, coarser, readout
from tagmetry.twin.camera.setting import Setting
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.vignetting import gain_map

_STEP_PX = 16
_SLOPE_STEP = 1e-3  # of the exposure, over which the response's slope is taken
_LEAST_LIGHT = 1e-6
_SPARE = 2**20  # different noises of one size


def empty_pixels(
    device: Device, setting: Setting, background: float, rng: np.random.Generator
) -> AnyPixels:
    """Return a grey image of a background, shape (height, width), uint8 or uint16.

    Args:
        device: The camera's hardware.
        setting: What it is set to.
        background: Its radiance.
        rng: Where the noise comes from.
    """
    camera = image_camera(device, setting)
    rough = coarser(camera, _STEP_PX)
    exposure = device.sensitivity_per_s * setting.exposure_s * background
    light = gain_map(rough, device.vignetting) * exposure
    mean, deviation = _grey(np.maximum(light, _LEAST_LIGHT), device, setting)
    grey = _fine(deviation, camera)
    grey *= _unit_noise(camera, rng)
    grey += _fine(mean, camera)
    return _whole(grey, device.output.bits)


def _whole(grey: FloatImage, bits: int) -> AnyPixels:
    """Return whole grey values."""
    if bits == 8:
        return np.asarray(cv2.convertScaleAbs(np.maximum(grey, 0, out=grey)), np.uint8)
    return np.rint(np.clip(grey, 0, 2**bits - 1)).astype(np.uint16)


def _grey(light: Array, device: Device, setting: Setting) -> tuple[Array, Array]:
    """Return means and standard deviations of grey values."""
    read = readout(device, setting.zoom_percent / 100, setting.focus)
    sensor = read.sensor(setting.gain)
    signal, variance = _read_out(light, sensor)
    variance = variance * _share_of_noise(read)
    output, response = device.output, device.output.response
    step = _SLOPE_STEP * np.maximum(signal, _SLOPE_STEP)
    slope = (response.code(signal + step) - response.code(signal - step)) / (2 * step)
    mean = output.white_grey * response.code(signal)
    return np.asarray(mean), np.asarray(np.sqrt(variance) * slope * output.white_grey)


def _read_out(light: Array, sensor: Sensor) -> tuple[Array, Array]:
    """Return mean and variance of the signal of a sensor's pixel."""
    variance = np.full_like(light, 1 / 12 / sensor.white_grey**2)
    full = light >= 1
    if sensor.full_well_e is not None:
        counted = sensor.read_noise_e**2 + np.where(full, 0.0, light * sensor.full_well_e)
        variance += counted * (sensor.gain / sensor.full_well_e) ** 2
    return np.minimum(sensor.gain * np.minimum(light, 1), 1), variance


def _share_of_noise(read: Readout) -> float:
    """Return the variance of a pixel of the image by that of one that is read."""
    squares = [weights.power(2).sum() / weights.shape[0] for weights in map(read.weights, (0, 1))]
    return float(np.prod(squares))


def _fine(rough: Array, camera: Camera) -> FloatImage:
    """Return what is smooth at the camera's own pixels, from larger ones and some around it."""
    rows, columns = rough.shape
    size_px = (_STEP_PX * columns, _STEP_PX * rows)
    fine = cv2.resize(rough.astype(np.float32), size_px, interpolation=cv2.INTER_LINEAR)
    edge_px = EDGE * _STEP_PX
    return np.asarray(fine[edge_px:, edge_px:][: camera.height_px, : camera.width_px], np.float32)


def _unit_noise(camera: Camera, rng: np.random.Generator) -> FloatImage:
    """Return normal noise: a part, at random, of what is drawn once."""
    width_px, height_px = camera.size_px
    count = width_px * height_px
    start = int(rng.integers(_SPARE))
    return _normal(count + _SPARE)[start : start + count].reshape(height_px, width_px)


@lru_cache(maxsize=4)
def _normal(count: int) -> NDArray[np.float32]:
    return np.random.default_rng(0).standard_normal(count, np.float32)

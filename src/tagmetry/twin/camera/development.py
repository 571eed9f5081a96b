"""One image of a simulated camera: light on the sensor, its electrons, digital zoom, code.

Where everything is far out of focus, the light is computed for larger pixels and interpolated: a
pixel at most 1/8 of the least disc's radius adds at most 0.6 % to the disc's second moment.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels, FloatImage
from tagmetry.twin.camera.device import Device
from tagmetry.twin.camera.part import Part, part_for, whole
from tagmetry.twin.camera.readout import Readout, coarser, finer, readout
from tagmetry.twin.camera.setting import Setting
from tagmetry.twin.optics.sensor import developed
from tagmetry.twin.optics.spread import gaussian_kernel, gaussian_reach
from tagmetry.twin.rendering import Optics, Shot, Shutter, exposed
from tagmetry.twin.rendering.box import Box
from tagmetry.twin.scenes import Path, Scene

_DISC_PER_PIXEL = 8.0  # least radius of the discs by a pixel's side, where pixels are made larger
_NEAREST_M = 1e-6


@dataclass(frozen=True, eq=False)
class Taking:
    """One image about to be taken.

    Attributes:
        device: The camera's hardware.
        setting: What it is set to.
        scene: What there is to see.
        path: Where the camera is, T_world_camera.
        time_s: Middle of the exposure.
    """

    device: Device
    setting: Setting
    scene: Scene
    path: Path
    time_s: float

    @property
    def focus_m(self) -> float:
        """The distance in focus."""
        return self.device.focus_law.distance_m(self.setting.focus)

    @property
    def depths_m(self) -> list[Array]:
        """Depths of every sheet's corners, those behind the camera just before it."""
        times_s = np.array([self.time_s])
        T_camera_world = self.path.at(times_s)[0].inv()
        return [
            np.maximum(
                (T_camera_world * thing.path.at(times_s)[0] * sheet.T_thing_sheet).apply(
                    sheet.corners_m
                )[:, 2],
                _NEAREST_M,
            )
            for thing in self.scene.things
            for sheet in thing.sheets
        ]


def image_pixels(taking: Taking, rng: np.random.Generator, window: Box | None = None) -> AnyPixels:
    """Return a grey image or a window of it, shape (height, width), uint8 or, above 8 bits, uint16.

    Args:
        taking: What is taken, and how.
        rng: Where the noise comes from.
        window: Which pixels of the image; None for all.
    """
    device, setting = taking.device, taking.setting
    read = readout(device, setting.zoom_percent / 100, setting.focus)
    softened_px = device.blur_px / read.binned
    part = whole(read) if window is None else part_for(read, window, gaussian_reach(softened_px))
    light = _softened(_light(taking, part), softened_px) * part.read.vignette
    light *= np.float32(device.sensitivity_per_s * setting.exposure_s)
    sensor = read.sensor(setting.gain)
    signal = developed(light, sensor, rng).astype(np.float32) / np.float32(sensor.white_grey)
    return developed(part.shown(signal), device.output, rng)


def _light(taking: Taking, part: Part) -> FloatImage:
    """Return the light on the pixels that are read."""
    times = _coarseness(taking, part.read)
    light = exposed(taking.scene, _shot(taking, part, times))
    return light if times == 1 else finer(light, part.read.camera, times)


def _shot(taking: Taking, part: Part, times: int) -> Shot:
    """Return what the renderer needs, with pixels so many times larger than those read."""
    read = part.read
    camera = read.camera if times == 1 else coarser(read.camera, times)
    line_s = taking.device.line_s * read.binned
    return Shot(
        camera,
        taking.path,
        taking.time_s + part.rows_later * line_s,
        Optics(
            lens=read.lens_of(times),
            focus_m=taking.focus_m,
            later_px=taking.device.blur_px / (read.binned * times),
        ),
        Shutter(taking.setting.exposure_s, line_s * times),
    )


def _coarseness(taking: Taking, read: Readout) -> int:
    """Return how many times larger pixels may be: a power of two."""
    least_px = min(
        (_least_disc_px(taking, read, depths_m) for depths_m in taking.depths_m), default=0.0
    )
    return int(2 ** max(np.floor(np.log2(max(least_px / _DISC_PER_PIXEL, 1.0))), 0))


def _least_disc_px(taking: Taking, read: Readout, depths_m: Array) -> float:
    """Return the radius of the least disc that a sheet can have between its corners' depths."""
    sharpest_m = np.clip(taking.focus_m, depths_m.min(), depths_m.max())
    return float(read.lens_of(1).blur_radius_px(sharpest_m, taking.focus_m))


def _softened(light: FloatImage, deviation_px: float) -> FloatImage:
    """Return light of which the pixels share some with their neighbours."""
    if deviation_px == 0:
        return light
    kernel = gaussian_kernel(deviation_px)
    done = cv2.sepFilter2D(light, cv2.CV_32F, kernel, kernel, borderType=cv2.BORDER_REPLICATE)
    return np.asarray(done, np.float32)

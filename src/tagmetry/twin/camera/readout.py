"""Which part of the sensor an image needs, and what its pixels are made of.

Where an image needs at most every b-th pixel, b x b pixels are read as one: their electrons and the
variances of their readings add up.
"""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from scipy.sparse import csr_array

from tagmetry.camera import Camera, cropped, scaled
from tagmetry.geometry.arrays import FloatImage
from tagmetry.twin.camera.device import Device
from tagmetry.twin.camera.intrinsics import sensor_camera
from tagmetry.twin.optics.digital_zoom import resampling
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.optics.vignetting import gain_map

_MARGIN_PX = 4  # more than any interpolation reaches beyond the pixels that are shown
_VIGNETTE_PX = 16  # the corners darken so slowly that every 16th pixel tells
EDGE = 2  # larger pixels around the image: as far as their interpolation reaches


@dataclass(frozen=True, eq=False)
class Readout:
    """The part of the sensor that is read.

    Attributes:
        device: The camera's hardware.
        zoom: Of the image, as a factor.
        camera: Intrinsics of the part that is read.
        binned: How many pixels along a side are read as one.
    """

    device: Device
    zoom: float
    camera: Camera
    binned: int

    def lens_of(self, times: int) -> ThinLens:
        """Return the lens with pixels so many times larger than those that are read."""
        lens = self.device.lens
        return replace(lens, pixel_m=lens.pixel_m * self.binned * times)

    def sensor(self, gain: float) -> Sensor:
        """Return the pixels that are read: b^2 wells, b times the reading's noise."""
        own = self.device.pixels
        well_e = None if own.full_well_e is None else own.full_well_e * self.binned**2
        read_noise_e = own.read_noise_e * self.binned
        return replace(own, full_well_e=well_e, read_noise_e=read_noise_e, gain=own.gain * gain)

    def shown(self, signal: FloatImage) -> FloatImage:
        """Return the image's share of what was read, resampled to the image's size."""
        width_px, height_px = self.device.size_px
        if self._is_as_read:
            left_px, top_px = self._spare_px
            return signal[top_px // 2 :, left_px // 2 :][:height_px, :width_px]
        across, down = self.weights(0), self.weights(1)
        return np.asarray((across @ (down @ signal).T).T, np.float32)

    def weights(self, axis: int) -> csr_array:
        """Return what the image's columns (axis 0) or rows (1) are of those read, sparse."""
        read_px, shown_px = self.camera.size_px[axis], self.device.size_px[axis]
        if self._is_as_read:
            return _taken(shown_px, read_px)
        zoom = self.zoom * read_px * self.binned / self.device.sensor.size_px[axis]
        return resampling(read_px, shown_px, zoom, self.device.interpolation)

    @property
    def _is_as_read(self) -> bool:
        """Whether a pixel of the image is a pixel that is read."""
        read_px = self.device.sensor.width_px / self.binned
        is_same = np.isclose(self.zoom * self.device.size_px[0], read_px, rtol=1e-12, atol=0)
        return bool(is_same and self._spare_px[0] % 2 == self._spare_px[1] % 2 == 0)

    @property
    def _spare_px(self) -> tuple[int, int]:
        """How many more columns and rows are read than the image has."""
        (width_px, height_px), read = self.device.size_px, self.camera
        return read.width_px - width_px, read.height_px - height_px

    @cached_property
    def vignette(self) -> FloatImage:
        """How much light each pixel gets, shape (height, width)."""
        rough = coarser(self.camera, _VIGNETTE_PX)
        return finer(gain_map(rough, self.device.vignetting), self.camera, _VIGNETTE_PX)


@lru_cache(maxsize=16)
def _taken(size_px: int, read_px: int) -> csr_array:
    """Return the weights that take the middle as it is."""
    columns = np.arange(size_px) + (read_px - size_px) // 2
    return csr_array(
        (np.ones(size_px, np.float32), (np.arange(size_px), columns)), shape=(size_px, read_px)
    )


@lru_cache(maxsize=8)
def readout(device: Device, zoom: float, focus: float) -> Readout:
    """Return what is read for an image."""
    binned = _binned(device, zoom)
    whole = sensor_camera(device, focus)
    whole = scaled(whole, whole.width_px // binned, whole.height_px // binned)
    left_px, top_px = (_unread_px(size_px, zoom) for size_px in whole.size_px)
    width_px, height_px = whole.width_px - 2 * left_px, whole.height_px - 2 * top_px
    return Readout(device, zoom, cropped(whole, left_px, top_px, width_px, height_px), binned)


def coarser(camera: Camera, times: int) -> Camera:
    """Return a camera with larger pixels and whole ones of them around the image."""
    columns, rows = (-(-size_px // times) + 2 * EDGE for size_px in camera.size_px)
    edge_px = times * EDGE
    wide = cropped(camera, -edge_px, -edge_px, times * columns, times * rows)
    return scaled(wide, columns, rows)


def finer(image: FloatImage, camera: Camera, times: int) -> FloatImage:
    """Return an image of the coarser camera with the pixels of the camera itself."""
    (rows, columns), edge_px = image.shape, times * EDGE
    across = resampling(columns, times * columns, 1.0, "cubic")
    down = resampling(rows, times * rows, 1.0, "cubic")
    fine = np.asarray((across @ (down @ image).T).T, np.float32)
    return fine[edge_px : edge_px + camera.height_px, edge_px : edge_px + camera.width_px]


def _binned(device: Device, zoom: float) -> int:
    """Return how many sensor pixels along a side fit into a pixel of the image."""
    width_px, height_px = device.sensor.size_px
    most = int(width_px / (zoom * device.size_px[0]) + 1e-9)
    fitting = (b for b in range(most, 1, -1) if width_px % b == 0 and height_px % b == 0)
    return next(fitting, 1)


def _unread_px(size_px: int, zoom: float) -> int:
    """Return how many pixels at either end no pixel of the image needs."""
    return max(int((size_px - size_px / zoom) / 2) - _MARGIN_PX, 0)

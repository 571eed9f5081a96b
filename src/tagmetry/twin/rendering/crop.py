"""What a webcam gives out of its sensor's image: a digital zoom, at a size."""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera, scaled, zoomed
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.twin.optics.digital_zoom import Interpolation, zoomed_pixels


@dataclass(frozen=True)
class DigitalZoom:
    """The middle of the sensor's image, resampled; by default all of it as it is.

    Attributes:
        zoom: 1 or more.
        width_px: Columns that are given out; None for as many as the sensor has.
        height_px: Rows.
        interpolation: How the camera resamples.
    """

    zoom: float = 1.0
    width_px: int | None = None
    height_px: int | None = None
    interpolation: Interpolation = "linear"

    def __post_init__(self) -> None:
        if not (np.isfinite(self.zoom) and self.zoom >= 1):
            raise InputError(f"a digital zoom is at least 1, got {self.zoom}")

    def camera(self, sensor: Camera) -> Camera:
        """Return the intrinsics of the picture that is given out."""
        return scaled(zoomed(sensor, self.zoom), *self._size_px(*sensor.size_px))

    def pixels(self, image: AnyPixels, white_grey: int) -> AnyPixels:
        """Return the picture that is given out, of the type of the sensor's.

        Args:
            image: What the sensor made, shape (height, width).
            white_grey: Its greatest grey value.
        """
        height_px, width_px = image.shape
        if self.zoom == 1 and self._size_px(width_px, height_px) == (width_px, height_px):
            return image
        size_px = self._size_px(width_px, height_px)
        resampled = zoomed_pixels(image, self.zoom, *size_px, self.interpolation)
        return np.asarray(np.clip(np.rint(resampled), 0, white_grey), dtype=image.dtype)

    def _size_px(self, width_px: int, height_px: int) -> tuple[int, int]:
        return self.width_px or width_px, self.height_px or height_px

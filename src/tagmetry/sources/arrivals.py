"""Which of the pixels that a camera delivers are a new image, and its number."""

import numpy as np

from tagmetry.camera import Camera, Image
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.connection import ConnectionLostError

_MOST_CORRUPT = 30  # in a row: about a second
_GLANCE = 16  # every 16th row and column shows a difference nearly always


class Arrivals:
    """Counts new images; drops repeats and what is no image."""

    def __init__(self, source: str, camera: Camera | None) -> None:
        self._source, self._camera = source, camera
        self._last: AnyPixels | None = None
        self._last_new_s = 0.0
        self._corrupt_count = 0
        self._count = 0

    @property
    def count(self) -> int:
        """How many new images there were."""
        return self._count

    def repeated_s(self, time_s: float) -> float:
        """Return for how long nothing new had come at this time."""
        return time_s - self._last_new_s

    def add(self, pixels: AnyPixels, time_s: float) -> Image | None:
        """Return the image, or None for a repeat of the last one and for corrupt pixels.

        Args:
            pixels: What the camera delivered.
            time_s: When.

        Raises:
            ConnectionLostError: Nothing but corrupt pixels for about a second.
        """
        if not _is_image(pixels):
            self._refuse()
            return None
        self._corrupt_count = 0
        if self._last is not None and _is_equal(pixels, self._last):
            return None
        self._last, self._last_new_s = pixels, time_s
        image = Image(pixels, time_s, "arrival", self._count, self._source, self._camera)
        self._count += 1
        return image

    def _refuse(self) -> None:
        self._corrupt_count += 1
        if self._corrupt_count >= _MOST_CORRUPT:
            self._corrupt_count = 0
            raise ConnectionLostError(f"{_MOST_CORRUPT} corrupt images in a row")


def _is_image(pixels: AnyPixels) -> bool:
    is_grey_or_bgr = pixels.ndim == 2 or (pixels.ndim == 3 and pixels.shape[2] == 3)
    return is_grey_or_bgr and pixels.size > 0 and pixels.dtype in (np.uint8, np.uint16)


def _is_equal(a: AnyPixels, b: AnyPixels) -> bool:
    glance = np.s_[::_GLANCE, ::_GLANCE]
    return np.array_equal(a[glance], b[glance]) and np.array_equal(a, b)

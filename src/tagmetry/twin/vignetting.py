"""How much light the corners of an image get.

    gain = (1 - s (1 - cos^4 a)) (1 + g1 q + g2 q^2 + ...)

a is the angle between a pixel's ray and the axis, by the twin's own rays, and s how much of the
cos^4 law shows (lenses for sensors correct some of it). q = ((u - cx) / fx)^2 + ((v - cy) / fy)^2,
so that the same coefficients hold under a digital zoom.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import FloatImage
from tagmetry.twin.render.rays import Rays


@dataclass(frozen=True)
class Vignetting:
    """The fall of light towards the corners; none by default.

    Attributes:
        cos4: Strength s of the cos^4 law, 0 to 1.
        radial: Coefficients g1, g2, ... of q, q^2, ...
    """

    cos4: float = 0.0
    radial: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if not 0 <= self.cos4 <= 1:
            raise InputError(f"the strength of the cos^4 law is 0 to 1, got {self.cos4}")
        if not np.isfinite(self.radial).all():
            raise InputError(f"radial coefficients must be finite, got {self.radial}")


def vignetted(pixels: FloatImage, camera: Camera, vignetting: Vignetting) -> FloatImage:
    """Return an image with its corners darkened; without vignetting, the image itself.

    Args:
        pixels: Light, shape (height, width) of the camera.
        camera: Whose image it is.
        vignetting: How much.
    """
    if vignetting == Vignetting():
        return pixels
    camera.check_image(pixels.shape[1], pixels.shape[0])
    return np.asarray(pixels * gain_map(camera, vignetting))


@lru_cache(maxsize=8)
def gain_map(camera: Camera, vignetting: Vignetting) -> FloatImage:
    """Return the gain of every pixel, shape (height, width), read only, kept for the camera.

    It is 0 where the lens shows nothing, and never less.
    """
    u, v = np.meshgrid(
        np.arange(camera.width_px, dtype=np.float64), np.arange(camera.height_px, dtype=np.float64)
    )
    natural = 1 - vignetting.cos4 * (1 - _cosine(camera, u, v) ** 4)
    gain = natural * _radial(camera, u, v, vignetting.radial)
    shown = np.maximum(np.nan_to_num(gain, nan=0.0), 0.0).astype(np.float32)
    shown.setflags(write=False)
    return shown


def _cosine(camera: Camera, u: Array, v: Array) -> Array:
    """Return the cosine of the pixels' rays with the axis, 0 behind it; NaN where there is none."""
    rays = Rays(camera).look(u, v)
    return np.asarray(np.maximum(rays[..., 2] / np.linalg.norm(rays, axis=-1), 0.0))


def _radial(camera: Camera, u: Array, v: Array, coefficients: tuple[float, ...]) -> Array:
    """Return 1 + g1 q + g2 q^2 + ... of pixels."""
    (fx, fy), (cx, cy) = camera.focal_px, camera.center_px
    q = ((u - cx) / fx) ** 2 + ((v - cy) / fy) ** 2
    return np.asarray(np.polynomial.polynomial.polyval(q, [1.0, *coefficients]), np.float64)

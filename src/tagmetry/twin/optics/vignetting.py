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
from tagmetry.twin.optics.rays import Rays

_NODES_PER_FOCAL = 200


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

    It is 0 where the lens shows nothing, and never less. It is computed at nodes and interpolated,
    to 3e-5 for the cos^4 law.
    """
    us, vs = (
        _nodes(camera.width_px, camera.focal_px[0]),
        _nodes(camera.height_px, camera.focal_px[1]),
    )
    gain = _gain(camera, vignetting, *np.meshgrid(us, vs))
    across, down = _between(us, camera.width_px), _between(vs, camera.height_px)
    done = np.maximum(down @ gain @ across.T, 0.0).astype(np.float32)
    done.setflags(write=False)
    return done


def _nodes(size_px: int, focal_px: float) -> Array:
    """Return places along one axis, close by the angle between them; the pixels, if as close."""
    count = int(np.ceil((size_px - 1) / focal_px * _NODES_PER_FOCAL)) + 1
    return np.linspace(0.0, size_px - 1.0, min(count, size_px))


def _between(nodes: Array, size_px: int) -> Array:
    """Return the weights of linear interpolation from nodes to pixels, shape (size, nodes)."""
    pixels = np.arange(size_px)
    return np.stack([np.interp(pixels, nodes, one) for one in np.eye(len(nodes))], axis=1)


def _gain(camera: Camera, vignetting: Vignetting, u: Array, v: Array) -> Array:
    """Return the gain at pixels, 0 where there is no ray."""
    natural = 1 - vignetting.cos4 * (1 - _cosine(camera, u, v) ** 4)
    gain = natural * _radial(camera, u, v, vignetting.radial)
    return np.asarray(np.nan_to_num(gain, nan=0.0))


def _cosine(camera: Camera, u: Array, v: Array) -> Array:
    """Return the cosine of the pixels' rays with the axis, 0 behind it; NaN where there is none."""
    rays = Rays(camera).look(u, v)
    return np.asarray(np.maximum(rays[..., 2] / np.linalg.norm(rays, axis=-1), 0.0))


def _radial(camera: Camera, u: Array, v: Array, coefficients: tuple[float, ...]) -> Array:
    """Return 1 + g1 q + g2 q^2 + ... of pixels."""
    (fx, fy), (cx, cy) = camera.focal_px, camera.center_px
    q = ((u - cx) / fx) ** 2 + ((v - cy) / fy) ** 2
    return np.asarray(np.polynomial.polynomial.polyval(q, [1.0, *coefficients]), np.float64)

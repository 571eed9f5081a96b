"""Point spread: a Gaussian, a uniform disc of defocus, or both, on a grid finer than the pixels.

Every point of the grid is the mean over its own area, so the mean of `fine` x `fine` spread points
is the mean over the pixel, spread. For an edge seen by one pixel the width that comes out,
squared, is 1/12 px^2 of the pixel plus the kernel's second moment; the kernels are made to have
those of the Gaussian, s^2, and of the disc, R^2 / 4 along each axis.

What the grid loses is where an edge lies within its point: an edge p of the way through is two
steps of weights 1 - p and p, in the right place on average, but wider by (p (1 - p) - 1/6) h^2,
h = 1 / fine, than the mean over all p. This is at most h^2 / 6, and a profile P changes with its
variance by P'' / 2: an error of h^2 P'' / 12 at most, from which `fine_scale` follows.
"""

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import FloatImage
from tagmetry.twin.optics.disc import disc_kernel

_GAUSSIAN_REACH = 4.5  # standard deviations; 7e-6 of the light lies beyond
_CELL_VARIANCE = 1 / 12
_LEAST_DEVIATION = 1e-3  # points of the grid; samples of less are 0 beside the middle
_LARGEST_PX = 500.0


@dataclass(frozen=True)
class Spread:
    """How a point of light spreads over the image; neutral by default.

    Attributes:
        gaussian_px: Standard deviation of a Gaussian.
        disc_px: Radius of a uniform disc.
    """

    gaussian_px: float = 0.0
    disc_px: float = 0.0

    def __post_init__(self) -> None:
        for name, width_px in (("gaussian_px", self.gaussian_px), ("disc_px", self.disc_px)):
            if not 0 <= width_px <= _LARGEST_PX:
                raise InputError(f"{name} must be between 0 and {_LARGEST_PX:g}, got {width_px}")


def spread(image: FloatImage, fine: int, by: Spread) -> FloatImage:
    """Return an image spread on its own grid; the border is taken to go on as it ends.

    Args:
        image: Light, shape (height * fine, width * fine), each point the mean over its area.
        fine: Points of the grid along a pixel's side.
        by: The point spread; without any, the image itself is returned.
    """
    check_grid(image, fine)
    gaussian, disc = by.gaussian_px * fine, _disc_radius(by.disc_px * fine)
    if disc > 0:
        return _filtered(image, _joint_kernel(gaussian, disc))
    if gaussian == 0:
        return image
    kernel = gaussian_kernel(gaussian).astype(np.float32)
    done = cv2.sepFilter2D(image, cv2.CV_32F, kernel, kernel, borderType=cv2.BORDER_REPLICATE)
    return np.asarray(done, np.float32)


def fine_scale(by: Spread, contrast_error: float = 1e-3) -> int:
    """Return how many points along a pixel's side hold an edge's profile to an error.

    Args:
        by: The point spread.
        contrast_error: Greatest error of a pixel on a straight edge along the grid, as a share of
            the edge's contrast. On average over where the edge lies the error is far less.
    """
    if not contrast_error > 0:
        raise InputError(f"contrast_error must be positive, got {contrast_error}")
    if by == Spread():
        return 1
    return max(1, int(np.ceil(np.sqrt(_bend_of_edge(by) / (12 * contrast_error)))))


def pixel_means(image: FloatImage, fine: int) -> FloatImage:
    """Return the pixels of a fine image: means over `fine` x `fine` points each."""
    check_grid(image, fine)
    if fine == 1:
        return image
    size_px = (image.shape[1] // fine, image.shape[0] // fine)
    return np.asarray(cv2.resize(image, size_px, interpolation=cv2.INTER_AREA), np.float32)


def gaussian_kernel(deviation: float) -> Array:
    """Return a sampled Gaussian of this standard deviation, shape (n,), n odd, sum 1.

    Args:
        deviation: In points of the grid. Samples of a narrow Gaussian have less variance than it
            has; what is missing is moved from the middle to its neighbours.
    """
    reach = gaussian_reach(deviation)
    at = np.arange(-reach, reach + 1)
    kernel = np.exp(-((at / max(deviation, _LEAST_DEVIATION)) ** 2) / 2)
    kernel /= kernel.sum()
    if deviation < 1:
        missing = deviation**2 - kernel @ at**2
        kernel[reach - 1 : reach + 2] += missing * np.array([0.5, -1.0, 0.5])
    return np.asarray(kernel)


def gaussian_reach(deviation: float) -> int:
    """Return how many points to either side the sampled Gaussian has."""
    return max(1, int(np.ceil(_GAUSSIAN_REACH * deviation)))


def check_grid(image: FloatImage, fine: int) -> None:
    """Raise InputError unless an image is a grid of `fine` points a pixel."""
    if fine < 1:
        raise InputError(f"fine must be at least 1, got {fine}")
    if image.ndim != 2 or image.size == 0:
        raise InputError(f"expected an image of shape (height, width), got {image.shape}")
    if image.shape[0] % fine or image.shape[1] % fine:
        raise InputError(f"expected {fine} points a pixel, got an image of shape {image.shape}")
    if image.dtype != np.float32:
        raise InputError(f"expected a float32 image, got {image.dtype}")


def _disc_radius(radius: float) -> float:
    """Return the disc that, spread over cells of a grid, has the second moment of one of `radius`.

    Areas of cells widen it by a cell's own variance, (R^2 - r^2) / 4 = 1/12.
    """
    return float(np.sqrt(max(radius**2 - 4 * _CELL_VARIANCE, 0.0)))


@lru_cache(maxsize=64)
def _joint_kernel(gaussian: float, disc: float) -> FloatImage:
    """Return a disc spread by a Gaussian, shape (n, n); kept, as tiles ask for the same again."""
    kernel = disc_kernel(disc)
    if gaussian > 0:
        along = gaussian_kernel(gaussian)
        wide = np.pad(kernel, len(along) // 2)
        kernel = np.asarray(
            cv2.sepFilter2D(wide, cv2.CV_64F, along, along, borderType=cv2.BORDER_CONSTANT), float
        )
    return kernel.astype(np.float32)


def _filtered(image: FloatImage, kernel: FloatImage) -> FloatImage:
    """Return the image under a symmetric kernel; OpenCV turns to Fourier transforms by itself."""
    done = cv2.filter2D(image, cv2.CV_32F, kernel, borderType=cv2.BORDER_REPLICATE)
    return np.asarray(done, np.float32)


def _bend_of_edge(by: Spread) -> float:
    """Return P'', the greatest curvature of a pixel's response to an edge, 1 / px^2; or a bound.

    It is the line spread's greatest change over one pixel. A disc's line spread,
    2 / (pi R) sqrt(1 - (x / R)^2), changes most within a pixel of its rim. A Gaussian and a disc
    together are smoother than either.
    """
    bends = []
    if by.gaussian_px > 0:
        from_middle = np.linspace(0, 6, 601) * by.gaussian_px
        bends.append(float(np.max(_line(from_middle, by) - _line(from_middle + 1, by))))
    if by.disc_px > 0:
        inward = max(1 - 1 / by.disc_px, 0.0)
        bends.append(2 / (np.pi * by.disc_px) * float(np.sqrt(1 - inward**2)))
    return min(bends)


def _line(x_px: Array, by: Spread) -> Array:
    """Return the line spread of the Gaussian, 1 / px."""
    peak = 1 / (np.sqrt(2 * np.pi) * by.gaussian_px)
    return np.asarray(peak * np.exp(-((x_px / by.gaussian_px) ** 2) / 2))

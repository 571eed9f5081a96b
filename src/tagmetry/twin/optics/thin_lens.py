"""A thin lens: how large the disc of a point out of focus is, and how focusing changes the scale.

A lens of focal length f that is focused at distance d has its sensor at v, and a point at depth z
leaves a disc of diameter c there (A is the aperture's diameter):

    1 / v = 1 / f - 1 / d,    c = A v |1 / z - 1 / d|

both also for d or z at infinity. Distances are along the axis from the lens, which is the camera's
centre; v is the focal length of the pinhole camera, so nearer focus magnifies (focus breathing).
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array


@dataclass(frozen=True)
class ThinLens:
    """A lens and the pixels behind it.

    Attributes:
        focal_m: Focal length f, focused at infinity.
        aperture_m: Diameter of the entrance pupil; 0 is a pinhole, everything sharp.
        pixel_m: Pitch of the pixels.
    """

    focal_m: float
    aperture_m: float
    pixel_m: float

    def __post_init__(self) -> None:
        for name, value_m in (("focal_m", self.focal_m), ("pixel_m", self.pixel_m)):
            if not (np.isfinite(value_m) and value_m > 0):
                raise InputError(f"{name} must be positive, in metres, got {value_m}")
        if not (np.isfinite(self.aperture_m) and self.aperture_m >= 0):
            raise InputError(f"aperture_m must be 0 or more, in metres, got {self.aperture_m}")

    @classmethod
    def from_f_number(cls, focal_m: float, f_number: float, pixel_m: float) -> Self:
        """Return the lens whose aperture is focal_m / f_number."""
        if not f_number > 0:
            raise InputError(f"f_number must be positive, got {f_number}")
        return cls(focal_m, focal_m / f_number, pixel_m)

    @property
    def f_number(self) -> float:
        """Focal length by aperture; infinite for a pinhole."""
        return self.focal_m / self.aperture_m if self.aperture_m > 0 else float("inf")

    def image_distance_m(self, focus_m: float) -> float:
        """Return v, from the lens to the sensor, when focused at a distance (may be infinite)."""
        if not focus_m > self.focal_m:
            raise InputError(
                f"a lens of {self.focal_m} m cannot focus at {focus_m} m; expected a distance in "
                "metres beyond its focal length"
            )
        return 1 / (1 / self.focal_m - 1 / focus_m)

    def focal_px(self, focus_m: float) -> float:
        """Return the focal length of the pinhole camera that the lens is at a focus."""
        return self.image_distance_m(focus_m) / self.pixel_m

    def blur_radius_px(self, depth_m: Array | float, focus_m: float) -> Array:
        """Return the radius of the discs (circles of confusion) of points.

        Args:
            depth_m: Depths of the points along the axis, any shape; may be infinite.
            focus_m: Distance in focus; may be infinite.

        Returns:
            Shape of `depth_m`; NaN where a depth is not positive.
        """
        depth_m = np.asarray(depth_m, dtype=np.float64)
        in_front_m = np.where(depth_m > 0, depth_m, np.nan)
        distance_m = self.image_distance_m(focus_m)
        miss = np.abs(1 / in_front_m - 1 / focus_m)
        return np.asarray(self.aperture_m * distance_m * miss / (2 * self.pixel_m))

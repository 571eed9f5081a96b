"""Is a camera's distortion one to one over its whole image?

An over-fitted polynomial folds back inside the image: two rays then share a pixel, and everything
measured out there is wrong. Seeds 001 and 003 print such coefficients.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera.model import Camera


@dataclass(frozen=True)
class DistortionReach:
    """How much of the image the distortion model covers.

    Attributes:
        covered_share: Share of the image's pixels that exactly one ray reaches, 0 to 1.
        fold_angle_rad: Angle from the optical axis at which the radial model folds.
    """

    covered_share: float
    fold_angle_rad: float

    @property
    def is_monotonic(self) -> bool:
        """Whether the whole image is covered."""
        return self.covered_share == 1.0


def distortion_reach(camera: Camera, samples: int = 65) -> DistortionReach:
    """Unproject a grid of pixels, edges included, and count those that have a ray."""
    u = np.linspace(-0.5, camera.width_px - 0.5, samples)
    v = np.linspace(-0.5, camera.height_px - 0.5, samples)
    rays = camera.unproject(np.stack(np.meshgrid(u, v), axis=-1))
    covered = np.isfinite(rays).all(axis=-1).mean()
    return DistortionReach(float(covered), camera.lens.fold_angle_rad)

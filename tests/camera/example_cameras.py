"""Cameras with every kind of lens, and points that they see."""

import numpy as np

from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.geometry.arrays import Array

WIDTH_PX, HEIGHT_PX = 640, 480
ALL_14 = (
    *(0.12, -0.21, 0.0015, -0.0022, 0.07),
    *(0.03, -0.05, 0.02),
    *(0.0011, -0.0007, -0.0009, 0.0004),
    *(0.02, -0.03),
)
LENSES: dict[str, Lens] = {
    **{f"brown{n}": BrownLens(ALL_14[:n]) for n in (0, 4, 5, 8, 12, 14)},
    "fisheye": FisheyeLens((0.04, -0.012, 0.003, -0.0005)),
}


def camera_with(lens: Lens, covariance: Array | None = None) -> Camera:
    return Camera(WIDTH_PX, HEIGHT_PX, (612.3, 598.7), (301.4, 251.9), lens, covariance)


CAMERAS = {name: camera_with(lens) for name, lens in LENSES.items()}


def points_ahead(count: int = 60, seed: int = 0) -> Array:
    """Return points in the camera frame that all of these lenses show, metres."""
    rng = np.random.default_rng(seed)
    depth = rng.uniform(0.3, 4.0, (count, 1))
    return np.hstack([rng.uniform(-0.6, 0.6, (count, 2)) * depth, depth])

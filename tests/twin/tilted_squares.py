"""Squares a metre away, tilted and turned, and lenses of every kind that see them."""

import numpy as np
from lens_formulas import project_px

from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation

LENSES: dict[str, Lens] = {
    "none": BrownLens(),
    "5": BrownLens((-0.3, 0.1, 0.001, 0.002, -0.01)),
    "8": BrownLens((0.1, -0.02, 0.001, 0.002, 0.01, 0.02, -0.01, 0.003)),
    "14": BrownLens((-0.1, 0.02, *[0.001] * 10, 0.03, -0.02)),
    "fisheye": FisheyeLens((0.05, -0.02, 0.004, -0.001)),
}


def camera(lens: Lens, focal_px: float = 600.0) -> Camera:
    return Camera(560, 440, (focal_px, 1.01 * focal_px), (282.3, 217.6), lens)


def tilted(tilt_deg: float, shift_px: float, focal_px: float = 600.0) -> RigidTransform:
    """A metre away, tilted about a turned axis, and turned in its own plane."""
    turn = Rotation.from_euler("XZX", [180, 17, tilt_deg], degrees=True)
    turn *= Rotation.from_euler("z", 11, degrees=True)
    place_m = np.array([6 + shift_px, 4 - 0.7 * shift_px, focal_px]) / focal_px
    return RigidTransform.from_components(place_m, turn)


def sides_px(corners_m: Array, T_camera_sheet: RigidTransform, seer: Camera) -> list[Array]:
    """Points along the sides of a sheet, by the formulas."""
    share = np.linspace(0, 1, 201)[:, None]
    pairs = zip(corners_m, np.roll(corners_m, -1, axis=0), strict=True)
    return [project_px(T_camera_sheet.apply(a + share * (b - a)), seer) for a, b in pairs]


def degree_of(lens: Lens, size_px: float) -> int:
    """Of a polynomial that is a side to 1e-5 px."""
    return 1 if not any(lens.coefficients) else 2 if size_px < 50 else 4

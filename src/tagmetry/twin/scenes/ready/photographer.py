"""The cameras of the ready-made scenes, as laboratories have them."""

import numpy as np

from tagmetry.camera import BrownLens, Camera
from tagmetry.twin.optics.response import Linear, Srgb
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.vignetting import Vignetting
from tagmetry.twin.rendering.shot import Optics, Shot, Shutter
from tagmetry.twin.scenes.path import Path


def webcam(
    path: Path, *, brightness: float = 0.8, exposure_s: float = 0.002, srgb: bool = True
) -> Shot:
    """Return a webcam of 1280x720 pixels: 65 degrees, some distortion, the curve of sRGB or none.

    Args:
        path: Where it is.
        brightness: Exposure of the radiance 1.
        exposure_s: For how long it takes light in.
        srgb: Whether its grey values are made for a display; else they are linear in the light.
    """
    return Shot(
        Camera(1280, 720, (1005.0, 1003.0), (643.2, 355.8), BrownLens((-0.12, 0.04, 0.0, 0.0))),
        path,
        optics=Optics(0.9, vignetting=Vignetting(0.7), veil=0.01),
        shutter=Shutter(exposure_s),
        sensor=Sensor(full_well_e=9_000, read_noise_e=9, response=Srgb() if srgb else Linear()),
        brightness=brightness,
    )


def machine_camera(path: Path, field_of_view_deg: float, *, brightness: float = 1.3) -> Shot:
    """Return an industrial camera of 1920x1080 pixels, linear, with a good lens.

    Args:
        path: Where it is.
        field_of_view_deg: Across.
        brightness: Exposure of the radiance 1.
    """
    focal_px = float(960 / np.tan(np.radians(field_of_view_deg) / 2))
    lens = BrownLens((-0.18, 0.07, 0.0003, -0.0002))
    return Shot(
        Camera(1920, 1080, (focal_px, focal_px), (955.4, 543.1), lens),
        path,
        optics=Optics(0.9, vignetting=Vignetting(0.8), veil=0.005),
        shutter=Shutter(0.002),
        sensor=Sensor(full_well_e=10_500, read_noise_e=7, black_level=0.01),
        brightness=brightness,
    )

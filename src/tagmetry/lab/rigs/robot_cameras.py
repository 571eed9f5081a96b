"""The two cameras of seed 004, a lens of which zooms, and how they expose.

The paper names a laptop's webcam of 1 MP and a camera of high dynamic range of 0.44 MP (IDS
UI-5120SE, 768x576) with a zoom lens, and tells no angle of view: 60 degrees across are taken for
the webcam, 45 for the normal setting and 80 for the wide one. All are calibrated without an error.
The webcam exposes by itself until its mean grey value is 45 %. The other is set to the light in the
room, and its response bends twice, so that 128 times as much light still differs.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import AnyPixels, FloatImage
from tagmetry.twin import Optics, Scene, Shot, exposed
from tagmetry.twin.optics.response import Curve, Srgb
from tagmetry.twin.optics.sensor import Sensor, developed
from tagmetry.twin.scenes import Still

CameraName = Literal["webcam", "HDR, normal", "HDR, wide"]

_VEIL = 0.005  # share of all light that the lens scatters over the picture
_WANTED_CODE = 0.45
_DARKEST, _BRIGHTEST = 1e-5, 10.0


@dataclass(frozen=True)
class RobotCamera:
    """A camera as the laboratory simulates it.

    Attributes:
        camera: Its intrinsics.
        optics: Its lens.
        sensor: Its sensor.
        brightness: Exposure of the radiance 1, as a share of full scale; None: exposes by itself.
    """

    camera: Camera
    optics: Optics
    sensor: Sensor
    brightness: float | None = None


def _seeing(width_px: int, height_px: int, across_deg: float) -> Camera:
    focal_px = width_px / 2 / float(np.tan(np.radians(across_deg) / 2))
    center_px = ((width_px - 1) / 2, (height_px - 1) / 2)
    return Camera(width_px, height_px, (focal_px, focal_px), center_px)


_OPTICS = Optics(blur_px=0.8, veil=_VEIL)
_WEBCAM = Sensor(full_well_e=6000.0, read_noise_e=8.0, response=Srgb(), jpeg_quality=90)
_BENT_TWICE = Curve((0.0, 0.5, 4.0, 64.0), (0.0, 0.6, 0.8, 1.0))
_HDR = Sensor(full_well_e=20000.0, read_noise_e=20.0, response=_BENT_TWICE)
CAMERAS: dict[CameraName, RobotCamera] = {
    "webcam": RobotCamera(_seeing(1280, 800, 60.0), _OPTICS, _WEBCAM),
    "HDR, normal": RobotCamera(_seeing(768, 576, 45.0), _OPTICS, _HDR, 0.5),
    "HDR, wide": RobotCamera(_seeing(768, 576, 80.0), _OPTICS, _HDR, 0.5),
}


def robot_picture(
    name: CameraName, scene: Scene, T_world_camera: RigidTransform, rng: np.random.Generator
) -> AnyPixels:
    """Return what a camera sees."""
    one = CAMERAS[name]
    light = exposed(scene, Shot(one.camera, Still(T_world_camera), optics=one.optics))
    brightness = one.brightness or _by_itself(light, one.sensor)
    return developed(light * np.float32(brightness), one.sensor, rng)


def _by_itself(light: FloatImage, sensor: Sensor) -> float:
    """Return the exposure at which the mean code is the wanted one, by halving on a log scale."""
    few = light[::8, ::8]
    low, high = np.log(_DARKEST), np.log(_BRIGHTEST)
    for _ in range(30):
        middle = (low + high) / 2
        if float(sensor.response.code(few * np.exp(middle)).mean()) > _WANTED_CODE:
            high = middle
        else:
            low = middle
    return float(np.exp((low + high) / 2))

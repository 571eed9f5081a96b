"""A simulated camera without noise, and how its pictures are measured."""

import numpy as np

from tagmetry.camera import Camera, Control
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin.camera import (
    Device,
    DioptreFocus,
    TwinCamera,
)
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.scenes import Scene, Still, Thing, surface

FACING = Rotation.from_euler("x", 180, degrees=True)
EMPTY = Scene((), background=0.5)
F_M, PIXEL_M, APERTURE_M = 4e-3, 2e-6, 2e-3
MANUAL = (
    Control("zoom", 100.0, 500.0, 1.0, 100.0, "percent"),
    Control("focus", 0.0, 20.0, 0.0, 2.0),
    Control("exposure", 1e-3, 10e-3, 1e-3, 5e-3, "s"),
    Control("gain", 1.0, 8.0, 0.0, 1.0, "factor"),
)
AUTO = (Control("auto_focus", 0.0, 1.0, 1.0, 0.0), Control("auto_exposure", 0.0, 1.0, 1.0, 0.0))
PLAIN = Device(  # 16 bits without noise, 320 x 180 out of 640 x 360, focus in dioptres
    "plain",
    Camera(640, 360, (2000.0, 2000.0), (311.7, 186.2)),
    (320, 180),
    50.0,
    ThinLens(F_M, APERTURE_M, PIXEL_M),
    DioptreFocus(1.0),
    pixels=Sensor(bits=16),
    output=Sensor(bits=16),
    blur_px=0.0,
    controls=MANUAL + AUTO,
)


def square(z_m: float, side_m: float, x_m: float = 0.0, y_m: float = 0.0) -> Thing:
    at = Still(RigidTransform.from_components([x_m, y_m, z_m], FACING))
    return surface("square", side_m, side_m, at, brightness=0.9)


def white_square(z_m: float, side_m: float, x_m: float = 0.0, y_m: float = 0.0) -> Scene:
    return Scene((square(z_m, side_m, x_m, y_m),), background=0.1)


def camera(scene: Scene = EMPTY, device: Device = PLAIN, **others: object) -> TwinCamera:
    return TwinCamera(scene, device, **others)


def picture(twin: TwinCamera) -> np.ndarray:
    """The next image's light, 0 to 1."""
    return twin.take().pixels / twin._device.output.white_grey


def step_edges_px(light: np.ndarray) -> tuple[float, float]:
    """Where a bright square of the middle row begins and ends, by the area of its profile."""
    row = light[light.shape[0] // 2 - 5 : light.shape[0] // 2 + 5].mean(axis=0)
    middle = int(np.average(np.arange(len(row)), weights=row - row.min()))
    share = (row - row[0]) / (row[middle] - row[0])
    return middle - 0.5 - share[:middle].sum(), middle - 0.5 + share[middle:].sum()

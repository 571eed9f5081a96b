"""What it takes to photograph a scene: a camera at a place, its optics, its shutter."""

from dataclasses import dataclass, field

import numpy as np

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.optics.vignetting import Vignetting
from tagmetry.twin.rendering.crop import DigitalZoom
from tagmetry.twin.rendering.view import View
from tagmetry.twin.scenes.path import Path


@dataclass(frozen=True)
class Optics:
    """How the lens forms the image; by default perfectly.

    Attributes:
        blur_px: Standard deviation of a Gaussian point spread, besides the pixel's own area.
        lens: Blurs what is out of focus; None for a pinhole.
        focus_m: Depth at which the lens is sharp.
        vignetting: How the image darkens toward its corners.
        veil: Share of the image's mean light that is scattered evenly over it.
        later_px: Standard deviation of what the light will be blurred by when it is done: motion
            need not be followed in finer steps than that hides.
    """

    blur_px: float = 0.0
    lens: ThinLens | None = None
    focus_m: float = np.inf
    vignetting: Vignetting = field(default_factory=Vignetting)
    veil: float = 0.0
    later_px: float = 0.0

    def __post_init__(self) -> None:
        if not 0 <= self.veil < 1:
            raise InputError(f"veil must be at least 0 and below 1, got {self.veil}")
        if not self.focus_m > 0:
            raise InputError(f"focus_m must be positive, got {self.focus_m}")


@dataclass(frozen=True)
class Shutter:
    """When light is taken in; by default at one moment.

    Attributes:
        exposure_s: For how long every row takes light in.
        line_s: Time from one row to the next of a rolling shutter.
    """

    exposure_s: float = 0.0
    line_s: float = 0.0

    def __post_init__(self) -> None:
        for name, time_s in (("exposure_s", self.exposure_s), ("line_s", self.line_s)):
            if not 0 <= time_s < np.inf:
                raise InputError(f"{name} must not be negative, got {time_s}")


@dataclass(frozen=True, eq=False)
class Shot:
    """A camera about to take a picture.

    Attributes:
        camera: Intrinsics of the sensor's image.
        path: Where the camera is, T_world_camera.
        time_s: Middle of the exposure of the middle row.
        optics: How the image is formed.
        shutter: When light is taken in.
        sensor: How light becomes numbers.
        zoom: What is given out of the sensor's image.
        brightness: Exposure of the radiance 1, as a share of the sensor's full scale.
        sampling: How many times finer the picture is computed than its blur needs.
    """

    camera: Camera
    path: Path
    time_s: float = 0.0
    optics: Optics = field(default_factory=Optics)
    shutter: Shutter = field(default_factory=Shutter)
    sensor: Sensor = field(default_factory=Sensor)
    zoom: DigitalZoom = field(default_factory=DigitalZoom)
    brightness: float = 1.0
    sampling: int = 1

    @property
    def picture_camera(self) -> Camera:
        """Intrinsics of the picture, which a digital zoom makes others than the sensor's."""
        return self.zoom.camera(self.camera)

    def view(self, late_s: float = 0.0) -> View:
        """Return what is seen some time after the middle of the exposure."""
        return View(self.camera, self.path, self.time_s + late_s, self.shutter.line_s)

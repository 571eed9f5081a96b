"""The hardware of a simulated camera.

    light on a pixel = sensitivity exposure radiance, as a share of the full well
    signal           = gain (light, as counted in electrons)
    image            = code(zoom(signal))

so that twice the exposure is twice the light with its own noise, while twice the gain is twice the
noise.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from tagmetry.camera import Camera
from tagmetry.camera.controls import RULED_BY, Control
from tagmetry.errors import InputError
from tagmetry.twin.camera.focus_law import FixedFocus, FocusLaw
from tagmetry.twin.camera.setting import Setting
from tagmetry.twin.optics.digital_zoom import Interpolation
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.optics.vignetting import Vignetting

SETTABLE = {"zoom": "zoom_percent", "focus": "focus", "exposure": "exposure_s", "gain": "gain"}
"""Controls of a simulated camera, and the fields of `Setting` that they set."""


@dataclass(frozen=True)
class Breathing:
    """What focusing nearer does to the picture.

    Attributes:
        focal_share: How much of the thin lens's magnification, v / f - 1, shows: 1 for a lens that
            moves as a whole, 0 for one that does not breathe.
        distortion_m: What is added to the distortion coefficients at a focus of 1 m; goes with
            1 / distance.
    """

    focal_share: float = 1.0
    distortion_m: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False)
class Device:
    """A camera's hardware.

    Attributes:
        name: What it is called.
        sensor: Intrinsics of the whole sensor's image, focused at infinity.
        size_px: (width, height) of the images that it gives, of the sensor's shape.
        images_per_s: Its image rate.
        lens: Blurs what is out of focus; its pixels are the sensor's.
        focus_law: From focus value to distance.
        breathing: How focus changes the intrinsics.
        sensitivity_per_s: Exposure of the radiance 1 in one second, as a share of the full well.
        pixels: Noise and bits of the sensor's own pixels.
        output: Response, bits and JPEG of the images that it gives; 8 bits.
        blur_px: Standard deviation of what is softened besides defocus, sensor pixels: how far a
            pixel's light reaches its neighbours.
        vignetting: How the corners darken.
        line_s: Time from one row of the sensor to the next; 0 is a global shutter.
        latency_s: From the end of an exposure until the image arrives.
        interpolation: Of the digital zoom.
        preset: What it is set to where there is no control.
        controls: What can be set: zoom, focus, exposure, gain, auto_focus, auto_exposure.
        delay_images: Control to how many images a change comes late.
        speed_per_s: Control to how fast its value moves; without, at once.
    """

    name: str
    sensor: Camera
    size_px: tuple[int, int]
    images_per_s: float
    lens: ThinLens
    focus_law: FocusLaw = field(default_factory=lambda: FixedFocus(np.inf))
    breathing: Breathing = field(default_factory=Breathing)
    sensitivity_per_s: float = 100.0
    pixels: Sensor = field(default_factory=lambda: Sensor(bits=12))
    output: Sensor = field(default_factory=Sensor)
    blur_px: float = 0.5
    vignetting: Vignetting = field(default_factory=Vignetting)
    line_s: float = 0.0
    latency_s: float = 0.0
    interpolation: Interpolation = "linear"
    preset: Setting = field(default_factory=Setting)
    controls: tuple[Control, ...] = ()
    delay_images: Mapping[str, int] = field(default_factory=dict)
    speed_per_s: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._check_size()
        self._check_times()
        self._check_controls()

    @property
    def period_s(self) -> float:
        """Time from one image to the next."""
        return 1 / self.images_per_s

    @property
    def available(self) -> dict[str, Control]:
        """Its controls by name."""
        return {control.name: control for control in self.controls}

    def _check_size(self) -> None:
        width_px, height_px = self.size_px
        if width_px < 1 or height_px * self.sensor.width_px != width_px * self.sensor.height_px:
            raise InputError(
                f"images must have the shape of the sensor, {self.sensor.width_px}x"
                f"{self.sensor.height_px}, got {width_px}x{height_px}"
            )

    def _check_times(self) -> None:
        rates = (self.images_per_s, self.sensitivity_per_s)
        if not (np.isfinite(rates).all() and min(rates) > 0):
            raise InputError(f"images_per_s and sensitivity_per_s must be positive, got {rates}")
        if not 0 <= self.latency_s < np.inf:
            raise InputError(f"latency_s must not be negative, got {self.latency_s}")
        exposure = self.available.get("exposure")
        longest_s = exposure.most if exposure else self.preset.exposure_s
        if longest_s > self.period_s * (1 + 1e-9):
            raise InputError(
                f"an exposure of {longest_s:g} s does not fit into {self.images_per_s:g} images "
                "per second"
            )

    def _check_controls(self) -> None:
        known = {*SETTABLE, *RULED_BY.values()}
        named = {*self.available, *self.delay_images, *self.speed_per_s}
        if unknown := named - known:
            raise InputError(f"unknown controls {sorted(unknown)}; expected {sorted(known)}")
        if any(delay < 0 for delay in self.delay_images.values()):
            raise InputError(f"delays must not be negative, got {dict(self.delay_images)}")
        if any(not speed > 0 for speed in self.speed_per_s.values()):
            raise InputError(f"speeds must be positive, got {dict(self.speed_per_s)}")

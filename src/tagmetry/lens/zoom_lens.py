"""What must be known of a camera to drive its zoom and focus."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from tagmetry.camera import Camera, CameraBank, Gap
from tagmetry.camera.controls import Control
from tagmetry.errors import InputError
from tagmetry.lens.focus_law import FocusLaw
from tagmetry.lens.setting import LensSetting

_STEP_OF_BANK = 5.0  # seed 000: a calibration at every 5 units of focus


@dataclass(frozen=True, eq=False)
class ZoomLens:
    """A camera with digital zoom and a focus motor.

    Attributes:
        zoom: Its control, percent.
        focus: Its control, the device's own unit.
        law: Which depth is sharp at which focus value.
        bank: Calibrations at some focus values, at zoom 100 percent.
        aperture_m: Diameter of the entrance pupil, which blurs what is not in focus.
        nearest_m: Depth from which on markers are looked for.
        farthest_m: Depth up to which they are.
        native_percent: The zoom at which a pixel of the image is one of the sensor; beyond it
            pictures grow but tell no more. 100 where nothing is known.
    """

    zoom: Control
    focus: Control
    law: FocusLaw
    bank: CameraBank
    aperture_m: float
    nearest_m: float
    farthest_m: float
    native_percent: float = 100.0

    def __post_init__(self) -> None:
        if not (np.isfinite(self.aperture_m) and self.aperture_m > 0):
            raise InputError(f"aperture_m must be positive, in metres, got {self.aperture_m}")
        if not 0 < self.nearest_m < self.farthest_m < np.inf:
            raise InputError(
                f"expected depths with 0 < nearest < farthest, got {self.nearest_m} and "
                f"{self.farthest_m} m"
            )
        if not self.native_percent >= 100:
            raise InputError(f"native_percent is 100 or more, got {self.native_percent}")

    def camera_at(self, setting: LensSetting) -> Camera:
        """Return the intrinsics at a setting, interpolated in the bank; remembered.

        Where the focus lies beyond the calibrations, those of the last one are given: `gaps` and
        `reach` tell.
        """
        return self._remembered(round(setting.magnification, 6), round(setting.focus, 3))

    def sharp_at(self, depth_m: float, zoom_percent: float) -> LensSetting:
        """Return the setting that is sharp at a depth, as near as the controls take it."""
        inside_m = float(np.clip(depth_m, self.nearest_m, self.farthest_m))
        return LensSetting(
            self.zoom.nearest(zoom_percent), self.focus.nearest(self.law.value(inside_m))
        )

    def softly_at(self, depth_m: float, zoom_percent: float, soft_px: float) -> LensSetting:
        """Return the setting that is focused a little before a depth.

        Args:
            depth_m: Where the marker is.
            zoom_percent: The zoom.
            soft_px: Standard deviation of the blur at the depth, pixels of the sensor.
        """
        inside_m = float(np.clip(depth_m, self.nearest_m, self.farthest_m))
        resolved = min(zoom_percent, self.native_percent) / 100
        nearer = 4 * soft_px / (self.focal_px(resolved) * self.aperture_m)
        focused_m = 1 / (1 / inside_m + nearer)
        return LensSetting(
            self.zoom.nearest(zoom_percent), self.focus.nearest(self.law.value(focused_m))
        )

    def blur_of_depth_px(self, setting: LensSetting, depth_m: float) -> float:
        """Return the diameter of the disc that a point at a depth is spread over, pixels."""
        off = abs(1 / depth_m - 1 / self.law.depth_m(setting.focus))
        return self.focal_px(setting.magnification) * self.aperture_m * off

    def focal_px(self, magnification: float = 1.0) -> float:
        """Return about how long the focal length is at a zoom."""
        return magnification * float(np.mean(self.bank.nodes[0].camera.focal_px))

    @property
    def size_px(self) -> tuple[int, int]:
        """(width, height) of the images."""
        return self.bank.sizes_px[0]

    @property
    def reach(self) -> tuple[float, float]:
        """The least and greatest focus value that is calibrated."""
        values = [node.focus for node in self.bank.nodes]
        return min(values), max(values)

    @property
    def gaps(self) -> tuple[Gap, ...]:
        """Where calibrations are missing: neighbours in focus farther apart than the paper's."""
        return self.bank.gaps(_STEP_OF_BANK)

    @cached_property
    def _remembered(self) -> Callable[[float, float], Camera]:
        width_px, height_px = self.size_px
        low, high = self.reach

        @lru_cache(maxsize=4096)
        def camera(magnification: float, focus: float) -> Camera:
            return self.bank.camera_at(
                focus=float(np.clip(focus, low, high)),
                zoom=magnification,
                width_px=width_px,
                height_px=height_px,
            )

        return camera

"""What a camera is set to while it takes one image."""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError


@dataclass(frozen=True)
class Setting:
    """What is in effect for one image.

    Attributes:
        zoom_percent: 100 or more.
        focus: Where the focus motor is, in the device's own unit.
        exposure_s: For how long light is taken in.
        gain: Factor on the signal.
    """

    zoom_percent: float = 100.0
    focus: float = 0.0
    exposure_s: float = 0.01
    gain: float = 1.0

    def __post_init__(self) -> None:
        if not (np.isfinite(self.zoom_percent) and self.zoom_percent >= 100):
            raise InputError(f"a digital zoom is 100 percent or more, got {self.zoom_percent}")
        if not np.isfinite(self.focus):
            raise InputError(f"focus must be finite, got {self.focus}")
        for name, value in (("exposure_s", self.exposure_s), ("gain", self.gain)):
            if not (np.isfinite(value) and value > 0):
                raise InputError(f"{name} must be positive, got {value}")

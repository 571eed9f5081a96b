"""What a camera's zoom and focus are set to."""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError


@dataclass(frozen=True)
class LensSetting:
    """Zoom and focus.

    Attributes:
        zoom_percent: 100 shows everything.
        focus: In the device's own unit.
    """

    zoom_percent: float
    focus: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.zoom_percent) and self.zoom_percent > 0):
            raise InputError(f"zoom_percent must be positive, got {self.zoom_percent}")
        if not np.isfinite(self.focus):
            raise InputError(f"focus must be finite, got {self.focus}")

    @property
    def magnification(self) -> float:
        """The factor n by which the picture is enlarged: seed 000, equation 2."""
        return self.zoom_percent / 100

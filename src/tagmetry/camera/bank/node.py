"""One calibration of a bank."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from tagmetry.camera.model import Camera
from tagmetry.errors import InputError

Approach = Literal["from near", "from far"]


@dataclass(frozen=True, eq=False)
class BankNode:
    """A camera at one resolution, zoom and focus.

    Attributes:
        camera: Its `focus` must be known.
        approach: From which side the focus was driven there, where that is known: a drive with
            play stops at two places.
    """

    camera: Camera
    approach: Approach | None = None

    def __post_init__(self) -> None:
        focus, covariance = self.camera.focus, self.camera.covariance
        if focus is None or not np.isfinite(focus):
            raise InputError(
                f"a calibration in a bank needs the focus that it was made at, found {focus}"
            )
        if covariance is not None and not np.isfinite(covariance).all():
            raise InputError(f"focus {focus:g}: the covariance must be finite")
        if self.approach not in (None, *get_args(Approach)):
            raise InputError(
                f"approach must be 'from near', 'from far' or None, got {self.approach!r}"
            )

    @property
    def focus(self) -> float:
        """Focus setting, in the camera's own unit."""
        return float(self.camera.focus or 0.0)

    @property
    def zoom(self) -> float:
        """Zoom setting."""
        return self.camera.zoom

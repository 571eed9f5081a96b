"""Controls of a camera through OpenCV, where there is no Video4Linux: Windows and macOS.

OpenCV does not tell ranges; those here are wide, and what a camera does not take it refuses. A
control counts as there when the camera takes the value that it reports. Exposures are powers of two
of a second, as the systems' own interfaces have them.
"""

from collections.abc import Mapping
from typing import Protocol

import numpy as np

from tagmetry.camera import Control, ControlRefusedError
from tagmetry.camera.controls import control_named


class Properties(Protocol):
    """What can be asked of and set on an open `cv2.VideoCapture`."""

    def get(self, prop: int) -> float:
        """Return a property, 0 or less where it is unknown."""

    def set(self, prop: int, value: float) -> bool:
        """Set a property and say whether it was taken."""


_WIDE = (
    Control("zoom", 0.0, 1000.0, 1.0, 100.0),
    Control("focus", 0.0, 1023.0, 1.0, 0.0),
    Control("exposure", 2.0**-14, 2.0, 0.0, 2.0**-6, "s"),
    Control("gain", 0.0, 1023.0, 1.0, 0.0),
    Control("auto_focus", 0.0, 1.0, 1.0, 1.0),
    Control("auto_exposure", 0.0, 1.0, 1.0, 1.0),
)


class OpenCvControls:
    """What can be set on an open camera; `tagmetry.camera.Controls`."""

    def __init__(self, properties: Properties) -> None:
        """Ask the camera what it takes.

        Args:
            properties: Of the open camera.
        """
        self._properties, self._numbers = properties, _numbers()
        self._available = {one.name: one for one in _WIDE if self._is_there(one.name)}

    @property
    def available(self) -> Mapping[str, Control]:
        """The camera's controls by name."""
        return self._available

    def read(self, name: str) -> float:
        """Return what the camera says a control is at."""
        control_named(self._available, name)
        value = float(self._properties.get(self._numbers[name]))
        return 2.0**value if name == "exposure" else value

    def write(self, name: str, value: float) -> float:
        """Set a control and return the value that was sent.

        Raises:
            InputError: The camera has no such control, or the value is out of its range.
            ControlRefusedError: The camera does not take the value.
        """
        sent = control_named(self._available, name).checked(value)
        own = float(np.round(np.log2(sent))) if name == "exposure" else sent
        if not self._properties.set(self._numbers[name], own):
            raise ControlRefusedError(f"{name}: the camera does not take {sent:g}")
        return 2.0**own if name == "exposure" else own

    def _is_there(self, name: str) -> bool:
        number = self._numbers[name]
        now = self._properties.get(number)
        return bool(np.isfinite(now) and now != -1 and self._properties.set(number, now))


def _numbers() -> Mapping[str, int]:
    import cv2

    return {
        "zoom": cv2.CAP_PROP_ZOOM,
        "focus": cv2.CAP_PROP_FOCUS,
        "exposure": cv2.CAP_PROP_EXPOSURE,
        "gain": cv2.CAP_PROP_GAIN,
        "auto_focus": cv2.CAP_PROP_AUTOFOCUS,
        "auto_exposure": cv2.CAP_PROP_AUTO_EXPOSURE,
    }

"""Controls of a camera under Linux, through Video4Linux: most of all USB cameras (UVC).

Exposure times are whole multiples of 0.1 ms. Zoom is in percent where its least value is 100, as in
many webcams; otherwise, and for focus and gain, units are the device's own.
"""

import os
from collections.abc import Mapping
from typing import Self

from tagmetry.camera import Control, ControlRefusedError
from tagmetry.camera.controls import RULED_BY, control_named
from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.sources.controls import v4l2
from tagmetry.sources.controls.v4l2 import Ioctl, Queried

_EXPOSURE_S = 1e-4  # a unit of V4L2_CID_EXPOSURE_ABSOLUTE
_WHOLE_ZOOM = 100
_MANUAL, _AUTOMATIC = 1, (3, 0)  # of V4L2_CID_EXPOSURE_AUTO: aperture priority, everything
_IDS: Mapping[str, int] = {
    "zoom": v4l2.ZOOM_ABSOLUTE,
    "focus": v4l2.FOCUS_ABSOLUTE,
    "exposure": v4l2.EXPOSURE_ABSOLUTE,
    "gain": v4l2.GAIN,
    "auto_focus": v4l2.FOCUS_AUTO,
}


class V4l2Controls(Closing):
    """What can be set on a video device; `tagmetry.camera.Controls`.

    It may be open while another part of the program, or another program, takes the images.
    """

    def __init__(self, file: int, ioctl: Ioctl, name: str = "the camera") -> None:
        """Ask an open device what it has.

        Args:
            file: Its file descriptor, which `close` closes.
            ioctl: `fcntl.ioctl`, or what behaves like it.
            name: Path, for people.
        """
        self.name = name
        self._file, self._ioctl = file, ioctl
        queried = {name: v4l2.query(ioctl, file, number) for name, number in _IDS.items()}
        self._available = {n: _control(n, q) for n, q in queried.items() if q and q.is_usable}
        self._automatic = self._automatic_exposure()
        if self._automatic is not None:
            self._available["auto_exposure"] = Control("auto_exposure", 0.0, 1.0, 1.0, 1.0)

    @classmethod
    def open(cls, path: str) -> Self:
        """Open a device, such as /dev/video0.

        Raises:
            InputError: It is not there, may not be opened, or is no video device.
        """
        fcntl = _fcntl(path)
        try:
            file = os.open(path, os.O_RDWR | os.O_NONBLOCK | os.O_CLOEXEC)
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}; is the camera plugged in?") from error
        try:
            v4l2.card(fcntl, file)
        except OSError as error:
            os.close(file)
            raise InputError(f"{path} is no video device with controls") from error
        return cls(file, fcntl, path)

    @property
    def available(self) -> Mapping[str, Control]:
        """The camera's controls by name."""
        return self._available

    def read(self, name: str) -> float:
        """Return what the camera says a control is at."""
        control_named(self._available, name)
        try:
            value = v4l2.get(self._ioctl, self._file, _id(name))
        except OSError as error:
            raise ControlRefusedError(f"{name}: {self.name} does not tell: {error}") from error
        return float(value != _MANUAL) if name == "auto_exposure" else value * _unit(name)

    def write(self, name: str, value: float) -> float:
        """Set a control and return the value that was sent: the nearest whole step.

        Raises:
            InputError: The camera has no such control, or the value is out of its range.
            ControlRefusedError: The camera does not take the value.
        """
        sent = control_named(self._available, name).checked(value)
        auto = RULED_BY.get(name, "")
        try:
            v4l2.put(self._ioctl, self._file, _id(name), self._raw(name, sent))
        except OSError as error:
            is_ruled = auto in self._available and self.read(auto) > 0
            hint = f"; {auto} is on: write {auto} 0 first" if is_ruled else ""
            raise ControlRefusedError(
                f"{name}: {self.name} does not take {sent:g}: {error.strerror}{hint}"
            ) from error
        return sent

    def close(self) -> None:
        """Let go of the device; may be called twice."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1

    def _raw(self, name: str, value: float) -> int:
        """Return a value in the driver's own numbers."""
        if name == "auto_exposure":
            return _MANUAL if value == 0 or self._automatic is None else self._automatic
        return round(value / _unit(name))

    def _automatic_exposure(self) -> int | None:
        """Return the automatic mode to go back to: the one that is on, else the usual one.

        None where the device has no automatic mode, or no manual one to leave it for.
        """
        control = v4l2.EXPOSURE_AUTO
        queried = v4l2.query(self._ioctl, self._file, control)
        if queried is None or not queried.is_usable or not self._has_mode(_MANUAL):
            return None
        try:
            now = v4l2.get(self._ioctl, self._file, control)
        except OSError:
            return None
        return now if now != _MANUAL else next(filter(self._has_mode, _AUTOMATIC), None)

    def _has_mode(self, mode: int) -> bool:
        return v4l2.has_item(self._ioctl, self._file, v4l2.EXPOSURE_AUTO, mode)


def _control(name: str, queried: Queried) -> Control:
    unit = _unit(name)
    least, most = queried.minimum * unit, max(queried.minimum, queried.maximum) * unit
    default = min(max(queried.default * unit, least), most)  # some drivers tell one out of range
    return Control(name, least, most, max(queried.step, 1) * unit, default, _words(name, queried))


def _words(name: str, queried: Queried) -> str:
    """Return the unit for people."""
    if name == "exposure":
        return "s"
    return "percent" if name == "zoom" and queried.minimum == _WHOLE_ZOOM else ""


def _unit(name: str) -> float:
    """Return what one of the driver's numbers is worth."""
    return _EXPOSURE_S if name == "exposure" else 1.0


def _id(name: str) -> int:
    return v4l2.EXPOSURE_AUTO if name == "auto_exposure" else _IDS[name]


def _fcntl(path: str) -> Ioctl:
    """Return the system call."""
    try:
        from fcntl import ioctl
    except ImportError as error:
        raise InputError(f"{path}: Video4Linux is there on Linux only") from error
    return lambda file, request, buffer: ioctl(file, request, buffer, True)

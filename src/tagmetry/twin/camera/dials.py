"""The controls of a simulated camera."""

from collections.abc import Callable, Mapping

import numpy as np

from tagmetry.camera.controls import RULED_BY, Control, ControlRefusedError, control_named
from tagmetry.errors import InputError
from tagmetry.twin.camera.course import Course
from tagmetry.twin.camera.device import SETTABLE, Device
from tagmetry.twin.camera.faults import Faults
from tagmetry.twin.camera.setting import Setting


class TwinControls:
    """What can be set on a simulated camera: `tagmetry.camera.Controls` on simulated time.

    A value is rounded to the control's step. A change shows in the images that begin once the
    device's delay has passed; the focus motor then takes its time.
    """

    def __init__(self, device: Device, faults: Faults, now_s: Callable[[], float]) -> None:
        """Stand at the defaults.

        Args:
            device: What there is to set.
            faults: What is wrong with it.
            now_s: The simulated time.
        """
        _check_names(device, faults)
        self._device, self._faults, self._now_s = device, faults, now_s
        self._read_back = {control.name: control.default for control in device.controls}
        self._courses = {
            control.name: Course(control.default, device.speed_per_s.get(control.name, np.inf))
            for control in device.controls
        }

    @property
    def available(self) -> Mapping[str, Control]:
        """The camera's controls by name."""
        return self._device.available

    def read(self, name: str) -> float:
        """Return what a control was set to last, by hand or by an auto mode."""
        control_named(self.available, name)
        return self._read_back[name] + self._faults.misread.get(name, 0.0)

    def write(self, name: str, value: float) -> float:
        """Set a control and return the value that was sent: the nearest whole step.

        Raises:
            InputError: There is no such control, or the value is out of its range.
            ControlRefusedError: An auto mode has the control, or it is a fault.
        """
        sent = control_named(self.available, name).checked(value)
        if name in self._faults.refused:
            raise ControlRefusedError(f"{name}: the camera does not take {sent:g}")
        if self.is_automatic(name):
            auto = RULED_BY[name]
            raise ControlRefusedError(f"{name}: {auto} is on; write {auto} 0 first")
        self._go(name, sent)
        return sent

    def drive(self, name: str, value: float) -> None:
        """Set a control as an auto mode does, which sets nothing that is not there."""
        if name in self.available:
            self._go(name, self.available[name].nearest(value))

    def is_automatic(self, name: str) -> bool:
        """Say whether an auto mode has a control."""
        return self._read_back.get(RULED_BY.get(name, ""), 0.0) > 0

    def rests_at(self, name: str, time_s: float) -> bool:
        """Say whether a control is where it was last told to go."""
        return self._courses[name].rests_at(time_s)

    def setting_at(self, time_s: float) -> Setting:
        """Return what is in effect for an image that begins at a time."""
        preset = self._device.preset
        values = {
            field: self._courses[name].at(time_s)
            if name in self._courses
            else getattr(preset, field)
            for name, field in SETTABLE.items()
        }
        return Setting(**values)

    def _go(self, name: str, value: float) -> None:
        self._read_back[name] = value
        if name not in self._faults.stuck:
            self._courses[name].go(value, self._now_s() + self._delay_s(name))

    def _delay_s(self, name: str) -> float:
        images = self._device.delay_images.get(name, 0) + self._faults.late_images.get(name, 0)
        return images * self._device.period_s


def _check_names(device: Device, faults: Faults) -> None:
    named = {*faults.refused, *faults.stuck, *faults.misread, *faults.late_images}
    if unknown := sorted(named - set(device.available)):
        raise InputError(
            f"faults of controls that {device.name} does not have: {', '.join(unknown)}; it has: "
            f"{', '.join(device.available) or 'none'}"
        )

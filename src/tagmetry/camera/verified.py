"""Controls that are believed only after they were read back."""

from collections.abc import Mapping

from tagmetry.camera.controls import Control, ControlMisreadError, Controls, control_named

_HALF = 0.5  # of a step, that what is read back may differ
_STEPLESS = 1e-3  # of the range, where there are no steps


class VerifiedControls:
    """Another camera's controls, each of which is read back after it was set.

    A control that keeps its old value, or takes a third one, is an error at once. One that says it
    obeyed and did not is found in the images (`tagmetry.sources.controls.Settling`).
    """

    def __init__(self, controls: Controls) -> None:
        """Verify controls."""
        self._controls = controls

    @property
    def available(self) -> Mapping[str, Control]:
        """The camera's controls by name."""
        return self._controls.available

    def read(self, name: str) -> float:
        """Return what the camera says a control is at."""
        return self._controls.read(name)

    def write(self, name: str, value: float) -> float:
        """Set a control and return what the camera reads back.

        Raises:
            InputError: The camera has no such control, or the value is out of its range.
            ControlRefusedError: The camera does not take the value.
            ControlMisreadError: It reads back another one.
        """
        control = control_named(self.available, name)
        sent = self._controls.write(name, value)
        found = self._controls.read(name)
        slack = _HALF * control.step if control.step else _STEPLESS * (control.most - control.least)
        if not abs(found - sent) <= slack:
            raise ControlMisreadError(
                f"{name}: {sent:g} was sent, the camera reads back {found:g}; is something else "
                "setting it?"
            )
        return found

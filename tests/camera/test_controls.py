"""Ranges of controls, and cameras left as they were found."""

import numpy as np
import pytest

from tagmetry.camera import (
    Control,
    ControlMisreadError,
    ControlRefusedError,
    Controls,
    ControlStuckError,
    VerifiedControls,
    restored,
)
from tagmetry.camera.controls import RULED_BY, control_named
from tagmetry.errors import ControlError, InputError

FOCUS = Control("focus", 0.0, 150.0, 5.0, 0.0)
EXPOSURE = Control("exposure", 1e-4, 333e-4, 1e-4, 156e-4, "s")


class FakeControls:
    """Takes values as a webcam does: what an auto mode rules is refused while it is on."""

    def __init__(self, **values):
        self.values = values
        self.refused = set()

    @property
    def available(self):
        return {name: Control(name, 0.0, 1000.0, 1.0, 0.0) for name in self.values}

    def read(self, name):
        return self.values[name]

    def write(self, name, value):
        if name in self.refused or self.values.get(RULED_BY.get(name, ""), 0.0) > 0:
            raise ControlRefusedError(f"{name}: refused")
        self.values[name] = value
        return value


@pytest.mark.parametrize("control", [FOCUS, EXPOSURE, Control("gain", 1.0, 8.0, 0.1, 1.0)])
def test_every_value_becomes_the_nearest_step_and_stays_there(control: Control) -> None:
    wanted = np.random.default_rng(0).uniform(control.least, control.most, 500)
    taken = np.array([control.checked(value) for value in wanted])
    assert np.abs(taken - wanted).max() <= control.step / 2 * (1 + 1e-9)
    assert [control.checked(value) for value in taken] == taken.tolist()
    assert taken.min() >= control.least
    assert taken.max() <= control.most
    steps = (taken - control.least) / max(control.step, 1e-300)
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-6)


def test_the_last_step_does_not_pass_the_end_of_the_range() -> None:
    assert Control("zoom", 100.0, 500.0, 150.0, 100.0).checked(500.0) == 400.0


def test_without_steps_every_value_is_taken() -> None:
    assert Control("gain", 1.0, 16.0, 0.0, 1.0).checked(3.21) == 3.21


def test_limits_that_were_computed_are_taken() -> None:
    assert EXPOSURE.checked(333 * 1e-4) == pytest.approx(0.0333)
    assert EXPOSURE.checked(0.1 * 1e-3) == EXPOSURE.least


@pytest.mark.parametrize("value", [-1.0, 151.0, float("nan"), float("inf")])
def test_a_value_out_of_range_is_refused_and_not_clipped(value: float) -> None:
    with pytest.raises(InputError, match=r"focus: expected 0 to 150 in steps of 5, got"):
        FOCUS.checked(value)


def test_nearest_clips() -> None:
    assert [FOCUS.nearest(value) for value in (-9.0, 12.4, 1e9)] == [0.0, 10.0, 150.0]


def test_refuses_ranges_that_make_no_sense() -> None:
    with pytest.raises(InputError, match=r"zoom: the default 90 is not in 100 to 500 percent"):
        Control("zoom", 100.0, 500.0, 1.0, 90.0, "percent")
    with pytest.raises(InputError, match="step not negative"):
        Control("zoom", 100.0, 500.0, -1.0, 100.0)
    with pytest.raises(InputError, match="must be finite"):
        Control("zoom", 100.0, float("inf"), 1.0, 100.0)


def test_an_unknown_control_is_named_with_those_that_there_are() -> None:
    with pytest.raises(InputError, match=r"no control 'iris'; it has: focus$"):
        control_named({"focus": FOCUS}, "iris")
    with pytest.raises(InputError, match=r"it has: none$"):
        control_named({}, "iris")


def test_everything_is_as_it_was_after_an_interrupt() -> None:
    controls = FakeControls(auto_focus=1.0, focus=7.0, zoom=100.0)
    assert isinstance(controls, Controls)
    before = dict(controls.values)
    with pytest.raises(KeyboardInterrupt):
        _interrupted(controls)
    assert controls.values == before


def _interrupted(controls: FakeControls) -> None:
    with restored(controls):
        controls.write("auto_focus", 0.0)
        controls.write("focus", 33.0)
        controls.write("zoom", 300.0)
        raise KeyboardInterrupt


def test_what_was_ruled_by_an_auto_mode_switched_on_inside_is_set_back_too() -> None:
    controls = FakeControls(focus=7.0, auto_focus=0.0)
    with restored(controls):
        controls.write("focus", 9.0)
        controls.write("auto_focus", 1.0)
    assert controls.values == {"focus": 7.0, "auto_focus": 0.0}


def test_a_control_that_refuses_keeps_no_other_from_being_set_back() -> None:
    controls = FakeControls(zoom=100.0, focus=7.0)
    with pytest.raises(ControlRefusedError, match="not set back as it was: zoom: refused"):
        _zoomed_and_stuck(controls)
    assert controls.values["focus"] == 7.0


def _zoomed_and_stuck(controls: FakeControls) -> None:
    with restored(controls):
        controls.write("zoom", 300.0)
        controls.write("focus", 30.0)
        controls.refused.add("zoom")


def test_what_nobody_touched_is_not_written() -> None:
    """A value that was found may be one that the camera would not take."""
    controls = FakeControls(zoom=-5.0, focus=7.0)
    controls.refused.add("zoom")
    with restored(controls):
        controls.write("focus", 30.0)
    assert controls.values == {"zoom": -5.0, "focus": 7.0}


def test_what_can_no_longer_be_read_keeps_no_other_from_being_set_back() -> None:
    class Broken(FakeControls):
        is_broken = False

        def read(self, name):
            if self.is_broken and name == "zoom":
                raise ControlRefusedError("zoom: no answer")
            return super().read(name)

    controls = Broken(zoom=100.0, focus=7.0)
    with pytest.raises(ControlRefusedError, match="not set back as it was: zoom: no answer"):
        _broken_within(controls)
    assert controls.values["focus"] == 7.0


def _broken_within(controls) -> None:
    with restored(controls):
        controls.write("focus", 30.0)
        controls.is_broken = True


def test_verified_controls_return_what_is_read_back() -> None:
    controls = VerifiedControls(FakeControls(zoom=100.0))
    assert isinstance(controls, Controls)
    assert controls.write("zoom", 300.0) == controls.read("zoom") == 300.0
    assert set(controls.available) == {"zoom"}


@pytest.mark.parametrize(("read_back", "text"), [(100.0, "100"), (250.0, "250"), (np.nan, "nan")])
def test_a_control_that_reads_back_another_value_is_named(read_back: float, text: str) -> None:
    class Misread(FakeControls):
        def read(self, name):  # noqa: ARG002 (whatever it is)
            return read_back

    with pytest.raises(ControlMisreadError, match=f"zoom: 300 was sent, .* reads back {text};"):
        VerifiedControls(Misread(zoom=100.0)).write("zoom", 300.0)


def test_half_a_step_of_rounding_is_no_misreading() -> None:
    class Rounding(FakeControls):
        def read(self, name):
            return self.values[name] + 0.499

    assert VerifiedControls(Rounding(zoom=100.0)).write("zoom", 300.0) == 300.499


def test_every_fault_of_a_control_is_a_control_error() -> None:
    for kind in (ControlRefusedError, ControlMisreadError, ControlStuckError):
        assert issubclass(kind, ControlError)
    assert issubclass(ControlError, InputError)

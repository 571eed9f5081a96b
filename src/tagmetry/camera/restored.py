"""Leave a camera as it was found."""

from collections.abc import Generator, Iterable, Mapping
from contextlib import contextmanager

from tagmetry.camera.controls import RULED_BY, ControlRefusedError, Controls
from tagmetry.errors import ControlError, InputError


@contextmanager
def restored(controls: Controls) -> Generator[Controls]:
    """Give the controls, and set them back at the end, also after an error or an interrupt.

    Auto modes are switched off before what they rule is set, and on again after it.

    Raises:
        ControlRefusedError: Something could not be set back; all others were. Where another fault
            of a control came before, that one is raised, and tells both.
    """
    found = {name: controls.read(name) for name in controls.available}
    fault: ControlError | None = None
    try:
        yield controls
    except ControlError as error:
        fault = error
        raise
    finally:
        if told := _not_set_back(controls, found):
            kind = ControlRefusedError if fault is None else type(fault)
            raise kind(told if fault is None else f"{fault}; {told}")


def _not_set_back(controls: Controls, found: Mapping[str, float]) -> str:
    """Set everything back, and tell what could not be; empty where all was."""
    autos = [name for name in found if name in RULED_BY.values()]
    refusals = _refusals(controls, dict.fromkeys(autos, 0.0).items())
    refusals += _refusals(controls, ((n, v) for n, v in found.items() if n not in autos))
    refusals += _refusals(controls, ((name, found[name]) for name in autos))
    return "not set back as it was: " + "; ".join(refusals) if refusals else ""


def _refusals(controls: Controls, values: Iterable[tuple[str, float]]) -> list[str]:
    """Set values where they are not so already, and return why some were refused."""
    refusals = []
    for name, value in values:
        try:
            if controls.read(name) != value:
                controls.write(name, value)
        except InputError as refusal:
            refusals.append(str(refusal))
    return refusals

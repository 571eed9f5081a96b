"""Leave a camera as it was found."""

from collections.abc import Generator, Iterable
from contextlib import contextmanager

from tagmetry.camera.controls import RULED_BY, ControlRefusedError, Controls
from tagmetry.errors import InputError


@contextmanager
def restored(controls: Controls) -> Generator[Controls]:
    """Give the controls, and set them back at the end, also after an error or an interrupt.

    Auto modes are switched off before what they rule is set, and on again after it.

    Raises:
        ControlRefusedError: Something could not be set back; all others were.
    """
    found = {name: controls.read(name) for name in controls.available}
    autos = [name for name in found if name in RULED_BY.values()]
    try:
        yield controls
    finally:
        values = dict.fromkeys(autos, 0.0)
        refusals = _refusals(controls, values.items())
        refusals += _refusals(controls, ((n, v) for n, v in found.items() if n not in autos))
        refusals += _refusals(controls, ((name, found[name]) for name in autos))
        if refusals:
            raise ControlRefusedError("not set back as it was: " + "; ".join(refusals))


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

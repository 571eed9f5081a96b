"""A source and the controls of its camera as one thing."""

from collections.abc import Iterator

from tagmetry.camera import ControlledSource, Controls, Image, Source
from tagmetry.closing import Closing
from tagmetry.sources.controls.open import open_controls
from tagmetry.sources.controls.v4l2_controls import V4l2Controls


def controlled(source: Source) -> ControlledSource:
    """Return a source with the controls of its camera: itself, where it has them.

    Args:
        source: As of `open_controls`; closed with what is returned.

    Raises:
        InputError: It has no controls.
    """
    if isinstance(source, ControlledSource):
        return source
    return _Controlled(source, open_controls(source))


class _Controlled(Closing):
    def __init__(self, source: Source, controls: Controls) -> None:
        self._source, self._controls = source, controls

    @property
    def name(self) -> str:
        """Path, address or device, for people."""
        return self._source.name

    @property
    def is_live(self) -> bool:
        """Whether images arrive by themselves and old ones are dropped."""
        return self._source.is_live

    @property
    def length(self) -> int | None:
        """How many images there will be, where that is known."""
        return self._source.length

    @property
    def controls(self) -> Controls:
        """What can be set."""
        return self._controls

    def __iter__(self) -> Iterator[Image]:
        """Give the images."""
        return iter(self._source)

    def close(self) -> None:
        """Let go of both; may be called twice."""
        if isinstance(self._controls, V4l2Controls):
            self._controls.close()
        self._source.close()

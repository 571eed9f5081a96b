"""A source of images together with the controls of its camera."""

from collections.abc import Generator, Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Self

from tagmetry.camera import ControlledSource, Controls, Image, Source
from tagmetry.pipeline.opening import open_images


class Controlled:
    """A camera's images and its controls, which come from different places."""

    def __init__(self, source: Source, controls: Controls) -> None:
        """Join them."""
        self._source, self._controls = source, controls

    @property
    def name(self) -> str:
        """Of the source."""
        return self._source.name

    @property
    def is_live(self) -> bool:
        """Of the source."""
        return self._source.is_live

    @property
    def length(self) -> int | None:
        """Of the source."""
        return self._source.length

    @property
    def controls(self) -> Controls:
        """What can be set."""
        return self._controls

    def __iter__(self) -> Iterator[Image]:
        """Give the source's images."""
        return iter(self._source)

    def close(self) -> None:
        """Close the source."""
        self._source.close()

    def __enter__(self) -> Self:
        """Return it."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the source."""
        self.close()


@contextmanager
def opened(spec: str) -> Generator[ControlledSource]:
    """Open a camera with its controls: `0`, `/dev/video2`, `twin:webcam`.

    Raises:
        InputError: It is not there, or has no controls.
    """
    from tagmetry.sources.controls import open_controls

    with open_images(spec) as source:
        if isinstance(source, ControlledSource):
            yield source
            return
        yield Controlled(source, open_controls(source))

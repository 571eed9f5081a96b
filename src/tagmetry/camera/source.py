"""What anything that gives images looks like: a folder, a video, a camera, or its twin."""

from collections.abc import Iterator
from types import TracebackType
from typing import Protocol, Self, runtime_checkable

from tagmetry.camera.image import Image


@runtime_checkable
class Source(Protocol):
    """Gives images, one after another.

    A finite source (pictures, a video file) gives every image. A live one (a camera, a network
    stream) gives the newest and drops what nobody took in time; `Image.sequence` shows the gaps.
    """

    @property
    def name(self) -> str:
        """Path, address or device, for people."""

    @property
    def is_live(self) -> bool:
        """Whether images arrive by themselves and old ones are dropped."""

    @property
    def length(self) -> int | None:
        """How many images there will be, where that is known."""

    def __iter__(self) -> Iterator[Image]:
        """Give the images."""

    def close(self) -> None:
        """Let go of the file or device; may be called twice."""

    def __enter__(self) -> Self:
        """Return the source."""

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the source."""

"""Writers, and files that appear whole at the end of a run or not at all."""

from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import BinaryIO, Generic, Protocol, Self, TypeVar

from tagmetry.files.atomic import refusing, replace_file

Item_contra = TypeVar("Item_contra", contravariant=True)


class Writer(Protocol[Item_contra]):
    """Takes one item after another inside a with-block."""

    def write(self, item: Item_contra) -> None:
        """Write one more."""

    def __enter__(self) -> Self:
        """Open the file."""

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the file."""


class Encoder(Protocol[Item_contra]):
    """What a format does with an open file."""

    def begin(self, file: BinaryIO, stack: ExitStack) -> None:
        """Write what comes first; what must be closed before the file goes on the stack."""

    def write(self, item: Item_contra) -> None:
        """Write one more item."""

    def finish(self) -> None:
        """Write what comes last; not called when the run failed."""


class WholeFileWriter(Generic[Item_contra]):
    """Replaces a file at the end of the with-block; after an error the old file stays as it was.

    Ctrl-C ends a recording, it is no error: what was taken until then is kept.
    """

    def __init__(self, path: str | Path, encoder: Encoder[Item_contra]) -> None:
        self._path = Path(path)
        self._encoder = encoder
        self._stack = ExitStack()

    def __enter__(self) -> Self:
        with refusing(self._path), ExitStack() as opening:
            file = opening.enter_context(replace_file(self._path))
            self._encoder.begin(file, opening)
            self._stack = opening.pop_all()
        return self

    def write(self, item: Item_contra) -> None:
        """Write one more item."""
        with refusing(self._path):
            self._encoder.write(item)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if kind not in (None, KeyboardInterrupt):
            self._stack.__exit__(kind, error, trace)
            return
        with refusing(self._path), self._stack:
            self._encoder.finish()

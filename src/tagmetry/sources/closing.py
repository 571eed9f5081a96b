"""What every source shares: it is a context manager that closes itself."""

from abc import ABC, abstractmethod
from types import TracebackType
from typing import Self


class ClosingSource(ABC):
    """A source that lets go of what it holds at the end of a `with` block."""

    @abstractmethod
    def close(self) -> None:
        """Let go of the file or device; may be called twice."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

"""What many that hold something share: a `with` block closes them at its end."""

from abc import ABC, abstractmethod
from types import TracebackType
from typing import Self


class Closing(ABC):
    """Lets go of what it holds at the end of a `with` block."""

    @abstractmethod
    def close(self) -> None:
        """Let go of the file, device or process."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

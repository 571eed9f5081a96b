"""What was recorded, as files of one folder: only those that the list names are ever touched."""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

from tagmetry.errors import InputError

Folder = Callable[[], Path]
Writing = Callable[[], str | None]


@dataclass(frozen=True)
class Recorded:
    """One recording.

    Attributes:
        name: Of its file.
        size_bytes: Of its file.
        is_growing: It is being written.
    """

    name: str
    size_bytes: int
    is_growing: bool


class Shelf:
    """The folder of recordings."""

    def __init__(self, folder: Folder, writing: Writing) -> None:
        """Look at a folder.

        Args:
            folder: Says where recordings are; it may not be there yet.
            writing: Names the file that is being written; None while none is.
        """
        self._folder, self._writing = folder, writing

    def all(self) -> list[dict[str, object]]:
        """Return what there is, the newest first."""
        found = sorted(self._found().values(), key=lambda one: one.name, reverse=True)
        return [asdict(one) for one in found]

    def path(self, name: str) -> Path | None:
        """Return where a recording lies; None where there is none of that name."""
        return self._folder() / name if name in self._found() else None

    def whole(self, name: str) -> Path | None:
        """Return where a recording lies that is finished; None where there is none of that name.

        Raises:
            InputError: It is being written.
        """
        found = self._found().get(name)
        if found is not None and found.is_growing:
            raise InputError(f"{name} is being written; end the recording first")
        return None if found is None else self._folder() / name

    def delete(self, name: str) -> bool:
        """Delete a recording; say whether there was one of that name.

        Raises:
            InputError: It is being written.
        """
        path = self.whole(name)
        if path is not None:
            path.unlink(missing_ok=True)
        return path is not None

    def _found(self) -> dict[str, Recorded]:
        writing = self._writing()
        found = self._folder().glob("*.mcap")
        files = [path for path in found if path.is_file() and not path.is_symlink()]
        return {
            path.name: Recorded(path.name, path.stat().st_size, path.name == writing)
            for path in files
        }

"""Result files by their suffix."""

from collections.abc import Callable, Iterator
from pathlib import Path

from tagmetry.errors import InputError
from tagmetry.record.jsonl import LinesWriter, format_line, read_lines
from tagmetry.record.parquet import ParquetEncoder, read_parquet
from tagmetry.record.result import ImageResult
from tagmetry.record.table import TableEncoder
from tagmetry.record.trajectory import MarkerKey, TrajectoryEncoder
from tagmetry.record.whole import WholeFileWriter, Writer

READERS: dict[str, Callable[[Path], Iterator[ImageResult]]] = {
    ".jsonl": read_lines,
    ".parquet": read_parquet,
}


def open_writer(
    path: str | Path, *, marker: MarkerKey | None = None, inverse: bool = False
) -> Writer[ImageResult]:
    """Return a writer for the format that the suffix names, to be used in a with-block.

    `.jsonl` holds every line at once, and `-` is the same on the standard output. `.csv`,
    `.parquet` and `.tum` appear when the block ends without an error.

    Args:
        path: Where to; `.jsonl`, `.csv`, `.parquet`, `.tum` or `-`.
        marker: Family and id of the marker whose trajectory a `.tum` file is to hold.
        inverse: The trajectory is `T_marker_camera`, not `T_camera_marker`.

    Raises:
        InputError: The suffix is another one; later, the file cannot be written.
    """
    writers: dict[str, Callable[[], Writer[ImageResult]]] = {
        ".jsonl": lambda: LinesWriter(path, format_line),
        ".csv": lambda: WholeFileWriter(path, TableEncoder()),
        ".parquet": lambda: WholeFileWriter(path, ParquetEncoder()),
        ".tum": lambda: WholeFileWriter(path, TrajectoryEncoder(marker, inverse=inverse)),
    }
    suffix = ".jsonl" if str(path) == "-" else Path(path).suffix.lower()
    if suffix not in writers:
        raise unknown_suffix(path, tuple(writers))
    return writers[suffix]()


def read_results(path: str | Path) -> Iterator[ImageResult]:
    """Give the results that a `.jsonl` or `.parquet` file holds, one by one.

    Half a line at the end of a `.jsonl` file, as a killed run leaves it, is passed over with a
    `CutLineWarning`.

    Raises:
        InputError: The suffix is another one, or the file is damaged; the text says where.
    """
    path = Path(path)
    if path.suffix.lower() not in READERS:
        raise unknown_suffix(path, tuple(READERS))
    return READERS[path.suffix.lower()](path)


def unknown_suffix(path: str | Path, known: tuple[str, ...]) -> InputError:
    """Return the error for a file whose suffix says no format that there is."""
    found = Path(path).suffix or "no suffix"
    return InputError(f"{path}: expected a file ending in {', '.join(known)}, found {found}")

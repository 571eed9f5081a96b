"""A recording as tables and pictures, for programs that know no MCAP."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Literal, TypeVar

from tagmetry.errors import InputError
from tagmetry.files.atomic import refusing, write_atomically
from tagmetry.record.formats import open_writer
from tagmetry.record.jsonl import parse_line
from tagmetry.record.mcap.images import picture_of
from tagmetry.record.mcap.reading import read_entries, warn_of_damage
from tagmetry.record.mcap.row_files import CsvRows, ParquetRows
from tagmetry.record.mcap.rows import PACKET_ROWS, STATE_ROWS, Cell, RowKind
from tagmetry.record.mcap.topics import DETECTIONS, IMAGES, PACKETS, STATES
from tagmetry.record.result import ImageResult
from tagmetry.record.whole import Encoder, WholeFileWriter, Writer

TableFormat = Literal["csv", "parquet"]
Item = TypeVar("Item")


def export_recording(
    path: str | Path, folder: str | Path, table_format: TableFormat = "csv", *, images: bool = False
) -> dict[str, int]:
    """Write detections, states and packets as tables, and images as pictures.

    Args:
        path: The recording.
        folder: Where to; made where there is none.
        table_format: Of `detections`, `states` and `packets`; detections in CSV are one row for
            every marker, in Parquet one for every image.
        images: Write the pictures too, into `images`, as they were recorded.

    Returns:
        Each file's or folder's name, and how many messages went into it.

    Raises:
        InputError: The recording cannot be read, or something cannot be written.
        MissingExtraError: The part `arena`, or `parquet`, is not installed.
    """
    folder = Path(folder)
    counts = _count_topics(path)
    with refusing(folder):
        folder.mkdir(parents=True, exist_ok=True)
    written: dict[str, int] = {}
    for topic, name in ((DETECTIONS, "detections"), (STATES, "states"), (PACKETS, "packets")):
        if counts.get(topic):
            file = folder / f"{name}.{table_format}"
            written[file.name] = _export_table(path, topic, file)
    if images and counts.get(IMAGES):
        written["images"] = _export_images(path, folder / "images")
    return written


def _count_topics(path: str | Path) -> dict[str, int]:
    counts: dict[str, int] = {}
    for entry in read_entries(path):
        counts[entry.topic] = counts.get(entry.topic, 0) + 1
    return counts


def _export_table(path: str | Path, topic: str, file: Path) -> int:
    if topic == DETECTIONS:
        return _write_all(open_writer(file), _results(path))
    kind = STATE_ROWS if topic == STATES else PACKET_ROWS
    is_csv = file.suffix == ".csv"
    encoder: Encoder[list[Cell]] = (CsvRows if is_csv else ParquetRows)(kind.columns)
    writer = WholeFileWriter[list[Cell]](file, encoder)
    return _write_all(writer, _rows(path, topic, kind))


def _write_all(writer: Writer[Item], groups: Iterable[list[Item]]) -> int:
    count = 0
    with writer:
        for group in groups:
            count += 1
            for item in group:
                writer.write(item)
    return count


def _results(path: str | Path) -> Iterator[list[ImageResult]]:
    for content in _contents(path, DETECTIONS):
        try:
            yield [parse_line(content)]
        except InputError as error:
            _pass_over(path, error)


def _rows(path: str | Path, topic: str, kind: RowKind) -> Iterator[list[list[Cell]]]:
    for content in _contents(path, topic):
        try:
            yield list(kind.parse(content))
        except InputError as error:
            _pass_over(path, error)


def _export_images(path: str | Path, folder: Path) -> int:
    with refusing(folder):
        folder.mkdir(exist_ok=True)
    count = 0
    for content in _contents(path, IMAGES):
        try:
            sequence, picture_format, picture = picture_of(content)
        except InputError as error:
            _pass_over(path, error)
            continue
        suffix = "png" if picture_format == "png" else "jpg"
        write_atomically(folder / f"{sequence:08d}.{suffix}", picture)
        count += 1
    return count


def _contents(path: str | Path, topic: str) -> Iterator[bytes]:
    """Give the messages of a topic; of damage was told while they were counted."""
    entries = read_entries(path, topic, on_damage=lambda _: None)
    return (entry.content for entry in entries)


def _pass_over(path: str | Path, error: InputError) -> None:
    warn_of_damage(f"{path}: passed over a message: {error}")

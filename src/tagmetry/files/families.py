"""Marker families from files, in the text format of OpenCV's custom dictionaries.

`nmarkers`, `markersize` (bits per side), `maxCorrectionBits`, and `marker_0`, `marker_1`, … with
the bits row by row, 1 is white. The family is called as the file is.
"""

from pathlib import Path

import numpy as np
from pydantic import Field

from tagmetry.errors import InputError
from tagmetry.files.atomic import write_atomically
from tagmetry.files.checked import FileModel, checked
from tagmetry.files.filestorage import filestorage_text
from tagmetry.files.plain import shortened
from tagmetry.files.tables import Table, load_table
from tagmetry.files.text import named_errors
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers import Layout, MarkerFamily, family

MOST_MARKERS = 4096  # the distances of all pairs are measured, which takes memory with the square


class _Dictionary(FileModel):
    nmarkers: int = Field(ge=1, le=MOST_MARKERS)
    markersize: int = Field(ge=3, le=16)
    maxCorrectionBits: int = Field(ge=0)  # noqa: N815


def load_family(path: str | Path) -> MarkerFamily:
    """Return the marker family of a dictionary file, YAML or JSON.

    Raises:
        InputError: The file is missing or broken, has a marker twice, or claims to correct more
            bits than its markers' distance allows.
    """
    path = Path(path)
    table = load_table(path)
    with named_errors(path):
        return _family(path.stem, table)


def save_family(family: MarkerFamily, path: str | Path) -> None:
    """Write a family as a dictionary that OpenCV reads too; JSON where the name ends in `.json`.

    Raises:
        InputError: Its layout has no place in the format, or the file cannot be written.
    """
    path = Path(path)
    with named_errors(path):
        table = _table(family)
        _family(path.stem, table)  # nothing is written that could not be read again
    as_json = path.suffix.lower() == ".json"
    write_atomically(path, filestorage_text(table, as_json=as_json))


def resolve_family(name_or_path: str | Path) -> MarkerFamily:
    """Return a predefined family by its name, or the family of a dictionary file by its path.

    Raises:
        InputError: There is neither; the text lists the predefined names.
    """
    path = Path(name_or_path)
    if path.suffix or len(path.parts) > 1:
        return load_family(path)
    try:
        return family(str(name_or_path))
    except InputError:
        if path.is_file():
            return load_family(path)
        raise


def _family(name: str, table: Table) -> MarkerFamily:
    header = checked(_Dictionary, table)
    codes = np.stack([_code(table, i, header.markersize) for i in range(header.nmarkers)])
    if (beyond := f"marker_{header.nmarkers}") in table:
        raise InputError(f"nmarkers is {header.nmarkers}, but there is a {beyond}")
    _check_no_marker_twice(codes)
    layout = Layout.square(header.markersize)
    loaded = MarkerFamily(name, layout, codes, header.maxCorrectionBits)
    _check_correction(loaded)
    return loaded


def _code(table: Table, marker_id: int, side_cells: int) -> BoolArray:
    """Return the bits of one marker, shape (side_cells^2,), True is white."""
    key = f"marker_{marker_id}"
    if key not in table:
        raise InputError(f"nmarkers is {table['nmarkers']}, but {key} is missing")
    bits, count = table[key], side_cells**2
    if not isinstance(bits, str) or set(bits) - {"0", "1"} or len(bits) != count:
        raise InputError(
            f"{key}: expected {count} digits 0 or 1 in quotes (markersize {side_cells}), found "
            f"{_described(bits)}"
        )
    return np.array([bit == "1" for bit in bits])


def _described(bits: object) -> str:
    text = shortened(repr(bits))
    return f"{len(bits)} characters, {text}" if isinstance(bits, str) else text


def _check_no_marker_twice(codes: BoolArray) -> None:
    first_with: dict[bytes, int] = {}
    for marker_id, code in enumerate(codes):
        first = first_with.setdefault(code.tobytes(), marker_id)
        if first != marker_id:
            raise InputError(f"marker_{marker_id} is the same as marker_{first}")


def _check_correction(family: MarkerFamily) -> None:
    distance = family.minimum_distance()
    allowed = max(0, (distance - 1) // 2)
    if family.correction_bits > allowed:
        raise InputError(
            f"maxCorrectionBits is {family.correction_bits}, but the markers differ in as few as "
            f"{distance} bits, which allows {allowed}; set it to {allowed}"
        )


def _table(family: MarkerFamily) -> Table:
    side_cells = family.layout.side_cells - 2 * family.layout.border_cells
    if side_cells < 1 or family.layout != Layout.square(side_cells):
        raise InputError(
            f"OpenCV's dictionaries have square markers with a border of one cell, {family.name} "
            "is laid out otherwise"
        )
    table: Table = {
        "nmarkers": len(family),
        "markersize": side_cells,
        "maxCorrectionBits": family.correction_bits,
    }
    for marker_id, code in enumerate(family.codes):
        table[f"marker_{marker_id}"] = "".join("1" if bit else "0" for bit in code)
    return table

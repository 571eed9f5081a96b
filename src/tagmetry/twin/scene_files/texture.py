"""Textures by name, or from a picture."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.sources import open_source
from tagmetry.twin.scenes.grain import checker, grain

_MOST_CELLS = 4_000_000


def texture_of(name: str, size_m: Sequence[float], cell_m: float, seed: int) -> Array:
    """Return cells from 0 dark to 1 light, shape (rows, columns).

    Args:
        name: `checker`, `noise`, or the path of a picture, which is fitted to the size.
        size_m: Width and height of the sheet.
        cell_m: Side of a cell.
        seed: Of the noise.
    """
    columns, rows = (max(round(length_m / cell_m), 1) for length_m in size_m)
    if rows * columns > _MOST_CELLS:
        raise InputError(
            f"a texture has at most {_MOST_CELLS} cells, found {columns}x{rows}; make its cell "
            "larger"
        )
    if name == "checker":
        return checker(rows, columns)
    if name == "noise":
        return grain(rows, columns, np.random.default_rng(seed))
    return _picture(Path(name), rows, columns)


def _picture(path: Path, rows: int, columns: int) -> Array:
    """Return a picture's grey values as cells."""
    import cv2

    with open_source(path) as source:
        pixels = next(iter(source)).pixels
    grey = pixels if pixels.ndim == 2 else cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY)
    most = float(np.iinfo(pixels.dtype).max)
    fitted = cv2.resize(grey.astype(np.float64), (columns, rows), interpolation=cv2.INTER_AREA)
    return np.asarray(np.clip(fitted / most, 0.0, 1.0), dtype=np.float64)

"""The AprilTag project's own tables and drawings, from its library inside pyapriltags."""

import ctypes
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

pyapriltags = pytest.importorskip("pyapriltags")


class _Family(ctypes.Structure):
    _fields_ = (
        ("ncodes", ctypes.c_uint32),
        ("codes", ctypes.POINTER(ctypes.c_uint64)),
        ("width_at_border", ctypes.c_int),
        ("total_width", ctypes.c_int),
        ("reversed_border", ctypes.c_bool),
        ("nbits", ctypes.c_uint32),
        ("bit_x", ctypes.POINTER(ctypes.c_uint32)),
        ("bit_y", ctypes.POINTER(ctypes.c_uint32)),
        ("h", ctypes.c_uint32),
    )


class _Image(ctypes.Structure):
    _fields_ = (
        ("width", ctypes.c_int32),
        ("height", ctypes.c_int32),
        ("stride", ctypes.c_int32),
        ("buf", ctypes.POINTER(ctypes.c_uint8)),
    )


@dataclass(frozen=True, eq=False)
class LibraryFamily:
    """A family as the library has it; bits count from the top left cell of the square."""

    handle: int
    codes: np.ndarray
    bit_cells: tuple[tuple[int, int], ...]
    side_cells: int
    total_cells: int
    distance: int

    def drawn(self, marker_id: int) -> np.ndarray:
        """Return the library's drawing as cells, True is white; cells without ink are black."""
        draw = _library().apriltag_to_image
        draw.restype, draw.argtypes = ctypes.POINTER(_Image), (ctypes.c_void_p, ctypes.c_int)
        image = draw(self.handle, marker_id).contents
        pixels = np.ctypeslib.as_array(image.buf, (image.height, image.stride))
        return pixels[:, : image.width] > 127


def library_family(name: str) -> LibraryFamily:
    """Return a family of the library by its own name."""
    create = getattr(_library(), f"{name}_create")
    create.restype = ctypes.c_void_p
    handle = create()
    found = ctypes.cast(handle, ctypes.POINTER(_Family)).contents
    count = found.nbits
    columns, rows = (
        np.ctypeslib.as_array(places, (count,)).astype(np.int32)
        for places in (found.bit_x, found.bit_y)
    )
    words = np.ctypeslib.as_array(found.codes, (found.ncodes,))
    bits = np.array(
        [[word >> (count - 1 - k) & 1 for k in range(count)] for word in words.tolist()]
    )
    cells = tuple(zip(columns.tolist(), rows.tolist(), strict=True))
    widths = found.width_at_border, found.total_width
    return LibraryFamily(handle, bits.astype(bool), cells, *widths, found.h)


def _library() -> ctypes.CDLL:
    return ctypes.CDLL(str(next(Path(pyapriltags.__file__).parent.glob("*apriltag*.so"))))

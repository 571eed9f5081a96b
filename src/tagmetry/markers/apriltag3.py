"""AprilTag 3's newer families: bits within a white border, and around the black ring outside it.

The corners lie where the white border meets the black ring; `size_m` is the side of that square,
five or six cells, not of all that is printed. Markers of the circle families fit a disc: nothing is
printed in the corners beyond it. The middle of tagCustom48h12 is left free too.

The codes are those of the AprilTag project. Its generator tries the numbers V, V + P, V + 2 P, ...
(modulo 2^bits) one after another and keeps those far enough from all kept before; P is a prime. So
a code is told by how many were passed over since the one before it: that is what `tables` holds,
and the codes are as the project has them.

Reference: M. Krogius, A. Haggenmiller, E. Olson, Flexible Layouts for Fiducial Tags, IROS 2019.
"""

import zlib
from dataclasses import dataclass
from importlib.resources import files

import numpy as np

from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers.family import MarkerFamily
from tagmetry.markers.layout import Layout

_PRIME = 982451653
_STEP_TYPE = np.dtype("<u8")

Span = tuple[int, int, int]


@dataclass(frozen=True)
class Plan:
    """How one of these families is laid out.

    Attributes:
        side_cells: Cells along the square.
        quarter: Bits of the first quarter: row, first column and the column after the last. The
            other quarters are these turned clockwise; a middle cell is the last bit.
        first_code: The code of id 0, its first bit the highest.
        distance: Least number of differing bits of two markers.
    """

    side_cells: int
    quarter: tuple[Span, ...]
    first_code: int
    distance: int

    def layout(self) -> Layout:
        """Return the layout with the bits in the order of the code."""
        last = self.side_cells - 1
        cells = [(column, row) for row, begin, end in self.quarter for column in range(begin, end)]
        quarter = cells
        for _ in range(3):
            quarter = [(last - row, column) for column, row in quarter]
            cells = cells + quarter
        if self.side_cells % 2:
            cells.append((last // 2, last // 2))
        return Layout(self.side_cells, 1, tuple(cells), white_border=True)


APRILTAG3 = {
    "tagStandard41h12": Plan(5, ((-2, -2, 6), (1, 1, 3)), 0x1BD8A64AD10, 12),
    "tagStandard52h13": Plan(6, ((-2, -2, 7), (1, 1, 4), (2, 2, 3)), 0x4064A19651FF1, 13),
    "tagCircle21h7": Plan(5, ((-2, 1, 4), (1, 1, 3)), 0x157863, 7),
    "tagCircle49h12": Plan(5, ((-3, 1, 4), (-2, -1, 6), (1, 1, 3)), 0xC6C921D8614A, 12),
    "tagCustom48h12": Plan(6, ((-2, -2, 7), (1, 1, 4)), 0xD6C8AE76DFF0, 12),
}


def apriltag3_family(name: str) -> MarkerFamily:
    """Return one of the families in `APRILTAG3`."""
    plan = APRILTAG3[name]
    layout = plan.layout()
    codes = _codes(_steps(name), plan.first_code, layout.bit_count)
    return MarkerFamily(name, layout, codes, (plan.distance - 1) // 2)


def _steps(name: str) -> bytes:
    table = files("tagmetry.markers").joinpath("tables", f"{name}.steps")
    return zlib.decompress(table.read_bytes())


def _codes(steps: bytes, first_code: int, bits: int) -> BoolArray:
    """Return the codes as bits, shape (ids, bits), from the numbers tried between one and the next.

    The sums run over 64 bits and wrap around there, which leaves the lower bits as they should be.
    """
    tried = np.cumsum(np.frombuffer(steps, _STEP_TYPE))
    words = np.uint64(first_code) + tried.astype(np.uint64) * np.uint64(_PRIME)
    shifts = np.arange(bits - 1, -1, -1, dtype=np.uint64)
    return np.asarray((words[:, None] >> shifts) & np.uint64(1), dtype=bool)

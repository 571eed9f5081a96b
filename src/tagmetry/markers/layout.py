"""Where the border and the bits of a marker lie, on a grid of cells.

The bits are listed as cells, not as a matrix, because AprilTag 3's newer families have bits outside
the border as well. Cell (0, 0) is the top left cell of the square that is measured.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array, BoolArray, IntArray


@dataclass(frozen=True)
class Layout:
    """The geometry that all markers of a family share.

    Attributes:
        side_cells: Side of the square whose four corners are measured; `size_m` is its length.
        border_cells: How many cells wide the border inside that square is.
        bit_cells: (column, row) of every bit, in the order of the code; columns and rows below 0 or
            from `side_cells` on lie outside the square.
        white_border: The border is white, and around the square lies a ring of black cells, as in
            AprilTag 3's newer families.
    """

    side_cells: int
    border_cells: int
    bit_cells: tuple[tuple[int, int], ...]
    white_border: bool = False

    def __post_init__(self) -> None:
        cells = set(self.bit_cells)
        turned = {self._turned(cell) for cell in cells}
        if not cells or turned != cells or len(cells) < len(self.bit_cells):
            raise InputError(
                "a layout needs bits, no two in one cell, and every bit must turn into another by "
                f"a quarter turn of the {self.side_cells}x{self.side_cells} square"
            )

    @classmethod
    def square(cls, data_cells: int, border_cells: int = 1) -> "Layout":
        """Return the classic layout: a black border around data_cells x data_cells bits."""
        if border_cells < 1:
            raise InputError(f"a border is at least 1 cell wide, got {border_cells}")
        first, last = border_cells, border_cells + data_cells
        cells = tuple((column, row) for row in range(first, last) for column in range(first, last))
        return cls(data_cells + 2 * border_cells, border_cells, cells)

    @property
    def bit_count(self) -> int:
        """The number of bits in a code."""
        return len(self.bit_cells)

    @cached_property
    def margin_cells(self) -> int:
        """How far bits reach beyond the square, in cells."""
        cells = np.array(self.bit_cells)
        ring = int(self.white_border)
        return max(ring, int(-cells.min()), int(cells.max() + 1 - self.side_cells))

    @cached_property
    def black_cells(self) -> IntArray:
        """(column, row) of the cells that are black on every marker, shape (n, 2)."""
        return self._ring(-1, 0) if self.white_border else self._ring(0, self.border_cells)

    @cached_property
    def white_cells(self) -> IntArray:
        """(column, row) of the cells that are white on every marker, shape (n, 2)."""
        return self._ring(0, self.border_cells if self.white_border else 0)

    @cached_property
    def free_cells(self) -> IntArray:
        """(column, row) of cells of the square where anything may be, shape (n, 2)."""
        taken = np.concatenate([self.bit_cells, self.black_cells, self.white_cells]).tolist()
        free = [cell for cell in self._ring(0, self.side_cells).tolist() if cell not in taken]
        return np.array(free, dtype=np.intp).reshape(-1, 2)

    @cached_property
    def whole_rings(self) -> int:
        """How many rings of cells around the square are printed on every marker, without gaps."""
        taken = {tuple(cell) for cell in [*self.bit_cells, *self.black_cells.tolist()]}
        rings = 0
        while {tuple(cell) for cell in self._ring(-1 - rings, -rings).tolist()} <= taken:
            rings += 1
        return rings

    def _ring(self, outer: int, inner: int) -> IntArray:
        """Return the cells of a ring, row by row, that begins and ends so far inside the square."""
        across = np.arange(outer, self.side_cells - outer)
        rows, columns = np.meshgrid(across, across, indexing="ij")
        depth = np.minimum(
            np.minimum(rows, columns), self.side_cells - 1 - np.maximum(rows, columns)
        )
        return np.stack([columns[depth < inner], rows[depth < inner]], axis=1)

    @cached_property
    def bit_centres(self) -> Array:
        """Centres of the bits with the square's side as the unit, (n, 2), (0, 0) its top left."""
        return np.asarray((np.array(self.bit_cells) + 0.5) / self.side_cells)

    @cached_property
    def rotations(self) -> NDArray[np.intp]:
        """How a code reads on a turned marker, shape (4, n).

        `code[rotations[k]]` is what one reads when the marker was turned clockwise by k quarters.
        """
        index = {cell: i for i, cell in enumerate(self.bit_cells)}
        turns = [np.arange(self.bit_count)]
        quarter = [index[self._turned(cell)] for cell in self.bit_cells]
        for _ in range(3):
            turns.append(turns[-1][quarter])
        return np.stack(turns)

    def _turned(self, cell: tuple[int, int]) -> tuple[int, int]:
        """Return the cell that comes to lie at `cell` when the marker turns clockwise."""
        column, row = cell
        return row, self.side_cells - 1 - column

    def picture(self, code: BoolArray) -> BoolArray:
        """Return the marker as cells, True is white, shape (m, m), m = side + 2 * margin.

        Where neither a bit nor the border is, nothing is printed: paper, which is white.
        """
        cells = np.full((self.side_cells + 2 * self.margin_cells,) * 2, fill_value=True)
        for places, colour in ((self.black_cells, False), (np.array(self.bit_cells), code)):
            columns, rows = places.T + self.margin_cells
            cells[rows, columns] = colour
        return cells

"""Printed sheets: paper with grids of cells and dots of ink.

Frame: `sheet` has its origin at the sheet's centre, x right, y to its top, z out of its face.
Ink is opaque and lies side by side, so that the share of ink in any part of a sheet is the sum of
the shares of its prints.
"""

from dataclasses import dataclass, field

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform

PAPER = 0.85  # reflectance of white paper
INK = 0.06  # of a laser printer's black


@dataclass(frozen=True, eq=False)
class Print:
    """A grid of square cells.

    Attributes:
        ink: Share of ink in every cell, 0 to 1, shape (rows, columns), top left first.
        cell_m: Side of a cell.
        center_m: (x, y) of the grid's centre on the sheet.
    """

    ink: Array
    cell_m: float
    center_m: tuple[float, float] = (0.0, 0.0)

    @property
    def half_m(self) -> tuple[float, float]:
        """Half of its width and height."""
        rows, columns = self.ink.shape
        return columns * self.cell_m / 2, rows * self.cell_m / 2


@dataclass(frozen=True)
class Dot:
    """A disc of ink.

    Attributes:
        radius_m: Its radius.
        center_m: (x, y) on the sheet.
    """

    radius_m: float
    center_m: tuple[float, float] = (0.0, 0.0)

    @property
    def half_m(self) -> tuple[float, float]:
        """Half of its width and height."""
        return self.radius_m, self.radius_m


@dataclass(frozen=True, eq=False)
class Sheet:
    """A flat sheet; its back is not seen.

    Attributes:
        width_m: Its width.
        height_m: Its height.
        prints: What is printed on it, side by side, not over its edge.
        T_thing_sheet: Where it is on the thing that it belongs to.
        paper: Reflectance of the paper.
        ink: Reflectance of the ink.
        glow: Radiance of its own, of a window or a lamp's cover; white paper in ambient light has
            its reflectance.
    """

    width_m: float
    height_m: float
    prints: tuple[Print | Dot, ...] = ()
    T_thing_sheet: RigidTransform = field(default_factory=RigidTransform.identity)
    paper: float = PAPER
    ink: float = INK
    glow: float = 0.0

    def __post_init__(self) -> None:
        numbers = (self.width_m, self.height_m, self.paper, self.ink, self.glow)
        if not (np.isfinite(numbers).all() and self.width_m > 0 and self.height_m > 0):
            raise InputError(
                f"a sheet's width and height must be positive, got {self.width_m} m and "
                f"{self.height_m} m"
            )
        if min(self.paper, self.ink, self.glow) < 0:
            raise InputError(
                f"paper, ink and glow must not be negative, got {self.paper}, {self.ink} and "
                f"{self.glow}"
            )

    @property
    def corners_m(self) -> Array:
        """Its corners in its own frame, clockwise from the top left, shape (4, 3)."""
        return rectangle_m(self.width_m / 2, self.height_m / 2)


def rectangle_m(half_width_m: float, half_height_m: float) -> Array:
    """Return the corners of a rectangle round the origin, clockwise from the top left, (4, 3)."""
    signs = np.array([[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, -1.0, 0.0]])
    return np.asarray(signs * [half_width_m, half_height_m, 0.0])

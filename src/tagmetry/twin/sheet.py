"""Printed sheets: grids of cells of one reflectance each, one printed over the other.

Frame: `sheet` has its origin at the sheet's centre, x right, y to its top, z out of its face.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array, RigidTransform
from tagmetry.markers import MountedMarker, family


@dataclass(frozen=True, eq=False)
class Layer:
    """One grid of cells, centred on its sheet.

    Attributes:
        cells: Reflectance of every cell, 0 black to 1 white, shape (rows, columns), top left first.
        cell_m: Side of a cell.
    """

    cells: Array
    cell_m: float


@dataclass(frozen=True, eq=False)
class Sheet:
    """A sheet at its place.

    Attributes:
        T_body_sheet: Where it is.
        layers: What is printed on it: first the paper, which none of the others may overhang.
    """

    T_body_sheet: RigidTransform
    layers: tuple[Layer, ...]

    def rim_m(self, points_per_side: int) -> Array:
        """Return points along the paper's rim in the sheet's frame, shape (n, 3)."""
        rows, columns = self.layers[0].cells.shape
        half = self.layers[0].cell_m / 2 * np.array([columns, rows, 0.0])
        corners = half * np.array([[-1, 1, 0], [1, 1, 0], [1, -1, 0], [-1, -1, 0]])
        share = np.arange(points_per_side)[:, None] / points_per_side
        ends = np.roll(corners, -1, axis=0)
        return np.concatenate([a + share * (b - a) for a, b in zip(corners, ends, strict=True)])


def marker_sheet(marker: MountedMarker, quiet_cells: float) -> Sheet:
    """Return a marker on a white paper that is wider by its quiet zone."""
    own = family(marker.family)
    picture = own.picture(marker.id).astype(np.float64)
    cell_m = marker.size_m / own.layout.side_cells
    paper_m = (len(picture) + 2 * quiet_cells) * cell_m
    return Sheet(marker.T_body_marker, (Layer(np.ones((1, 1)), paper_m), Layer(picture, cell_m)))

"""The tile of a single marker."""

import math

from tagmetry.errors import InputError
from tagmetry.files.lengths import format_mm
from tagmetry.files.sheets.page import Box, Cells
from tagmetry.files.sheets.tile import Tile, labelled
from tagmetry.markers import MarkerFamily

SMALLEST_SIZE_M = 0.0001


def marker_cells(
    family: MarkerFamily, marker_id: int, left_m: float, top_m: float, size_m: float
) -> Cells:
    """Return a marker's black cells.

    Args:
        family: Its family.
        marker_id: Its id.
        left_m: Left side of the square whose side is `size_m`.
        top_m: Its top side; bits outside the square reach further left and up.
        size_m: Side of that square.
    """
    black = ~family.picture(marker_id)
    reach_m = family.layout.margin_cells * cell_m(family, size_m)
    side_m = size_m + 2 * reach_m
    return Cells(Box(left_m - reach_m, top_m - reach_m, side_m, side_m), black)


def cell_m(family: MarkerFamily, size_m: float) -> float:
    """Return the side of a marker's cell."""
    return size_m / family.layout.side_cells


def marker_tile(
    family: MarkerFamily,
    marker_id: int,
    size_m: float,
    quiet_cells: int = 1,
    *,
    inverted: bool = False,
) -> Tile:
    """Return a marker in its quiet zone.

    Args:
        family: Its family.
        marker_id: Its id.
        size_m: Side of its black square.
        quiet_cells: How many cells wide its quiet zone is.
        inverted: Print white on black.

    Raises:
        InputError: The family has no such id, or the size cannot be printed.
    """
    check_printable("size", size_m)
    around_m = (quiet_cells + family.layout.margin_cells) * cell_m(family, size_m)
    name = f"{family.name}, id {marker_id}"
    return labelled(
        ink=(marker_cells(family, marker_id, around_m, around_m, size_m),),
        width_m=size_m + 2 * around_m,
        height_m=size_m + 2 * around_m,
        labels=(f"{name}, {format_mm(size_m)}", name, f"id {marker_id}", str(marker_id)),
        size_name="size",
        size_m=size_m,
        inverted=inverted,
    )


def check_printable(name: str, length_m: float) -> None:
    """Refuse a length that no printer could print."""
    if not (math.isfinite(length_m) and length_m >= SMALLEST_SIZE_M):
        raise InputError(
            f"{name} must be at least {format_mm(SMALLEST_SIZE_M)}, got {format_mm(length_m)}"
        )

"""Which pixels tell where a marker is: those beside its edges, and a few flat ones for levels."""

import numpy as np

from tagmetry.detect.photometric.ink import QUIET_CELLS
from tagmetry.detect.photometric.kernel import kernel
from tagmetry.detect.photometric.model import cells_at
from tagmetry.detect.photometric.straight import straight_place
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

MOST_PIXELS = 1800
_BESIDE_PX = 0.9  # an edge is seen by pixels this near
_FLAT = 9  # one of so many flat pixels is taken
_REACH_PX = (0.3, 3.0)  # how far outside pixels are looked at: in cells at least, pixels at most
_CLEAR_PX = 1.5  # this much of the quiet zone may be blurred by what lies behind it


@kernel
def _near_edge(ink: Array, u: float, v: float, reach_u: float, reach_v: float) -> bool:
    """Say whether an edge of the picture lies within reach of a place."""
    rows, columns = ink.shape
    row, column = int(v), int(u)
    right, low = int(np.rint(u)), int(np.rint(v))
    near_u = 0 < right < columns and abs(u - right) < reach_u
    near_v = 0 < low < rows and abs(v - low) < reach_v
    if near_u and ink[row, right - 1] != ink[row, right]:
        return True
    if near_v and ink[low - 1, column] != ink[low, column]:
        return True
    if not (near_u and near_v):
        return False
    first = ink[low - 1, right - 1]
    return bool(
        ink[low - 1, right] != first or ink[low, right - 1] != first or ink[low, right] != first
    )


@kernel
def _in_sight(u: float, cell_px: float, cells: int) -> bool:
    """Say whether a place lies on the picture, or where its quiet zone may be trusted."""
    trusted_px = min(max(cell_px - _CLEAR_PX, _REACH_PX[0] * cell_px), _REACH_PX[1])
    outside = max(QUIET_CELLS - u, u - (cells - QUIET_CELLS))
    return outside * cell_px < trusted_px


@kernel
def _box(
    corners: Array, frame: Array, ink: Array, side_cells: float, width: int, height: int
) -> tuple[int, int, int, int]:
    """Return the first and last column and row of the image that the picture may reach."""
    wider = frame[2] * (ink.shape[0] - 2) / side_cells
    left, right = np.min(corners[:, 0]) * wider, np.max(corners[:, 0]) * wider
    top, bottom = np.min(corners[:, 1]) * wider, np.max(corners[:, 1]) * wider
    return (
        max(int(frame[0] + left), 0),
        min(int(frame[0] + right) + 1, width - 1),
        max(int(frame[1] + top), 0),
        min(int(frame[1] + bottom) + 1, height - 1),
    )


@kernel
def gather(
    grey: GreyPixels,
    ink: Array,
    fit: Array,
    corners: Array,
    frame: Array,
    lens: Array,
    side_cells: float,
) -> Array:
    """Return the chosen pixels: place x, y and grey value, shape (n, 3).

    Args:
        grey: The image.
        ink: From `printed`.
        fit: First guess.
        corners: Of the square, first guess, in the marker's frame, shape (4, 2).
        frame: Middle x, y and half diagonal of the marker, pixels.
        lens: See `straight_place`.
        side_cells: Cells along a side of the square.
    """
    middle_x, middle_y, half_px = frame
    height, width = grey.shape
    left, right, top, bottom = _box(corners, frame, ink, side_cells, width, height)
    room = max((right - left + 1) * (bottom - top + 1), 0)
    chosen = np.empty((room, 3))
    count = 0
    cells = ink.shape[0]
    for row in range(top, bottom + 1):
        for column in range(left, right + 1):
            x, y = straight_place((column - middle_x) / half_px, (row - middle_y) / half_px, lens)
            u, v, down = cells_at(fit, x, y)
            if not (down > 0.05 and 1 < u < cells - 1 and 1 < v < cells - 1):
                continue
            ux, uy = (fit[0] - u * fit[6]) / down, (fit[1] - u * fit[7]) / down
            vx, vy = (fit[3] - v * fit[6]) / down, (fit[4] - v * fit[7]) / down
            cell_u_px = half_px / np.sqrt(ux * ux + uy * uy)
            cell_v_px = half_px / np.sqrt(vx * vx + vy * vy)
            if not (_in_sight(u, cell_u_px, cells) and _in_sight(v, cell_v_px, cells)):
                continue
            reach_u, reach_v = _BESIDE_PX / cell_u_px, _BESIDE_PX / cell_v_px
            if _near_edge(ink, u, v, reach_u, reach_v) or (column + 3 * row) % _FLAT == 0:
                chosen[count, 0], chosen[count, 1], chosen[count, 2] = x, y, grey[row, column]
                count += 1
    kept = min(count, MOST_PIXELS)
    for k in range(kept):
        chosen[k] = chosen[k * count // kept]
    return chosen[:kept].copy()

"""Which pixels tell where a marker is: those beside its edges, and a few flat ones for levels."""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.ink import QUIET_CELLS
from tagmetry.detect.photometric.kernel import Narrow, Whole, f32, kernel, step
from tagmetry.detect.photometric.model import cell_px
from tagmetry.detect.photometric.sight import columns_in_sight, is_trusted, limits_of, rows_in_sight
from tagmetry.detect.photometric.straight import bend_of, straighten
from tagmetry.detect.photometric.view import View
from tagmetry.geometry import Array

MOST_BLOCKS = 48
_MOST_PIXELS = (MOST_BLOCKS - 1) * row.BLOCK
FLAT = 16  # stands for a flat pixel where others have the bits of edges
_FLAT_SHARE = 0.4  # of flat pixels among the chosen, at most; else one in 16 is taken
_GOLDEN = 0.618


@kernel
def gather(view: View, ink: Array, fit: Array, beside_px: float, wanted: int) -> int:
    """Write place, cell and grey value of the chosen pixels; return how many they are.

    Args:
        view: Its pixels are written; where the first edges in sight will stand, cells.
        ink: From `printed`.
        fit: First guess, without bows.
        beside_px: An edge is seen by pixels this near.
        wanted: About how many pixels to choose at most.
    """
    frame, (height, width) = view.frame, view.grey.shape
    cells, edges = len(ink), _edges_at_corners(ink)
    every = max(1, int(np.ceil(_beside_edges(ink, fit, frame[2], beside_px) / wanted)))
    rule = beside_px, _flat_among(cell_px(fit, frame[2]) * cells, every, wanted)
    narrow, bend = (fit.astype(np.float32), view.lens.astype(np.float32)), bend_of(view.lens)
    limits, kept = (
        limits_of(fit, frame[2], cells, beside_px),
        np.empty(row.BLOCK + 1, dtype=np.int32),
    )
    first_row, last_row = rows_in_sight(fit, frame, limits, height, bend)
    count, lane, turn = 0, 0, 0
    for image_row in range(first_row, last_row + 1):
        column, right = columns_in_sight(fit, frame, limits, width, bend, image_row)
        column += int(every * ((image_row * _GOLDEN) % 1.0))
        while column <= right:
            taken = min(row.BLOCK - lane, 1 + (right - column) // every)
            _take(view, image_row, column, every, taken, lane)
            column, lane = column + taken * every, lane + taken
            if lane == row.BLOCK:
                count = _chosen(view, narrow, edges, rule, turn, lane, count, kept)
                lane, turn = 0, turn + row.BLOCK - 3
    count = _chosen(view, narrow, edges, rule, turn, lane, count, kept)
    _end(view.pixels, count)
    return count


@step
def _take(view: View, image_row: int, column: int, every: int, count: int, lane: int) -> None:
    """Write place and grey value of some pixels of a row of the image, from a lane on."""
    room, (middle_x, middle_y, half_px) = view.room[lane:], view.frame
    x, y = f32((column - middle_x) / half_px), f32((image_row - middle_y) / half_px)
    step, grey = f32(every / half_px), view.grey[image_row, column:]
    for p in range(count):
        room[row.X + p], room[row.Y + p] = x + step * f32(p), y
        room[row.SEEN + p] = grey[every * p]


@kernel
def _end(pixels: Narrow, count: int) -> None:
    """Fill the rest of the last block, so that nothing there is not a number."""
    for k in range(count, -(-count // row.BLOCK) * row.BLOCK):
        block, at = pixels[k // row.BLOCK], k % row.BLOCK
        block[row.X + at], block[row.Y + at], block[row.SEEN + at] = 0.0, 0.0, 0.0
        block[row.FIRST_U + at], block[row.FIRST_V + at] = 0.0, 0.0


@step
def _chosen(
    view: View,
    narrow: tuple[Narrow, Narrow],
    edges: Whole,
    rule: tuple[float, int],
    turn: int,
    lanes: int,
    count: int,
    kept: Whole,
) -> int:
    """Append those pixels of the room that tell; return how many there are now.

    The numbers of the fit and of the lens are of 32 bits. The rule says how near an edge pixels
    tell (px), and among how many flat ones one is taken.
    """
    (fit, lens), (beside_px, flat), half_px = narrow, rule, view.frame[2]
    straighten(view.room, lens)
    cells, pixel = int(np.sqrt(len(edges))), f32(1.0 / half_px)
    _look(view.room, fit, cells, (f32(beside_px) * pixel, pixel), flat, turn)
    return _keep(view.room, lanes, edges, kept, view.pixels, count)


@kernel
def _beside_edges(ink: Array, fit: Array, half_px: float, beside_px: float) -> float:
    """Return about how many pixels lie beside edges of the picture."""
    edges = 0.0
    for j in range(1, len(ink)):
        for i in range(1, len(ink)):
            edges += abs(ink[j, i] - ink[j - 1, i]) + abs(ink[j, i] - ink[j, i - 1])
    return float(edges * cell_px(fit, half_px) * 2 * beside_px)


@kernel
def _flat_among(side_px: float, every: int, wanted: int) -> int:
    """Return among how many flat pixels one is taken, a power of two."""
    flat = FLAT
    while side_px * side_px > _FLAT_SHARE * wanted * every * flat and flat < 1 << 20:
        flat *= 2
    return flat


@kernel
def _edges_at_corners(ink: Array) -> Whole:
    """Return which edges meet at every corner of cells: 1 above, 2 below, 4 left, 8 right.

    Corner of column i and row j, left of and above cell i, j, stands at i + m j, for ink (m, m).
    """
    cells = len(ink)
    edges = np.full(cells * cells, FLAT, dtype=np.int32)
    for j in range(1, cells):
        for i in range(1, cells):
            above = ink[j - 1, i - 1] != ink[j - 1, i]
            below = ink[j, i - 1] != ink[j, i]
            left = ink[j - 1, i - 1] != ink[j, i - 1]
            right = ink[j - 1, i] != ink[j, i]
            edges[i + cells * j] += 1 * above + 2 * below + 4 * left + 8 * right
    return edges


@kernel
def _look(
    room: Narrow, fit: Narrow, cells: int, rule: tuple[f32, f32], flat: int, turn: int
) -> None:
    """Write where pixels lie in cells, the nearest corner, and which edges there would count.

    Args:
        room: The block.
        fit: The numbers of the fit.
        cells: Along a side of the picture and its quiet zone.
        rule: How near an edge a pixel sees it, and the size of a pixel, half diagonals.
        flat: One of so many flat pixels is taken.
        turn: Which one of them.
    """
    (reach, pixel), last = rule, f32(cells - 1)
    low, high = f32(QUIET_CELLS), f32(cells - QUIET_CELLS)
    for p in range(row.BLOCK):
        x, y = room[row.X + p], room[row.Y + p]
        down = f32(1) / (fit[6] * x + fit[7] * y + f32(1))
        u = (fit[0] * x + fit[1] * y + fit[2]) * down
        v = (fit[3] * x + fit[4] * y + fit[5]) * down
        fine2_u = _fineness2(fit[0] - u * fit[6], fit[1] - u * fit[7], down)
        fine2_v = _fineness2(fit[3] - v * fit[6], fit[4] - v * fit[7], down)
        corner_u = np.rint(u) if f32(1) <= u <= last else f32(1)
        corner_v = np.rint(v) if f32(1) <= v <= last else f32(1)
        past_u, past_v = u - corner_u, v - corner_v
        near_u = past_u * past_u < reach * reach * fine2_u
        near_v = past_v * past_v < reach * reach * fine2_v
        meeting = (f32(2) if past_v > f32(0) else f32(1)) if near_u else f32(0)
        meeting += (f32(8) if past_u > f32(0) else f32(4)) if near_v else f32(0)
        meeting = f32(15) if near_u & near_v else meeting
        meeting += f32(FLAT) if (p + turn) & (flat - 1) == 0 else f32(0)
        trusted_u = is_trusted(max(low - u, u - high), pixel * pixel * fine2_u)
        trusted_v = is_trusted(max(low - v, v - high), pixel * pixel * fine2_v)
        seen = trusted_u & trusted_v & (down > f32(0)) & (down < f32(20))
        room[row.U + p], room[row.V + p] = u, v
        room[row.CORNER + p] = corner_u + f32(cells) * corner_v
        room[row.MEETING + p] = meeting if seen else f32(0)


@kernel
def _fineness2(across: f32, along: f32, down: f32) -> f32:
    """Return the squared slope of a cell coordinate."""
    return (across * across + along * along) * down * down


@kernel
def _keep(room: Narrow, lanes: int, edges: Whole, kept: Whole, pixels: Narrow, count: int) -> int:
    """Append the pixels of a block that tell; return how many there are now."""
    chosen = 0
    for p in range(lanes):
        here = edges[int(room[row.CORNER + p])] & int(room[row.MEETING + p])
        kept[chosen] = p
        chosen += 1 if here else 0
    chosen = min(chosen, _MOST_PIXELS - count)
    for k in range(chosen):
        p, block, at = kept[k], (count + k) // row.BLOCK, (count + k) % row.BLOCK
        pixels[block, row.X + at], pixels[block, row.Y + at] = room[row.X + p], room[row.Y + p]
        pixels[block, row.SEEN + at] = room[row.SEEN + p]
        pixels[block, row.FIRST_U + at] = room[row.U + p]
        pixels[block, row.FIRST_V + at] = room[row.V + p]
    return count + chosen

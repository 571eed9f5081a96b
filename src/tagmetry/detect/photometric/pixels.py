"""Which pixels tell where a marker is: those beside its edges, and a few flat ones for levels."""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.evaluate import write_cells
from tagmetry.detect.photometric.ink import QUIET_CELLS
from tagmetry.detect.photometric.kernel import Narrow, f32, kernel
from tagmetry.detect.photometric.model import cell_px
from tagmetry.detect.photometric.sight import columns_in_sight, rows_in_sight, trusted_cells
from tagmetry.detect.photometric.straight import bend_of, straighten
from tagmetry.detect.photometric.view import View
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray

MOST_BLOCKS = 48
_MOST_PIXELS = (MOST_BLOCKS - 1) * row.BLOCK
FLAT = 16  # stands for a flat pixel where others have the bits of edges
_FLAT_SHARE = 0.4  # of flat pixels among the chosen, at most; else one in 16 is taken
_GOLDEN = 0.618


@kernel
def gather(view: View, ink: Array, fit: Array, beside_px: float, wanted: int) -> int:
    """Write place and grey value of the chosen pixels; return how many they are.

    Args:
        view: Its pixels are written.
        ink: From `printed`.
        fit: First guess.
        beside_px: An edge is seen by pixels this near.
        wanted: About how many pixels to choose at most.
    """
    grey, frame, room = view.grey, view.frame, view.room
    cells, edges = len(ink), _edges_at_corners(ink)
    every = max(1, int(np.ceil(_beside_edges(ink, fit, frame[2], beside_px) / wanted)))
    rule = beside_px, _flat_among(cell_px(fit, frame[2]) * cells, every, wanted)
    narrow, bend = (fit.astype(np.float32), view.lens.astype(np.float32)), bend_of(view.lens)
    first_row, last_row = rows_in_sight(fit, frame, cells, grey.shape[0], bend)
    count, lane, turn, per_px = 0, 0, 0, 1.0 / frame[2]
    for image_row in range(first_row, last_row + 1):
        left, right = columns_in_sight(fit, frame, cells, grey.shape[1], bend, image_row)
        left += int(every * ((image_row * _GOLDEN) % 1.0))
        y = (image_row - frame[1]) * per_px
        for column in range(left, right + 1, every):
            room[row.X + lane], room[row.Y + lane] = (column - frame[0]) * per_px, y
            room[row.SEEN + lane] = grey[image_row, column]
            lane += 1
            if lane == row.BLOCK:
                count = _chosen(view, narrow, cells, edges, rule, turn, lane, count)
                lane, turn = 0, turn + row.BLOCK - 3
    count = _chosen(view, narrow, cells, edges, rule, turn, lane, count)
    _end(view.pixels, count)
    return count


@kernel
def _end(pixels: Narrow, count: int) -> None:
    """Fill the rest of the last block, so that nothing there is not a number."""
    for k in range(count, -(-count // row.BLOCK) * row.BLOCK):
        block, at = pixels[k // row.BLOCK], k % row.BLOCK
        block[row.X + at], block[row.Y + at], block[row.SEEN + at] = 0.0, 0.0, 0.0


@kernel
def _chosen(
    view: View,
    narrow: tuple[Narrow, Narrow],
    cells: int,
    edges: IntArray,
    rule: tuple[float, int],
    turn: int,
    lanes: int,
    count: int,
) -> int:
    """Append those pixels of the room that tell; return how many there are now.

    The numbers of the fit and of the lens are of 32 bits. The rule says how near an edge pixels
    tell (px), and among how many flat ones one is taken.
    """
    room, half_px, (beside_px, flat) = view.room, view.frame[2], rule
    _look(room, narrow, cells, f32(beside_px / half_px), flat, turn)
    _overlook(room, cells, half_px)
    return _keep(room, lanes, edges, view.pixels, count)


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
def _edges_at_corners(ink: Array) -> IntArray:
    """Return which edges meet at every corner of cells: 1 above, 2 below, 4 left, 8 right.

    Corner of column i and row j, left of and above cell i, j, stands at i + m j, for ink (m, m).
    """
    cells = len(ink)
    edges = np.full(cells * cells, FLAT)
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
    room: Narrow, narrow: tuple[Narrow, Narrow], cells: int, reach: f32, flat: int, turn: int
) -> None:
    """Write the nearest corner of cells to every pixel, and which edges there would count.

    Args:
        room: The block.
        narrow: The numbers of the fit and of the lens, of 32 bits.
        cells: Along a side of the picture and its quiet zone.
        reach: How near an edge a pixel sees it, half diagonals.
        flat: One of so many flat pixels is taken.
        turn: Which one of them.
    """
    fit, lens = narrow
    straighten(room, lens)
    write_cells(room, fit)
    past = f32(cells - 1)
    for p in range(row.BLOCK):
        u, v = room[row.U + p], room[row.V + p]
        ux, uy, vx, vy = room[row.UX + p], room[row.UY + p], room[row.VX + p], room[row.VY + p]
        corner_u = np.rint(u) if f32(1) <= u <= past else f32(1)
        corner_v = np.rint(v) if f32(1) <= v <= past else f32(1)
        past_u, past_v = u - corner_u, v - corner_v
        near_u = abs(past_u) < reach * np.sqrt(ux * ux + uy * uy)
        near_v = abs(past_v) < reach * np.sqrt(vx * vx + vy * vy)
        meeting = (f32(2) if past_v > f32(0) else f32(1)) if near_u else f32(0)
        meeting += (f32(8) if past_u > f32(0) else f32(4)) if near_v else f32(0)
        meeting = f32(15) if near_u & near_v else meeting
        meeting += f32(FLAT) if (p + turn) & (flat - 1) == 0 else f32(0)
        room[row.CORNER + p] = corner_u + f32(cells) * corner_v
        room[row.MEETING + p] = meeting


@kernel
def _overlook(room: Narrow, cells: int, half_px: float) -> None:
    """Strike out the edges of pixels that lie outside, where the quiet zone is not trusted."""
    low, high, half = f32(QUIET_CELLS), f32(cells - QUIET_CELLS), f32(half_px)
    for p in range(row.BLOCK):
        u, v, down = room[row.U + p], room[row.V + p], room[row.DOWN + p]
        ux, uy, vx, vy = room[row.UX + p], room[row.UY + p], room[row.VX + p], room[row.VY + p]
        trusted_u = trusted_cells(np.sqrt(ux * ux + uy * uy) / half)
        trusted_v = trusted_cells(np.sqrt(vx * vx + vy * vy) / half)
        outside_u, outside_v = max(low - u, u - high), max(low - v, v - high)
        seen = (
            (outside_u < trusted_u) & (outside_v < trusted_v) & (down > f32(0)) & (down < f32(20))
        )
        room[row.MEETING + p] *= f32(1) if seen else f32(0)


@kernel
def _keep(room: Narrow, lanes: int, edges: IntArray, pixels: Narrow, count: int) -> int:
    """Append the pixels of a block that tell; return how many there are now."""
    for p in range(lanes):
        block, at = pixels[count // row.BLOCK], count % row.BLOCK
        block[row.X + at], block[row.Y + at] = room[row.X + p], room[row.Y + p]
        block[row.SEEN + at] = room[row.SEEN + p]
        here = edges[int(room[row.CORNER + p])]
        count += 1 if (here & int(room[row.MEETING + p])) else 0
    return min(count, _MOST_PIXELS)


@kernel
def set_windows(view: View, fit: Array, count: int, all_changes: Array, edges: int) -> None:
    """Write what part of the picture every pixel sees.

    Args:
        view: Whose pixels have been gathered.
        fit: The numbers.
        count: How many pixels.
        all_changes: From `changes`.
        edges: How many edges of each direction a pixel sees.
    """
    room, cells, narrow = view.room, all_changes.shape[3], fit.astype(np.float32)
    flat = all_changes.reshape(4, cells * cells)
    for b in range(-(-count // row.BLOCK)):
        pixel = view.pixels[b]
        for k in range(row.COUNTS):
            room[k] = pixel[k]
        write_cells(room, narrow)
        _set_firsts(pixel, room, edges, cells, count - b * row.BLOCK)
        for j in range(edges + 1):
            for i in range(edges + 1):
                first, kind = i + (edges + 1) * j, 2 * min(j, 1) + min(i, 1)
                shift = (j - 1) * cells + i - 1
                _set_changes(
                    pixel[row.CHANGES + first * row.BLOCK :], pixel, flat[kind], cells, shift
                )


@kernel
def _set_firsts(pixel: Narrow, room: Narrow, edges: int, cells: int, count: int) -> None:
    """Write the first of the edges nearest to pixels; those past the count do not count."""
    before, last = f32(0.5 * (2 - edges)), f32(cells - edges)
    for p in range(row.BLOCK):
        u, v = np.floor(room[row.U + p] + before), np.floor(room[row.V + p] + before)
        pixel[row.FIRST_U + p] = _within(u, last)
        pixel[row.FIRST_V + p] = _within(v, last)
        pixel[row.COUNTS + p] = f32(1) if p < count else f32(0)


@kernel
def _within(edge: f32, last: f32) -> f32:
    """Return an edge between the first and the last one; 1 for what is not a number."""
    edge = edge if edge > f32(1) else f32(1)  # noqa: FURB136 (says what NaN gives)
    return edge if edge < last else last  # noqa: FURB136


@kernel
def _set_changes(changes: Narrow, pixel: Narrow, changed: Array, cells: int, shift: int) -> None:
    """Write the change of ink at one corner of every pixel's window."""
    for p in range(row.BLOCK):
        at = int(pixel[row.FIRST_V + p]) * cells + int(pixel[row.FIRST_U + p])
        changes[p] = changed[at + shift]

"""Which part of the picture every chosen pixel sees: the changes of ink at the corners near it."""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.kernel import Narrow, Whole, f32, kernel


@kernel
def set_windows(pixels: Narrow, count: int, all_changes: Narrow, edges: int) -> None:
    """Write what every pixel sees.

    Args:
        pixels: As `gather` leaves them, see `block`.
        count: How many pixels.
        all_changes: From `changes`.
        edges: How many edges of each direction a pixel sees.
    """
    cells = all_changes.shape[3]
    changes = all_changes.reshape(4, cells * cells)
    corners = np.empty(row.BLOCK, dtype=np.int32)
    for b in range(-(-count // row.BLOCK)):
        _set_firsts(pixels[b], corners, edges, cells, count - b * row.BLOCK)
        for j in range(edges + 1):
            for i in range(edges + 1):
                first, kind = i + (edges + 1) * j, 2 * min(j, 1) + min(i, 1)
                shift = (j - 1) * cells + i - 1
                seen = pixels[b, row.CHANGES + first * row.BLOCK :]
                _look_up(seen, changes[kind], corners, shift)


@kernel
def _set_firsts(pixel: Narrow, corners: Whole, edges: int, cells: int, count: int) -> None:
    """Write the first of the edges nearest to pixels, and the number of the corner where they meet.

    Pixels past the count do not count.
    """
    before, last = f32(0.5 * (2 - edges)), f32(cells - edges)
    for p in range(row.BLOCK):
        u = _within(np.floor(pixel[row.FIRST_U + p] + before), last)
        v = _within(np.floor(pixel[row.FIRST_V + p] + before), last)
        pixel[row.FIRST_U + p], pixel[row.FIRST_V + p] = u, v
        pixel[row.COUNTS + p] = f32(1) if p < count else f32(0)
        corners[p] = np.int32(v * f32(cells) + u)


@kernel
def _within(edge: f32, last: f32) -> f32:
    """Return an edge between the first and the last one; 1 for what is not a number."""
    edge = edge if edge > f32(1) else f32(1)  # noqa: FURB136 (says what NaN gives)
    return edge if edge < last else last  # noqa: FURB136


@kernel
def _look_up(seen: Narrow, changes: Narrow, corners: Whole, shift: int) -> None:
    """Write the change of ink at one corner of every pixel's window."""
    for p in range(row.BLOCK):
        seen[p] = changes[corners[p] + shift]

"""The model's values and derivatives at any places, by the kernels that work on blocks."""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.evaluate import evaluate
from tagmetry.detect.photometric.ink import changes
from tagmetry.detect.photometric.model import bent_place, cells_at
from tagmetry.detect.photometric.values import narrowed
from tagmetry.detect.photometric.windows import set_windows
from tagmetry.geometry import Array

_LARGE_PX = 1e4  # half diagonal: pixels are as good as points
_NO_NOISE_LIMIT = 1e9  # so that all weights are 1


def evaluated(
    fit: Array, ink: Array, places: Array, edges: int, half_px: float = _LARGE_PX
) -> tuple[Array, Array]:
    """Return the grey values of places, (n,), and their derivatives by the fit, (n, 24)."""
    count, narrow = len(places), narrowed(fit, half_px)
    room = row.new_room()
    equations = room[row.EQUATIONS :]
    pixels = np.zeros((-(-count // row.BLOCK), row.READ), dtype=np.float32)
    for k, (x, y) in enumerate(places):
        block, p = pixels[k // row.BLOCK], k % row.BLOCK
        block[row.X + p], block[row.Y + p] = x, y
        bent = bent_place(fit, x, y)
        block[row.FIRST_U + p], block[row.FIRST_V + p], _ = cells_at(fit, *bent)
    set_windows(pixels, count, changes(ink), edges)
    values, by_fit = [], []
    for block in pixels:
        room[: row.READ] = block
        evaluate(room, equations, narrow, edges, _NO_NOISE_LIMIT, len(fit))
        lines = equations.reshape(row.MOST_NUMBERS, row.LANES)[:, : row.BLOCK].astype(np.float64)
        values.append(-lines[0])
        by_fit.append(lines[1 : 1 + len(fit)].T)
    return np.concatenate(values)[:count], np.concatenate(by_fit)[:count]

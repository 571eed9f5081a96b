"""What lies behind the quiet zone: where cells are few blurs wide, it reaches the edges."""

import numpy as np

from tagmetry.detect.photometric.corners import place_of_cells
from tagmetry.detect.photometric.ink import QUIET_CELLS
from tagmetry.detect.photometric.kernel import kernel
from tagmetry.detect.photometric.model import BLACK, BLUR, EXPONENT
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

_REACHES = 5.0  # blurs: wider cells keep what is behind them away
_OUTSIDE_CELLS = 1.8  # where it is looked at


@kernel
def reaches_edges(fit: Array) -> bool:
    """Say whether cells are so few blurs wide that what is behind the quiet zone matters."""
    cell = 1.0 / np.sqrt(abs(fit[0] * fit[4] - fit[1] * fit[3]))
    return bool(cell < _REACHES * np.sqrt(0.5 * (fit[BLUR] + fit[BLUR + 2])))


@kernel
def with_surround(grey: GreyPixels, ink: Array, fit: Array, frame: Array, lens: Array) -> Array:
    """Return the picture with the whiteness found behind each side's quiet zone around it."""
    seen, cells = ink.copy(), len(ink)
    low, high = QUIET_CELLS - _OUTSIDE_CELLS, cells - QUIET_CELLS + _OUTSIDE_CELLS
    for k in range(cells):
        seen[0, k] = _whiteness(grey, fit, frame, lens, k + 0.5, low)
        seen[cells - 1, k] = _whiteness(grey, fit, frame, lens, k + 0.5, high)
    for k in range(1, cells - 1):
        seen[k, 0] = _whiteness(grey, fit, frame, lens, low, k + 0.5)
        seen[k, cells - 1] = _whiteness(grey, fit, frame, lens, high, k + 0.5)
    return seen


@kernel
def _whiteness(
    grey: GreyPixels, fit: Array, frame: Array, lens: Array, u: float, v: float
) -> float:
    """Return how white the pixel at a cell coordinate is; 1, as paper, outside the image."""
    x, y = place_of_cells(fit, lens, u, v)
    x, y = frame[0] + frame[2] * x, frame[1] + frame[2] * y
    if not (0 <= x < grey.shape[1] - 0.5 and 0 <= y < grey.shape[0] - 0.5):
        return 1.0
    exponent = np.exp(fit[EXPONENT])
    black, paper = fit[BLACK] ** exponent, fit[BLACK + 1] ** exponent
    light = (grey[int(y + 0.5), int(x + 0.5)] / 255.0) ** exponent
    return float(min(max((light - black) / (paper - black), -0.5), 1.5))

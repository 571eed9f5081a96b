"""The marker's printed picture, blurred: how white is it at one place?

In units of cells the picture is a sum of steps, one per edge between cells of different colour, so
blurred by a Gaussian it is a sum of products of the Gaussian's integral,

    white(u, v) = sum over cells of ink * Phi-window(u) * Phi-window(v).

Where the view is oblique the blur is correlated between u and v; this bends what happens where
edges cross, and is followed to the second order in the correlation (Mehler's series).
"""

import numpy as np
from scipy.special import ndtr

from tagmetry.detect.photometric.kernel import kernel
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

QUIET_CELLS = 2  # rings of white that are put around the picture
REACH = 3.6  # blurs beyond which an edge is not seen
MOST_EDGES = 16  # of one direction, within reach
_STEPS = 256  # of the table, per blur
_AT = np.arange(-4 * _STEPS, 4 * _STEPS + 2) / _STEPS
_STEP = ndtr(_AT)
_BELL = np.exp(-0.5 * _AT**2) / np.sqrt(2 * np.pi)


def printed(picture: BoolArray) -> Array:
    """Return a marker's cells, 1 is white, with white around them."""
    return np.pad(np.asarray(picture, dtype=np.float64), QUIET_CELLS, constant_values=1.0)


@kernel
def _edges(u: float, blur: float, count: int, edges: Array, at: int) -> tuple[int, int]:
    """Return the first and last cell seen from u; the edges' steps and bells are written."""
    first = min(max(int(np.floor(u - REACH * blur)), 0), count - 1)
    last = min(max(int(np.floor(u + REACH * blur)), 0), count - 1, first + MOST_EDGES)
    for k in range(first + 1, last + 1):
        z = min(max((u - k) / blur, -4.0), 4.0)
        place = (z + 4.0) * _STEPS
        left = int(place)
        share = place - left
        edges[at, k - first] = _STEP[left] + share * (_STEP[left + 1] - _STEP[left])
        edges[at + 1, k - first] = _BELL[left] + share * (_BELL[left + 1] - _BELL[left])
    return first, last


@kernel
def _along(
    ink: Array, row: int, first: int, last: int, u: float, blur: float, edges: Array
) -> tuple[float, float, float]:
    """Return one row of cells at u: white, its slope times the blur, its bend times blur^2."""
    white, slope, bend = ink[row, first], 0.0, 0.0
    for k in range(first + 1, last + 1):
        change = ink[row, k] - ink[row, k - 1]
        if change != 0.0:
            white += change * edges[0, k - first]
            slope += change * edges[1, k - first]
            bend -= change * edges[1, k - first] * (u - k) / blur
    return white, slope, bend


@kernel
def blurred(
    ink: Array,
    u: float,
    v: float,
    blur_u: float,
    blur_v: float,
    correlation: float,
    edges: Array,
) -> tuple[float, float, float, float, float, float]:
    """Return how white the blurred picture is at (u, v), and its derivatives.

    Args:
        ink: From `printed`, shape (m, m).
        u: To the right, cells from the left edge of `ink`.
        v: Downward, cells from its top edge.
        blur_u: Standard deviation of the blur along u, cells.
        blur_v: Along v.
        correlation: Of the blur along u and v.
        edges: Room for the work, shape (4, MOST_EDGES + 1).

    Returns:
        The whiteness 0 to 1, and by u, v, blur_u, blur_v (per cell) and the correlation; what the
        correlation adds is left out of the first four.
    """
    first_u, last_u = _edges(u, blur_u, ink.shape[1], edges, 0)
    first_v, last_v = _edges(v, blur_v, ink.shape[0], edges, 2)
    above, above_slope, above_bend = _along(ink, first_v, first_u, last_u, u, blur_u, edges)
    white, by_u, by_blur_u, by_v, by_blur_v = above, above_slope, above_bend, 0.0, 0.0
    by_correlation = 0.0
    for row in range(first_v + 1, last_v + 1):
        here, slope, bend = _along(ink, row, first_u, last_u, u, blur_u, edges)
        step, bell = edges[2, row - first_v], edges[3, row - first_v]
        z = (v - row) / blur_v
        twist = z * (bend - above_bend) * correlation
        white += (here - above) * step + correlation * (slope - above_slope - 0.5 * twist) * bell
        by_correlation += (slope - above_slope - twist) * bell
        by_u += (slope - above_slope) * step
        by_blur_u += (bend - above_bend) * step
        by_v += (here - above) * bell
        by_blur_v -= (here - above) * bell * z
        above, above_slope, above_bend = here, slope, bend
    return (
        white,
        by_u / blur_u,
        by_v / blur_v,
        by_blur_u / blur_u,
        by_blur_v / blur_v,
        by_correlation,
    )

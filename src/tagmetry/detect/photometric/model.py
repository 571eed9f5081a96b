"""What a camera reports of a marker: the model that is fitted, as a page.

A pixel at the place x, y (from the marker's middle, in units of its half diagonal; straightened, if
the lens is known) shows

    value = 255 * light^(1 / exponent)
    light = black(x, y) + contrast(x, y) * white(u, v; blur) + fall |x|^2 (the same in the middle)
    (u, v) = G (x + bow)           cells of the printed picture

The numbers of the fit, in this order:

    0..7    G, the homography to cells, its last entry 1
    8, 9    values of black and white in the middle, as a share of 255
    10..13  slopes of light along x and y: of black, of the contrast
    14      logarithm of the exponent
    15..17  the blur's covariance xx, xy, yy, with the pixel's own square in it
    18      fall: the share of light that comes in by the half diagonal, as a lens darkens
    19..23  bows: what |x|^2 - 1 moves to the right and down; what x^2 - y^2 does, with -2 x y and
            2 x y in the other direction; what |x|^2 - 1 moves outward
"""

import numpy as np

from tagmetry.detect.photometric.kernel import Narrow, f32, kernel
from tagmetry.geometry import Array

BLACK, SLOPES, EXPONENT, BLUR, FALL, BOWS = 8, 10, 14, 15, 18, 19
COUNT = 24
LOOK_COUNT = BOWS - BLACK
LOOKS = slice(BLACK, BOWS)  # how light, camera and blur make the picture look


@kernel
def cells_at(fit: Array, x: float, y: float) -> tuple[float, float, float]:
    """Return the cell coordinates u, v of a place, and the denominator of the homography."""
    down = fit[6] * x + fit[7] * y + f32(1)
    u = (fit[0] * x + fit[1] * y + fit[2]) / down
    return u, (fit[3] * x + fit[4] * y + fit[5]) / down, down


@kernel
def bent_place(fit: Array | Narrow, x: float, y: float) -> tuple[float, float]:
    """Return where a place would be if edges did not bow."""
    far, saddle, twist = x * x + y * y - f32(1), x * x - y * y, f32(2) * x * y
    a, b, c, d, barrel = fit[BOWS], fit[BOWS + 1], fit[BOWS + 2], fit[BOWS + 3], fit[BOWS + 4]
    bent_x = x + far * (a + barrel * x) + c * saddle + d * twist
    return bent_x, y + far * (b + barrel * y) - c * twist + d * saddle


@kernel
def cell_px(fit: Array, half_px: float) -> float:
    """Return the size of a cell in the marker's middle, pixels."""
    return float(half_px / np.sqrt(abs(fit[0] * fit[4] - fit[1] * fit[3])))


@kernel
def blur_in_cells(fit: Array) -> tuple[float, float]:
    """Return the blur in cells, and cells per half diagonal, along the finer direction, mid-way."""
    ux, uy = fit[0] - fit[2] * fit[6], fit[1] - fit[2] * fit[7]
    vx, vy = fit[3] - fit[5] * fit[6], fit[4] - fit[5] * fit[7]
    xx, xy, yy = fit[BLUR], fit[BLUR + 1], fit[BLUR + 2]
    blur2_u = xx * ux * ux + 2 * xy * ux * uy + yy * uy * uy
    blur2_v = xx * vx * vx + 2 * xy * vx * vy + yy * vy * vy
    fineness2 = max(ux * ux + uy * uy, vx * vx + vy * vy)
    return np.sqrt(max(blur2_u, blur2_v)), np.sqrt(fineness2)

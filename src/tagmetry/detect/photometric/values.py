"""From the whiteness of pixels to grey values: light, exponent, residuals and their weights."""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.elementary import exponential, logarithm
from tagmetry.detect.photometric.kernel import Narrow, f32, kernel
from tagmetry.detect.photometric.model import BLACK, COUNT, EXPONENT, FALL, SLOPES
from tagmetry.geometry import Array

_LEAST_LIGHT = f32(1e-7)
_FULL = f32(255.0)
SQUARE = COUNT
_ROOT, _LIGHT, _BY_VALUE, _BEND, _ALL = (COUNT + k for k in (1, 2, 4, 6, 8))
_CUMULANT = -1 / 120  # the fourth one of a line of length 1
_FAR = 4.0  # residuals beyond so many deviations count less


@kernel
def narrowed(fit: Array, half_px: float) -> Narrow:
    """Return the numbers of a fit with 32 bits, and after them what is the same for all pixels.

    These are how square a pixel is, by the marker's half diagonal; one over the exponent; black's
    and paper's light, their derivatives by black's and paper's value, and by the logarithm of the
    exponent.
    """
    exponent = np.exp(fit[EXPONENT])
    narrow = np.empty(_ALL, dtype=np.float32)
    narrow[:COUNT] = fit
    narrow[SQUARE] = -_CUMULANT / 24 / half_px**4
    narrow[_ROOT] = 1.0 / exponent
    for k in range(2):
        light = fit[BLACK + k] ** exponent
        narrow[_LIGHT + k] = light
        narrow[_BY_VALUE + k] = exponent * light / fit[BLACK + k]
        narrow[_BEND + k] = light * np.log(light)
    return narrow


@kernel
def write_values(room: Narrow, equations: Narrow, fit: Narrow, noise: float) -> None:
    """Write residuals and derivatives by levels and exponent, weighted; `fit` is from `narrowed`.

    Weights are Cauchy's; a pixel that is clipped, where the model is too, says no more than that.
    """
    root, sharp = fit[_ROOT], f32(1 / (_FAR * noise))
    black, paper = fit[_LIGHT], fit[_LIGHT + 1]
    by_black, by_paper = fit[_BY_VALUE], fit[_BY_VALUE + 1]
    bend_black, bend_paper = fit[_BEND], fit[_BEND + 1]
    first, falls = row.J + BLACK * row.LANES, row.J + FALL * row.LANES
    for p in range(row.BLOCK):
        x, y, white = room[row.X + p], room[row.Y + p], room[row.WHITE + p]
        far2, even = x * x + y * y, black + (paper - black) * white
        share = f32(1) + fit[FALL] * far2
        contrast = share * (paper - black) + fit[SLOPES + 2] * x + fit[SLOPES + 3] * y
        light = share * black + fit[SLOPES] * x + fit[SLOPES + 1] * y + contrast * white
        light = max(light, _LEAST_LIGHT)
        log_light = logarithm(light)
        value = _FULL * exponential(root * log_light)
        residual = room[row.SEEN + p] - value
        clipped = (room[row.SEEN + p] >= _FULL) & (value > _FULL)
        counts = f32(0) if clipped else room[row.COUNTS + p]
        far = sharp * residual
        weight = np.sqrt(counts / (f32(1) + far * far))
        by_light = weight * root * value / light
        room[row.SIZE + p] = abs(residual)
        equations[row.RESIDUAL + p] = weight * residual
        room[row.BY_WHITE + p] = by_light * contrast
        equations[first + p] = by_light * share * by_black * (f32(1) - white)
        equations[first + row.LANES + p] = by_light * share * by_paper * white
        equations[first + 2 * row.LANES + p] = by_light * x
        equations[first + 3 * row.LANES + p] = by_light * y
        equations[first + 4 * row.LANES + p] = by_light * x * white
        equations[first + 5 * row.LANES + p] = by_light * y * white
        equations[falls + p] = by_light * far2 * even
        equations[first + 6 * row.LANES + p] = by_light * (
            share * (bend_black * (f32(1) - white) + bend_paper * white) - light * log_light
        )

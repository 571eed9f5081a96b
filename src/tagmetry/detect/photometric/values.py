"""From the whiteness of pixels to grey values: light, exponent, residuals and their weights."""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.elementary import exponential, logarithm
from tagmetry.detect.photometric.kernel import Narrow, f32, kernel
from tagmetry.detect.photometric.model import BLACK, EXPONENT, SLOPES

_LEAST_LIGHT = f32(1e-7)
_FULL = f32(255.0)
_FAR = 4.0  # residuals beyond so many deviations count less


@kernel
def write_values(room: Narrow, fit: Narrow, noise: float) -> None:
    """Write residuals and derivatives by levels and exponent; weigh all derivatives.

    Weights are Cauchy's; a pixel that is clipped, where the model is too, says no more than that.
    """
    exponent = np.exp(fit[EXPONENT])
    root, sharp = f32(1) / exponent, f32(1 / (_FAR * noise))
    black, paper = fit[BLACK] ** exponent, fit[BLACK + 1] ** exponent
    by_black, by_paper = exponent * black / fit[BLACK], exponent * paper / fit[BLACK + 1]
    bend_black, bend_paper = black * np.log(black), paper * np.log(paper)
    first = row.J + BLACK * row.BLOCK
    for p in range(row.BLOCK):
        x, y, white = room[row.X + p], room[row.Y + p], room[row.WHITE + p]
        contrast = paper - black + fit[SLOPES + 2] * x + fit[SLOPES + 3] * y
        light = black + fit[SLOPES] * x + fit[SLOPES + 1] * y + contrast * white
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
        room[row.RESIDUAL + p] = weight * residual
        room[row.BY_WHITE + p] = by_light * contrast
        room[first + p] = by_light * by_black * (f32(1) - white)
        room[first + row.BLOCK + p] = by_light * by_paper * white
        room[first + 2 * row.BLOCK + p] = by_light * x
        room[first + 3 * row.BLOCK + p] = by_light * y
        room[first + 4 * row.BLOCK + p] = by_light * x * white
        room[first + 5 * row.BLOCK + p] = by_light * y * white
        room[first + 6 * row.BLOCK + p] = by_light * (
            bend_black * (f32(1) - white) + bend_paper * white - light * log_light
        )

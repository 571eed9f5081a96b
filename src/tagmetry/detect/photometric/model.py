"""What a camera reports of a marker: the model that is fitted, as a page.

A pixel at the place x, y (from the marker's middle, in units of its half diagonal; straightened, if
the lens is known) shows

    value = 255 * light^(1 / exponent)
    light = black(x, y) + contrast(x, y) * white(u, v; blur)
    (u, v) = G (x + bow)           cells of the printed picture

The numbers of the fit, in this order:

    0..7    G, the homography to cells, its last entry 1
    8, 9    values of black and white in the middle, as a share of 255
    10..13  slopes of light along x and y: of black, of the contrast
    14      logarithm of the exponent
    15..17  the blur's covariance xx, xy, yy, with the pixel's own square in it
    18..22  bows: what |x|^2 - 1 moves to the right and down; what x^2 - y^2 does, with -2 x y and
            2 x y in the other direction; what |x|^2 - 1 moves outward
"""

import numpy as np

from tagmetry.detect.photometric.ink import blurred
from tagmetry.detect.photometric.kernel import kernel
from tagmetry.geometry import Array

BLACK, SLOPES, EXPONENT, BLUR, BOWS = 8, 10, 14, 15, 18
COUNT = 23
_LEAST_LIGHT = 1e-7


@kernel
def cells_at(fit: Array, x: float, y: float) -> tuple[float, float, float]:
    """Return the cell coordinates u, v of a place, and the denominator of the homography."""
    down = fit[6] * x + fit[7] * y + 1.0
    u = (fit[0] * x + fit[1] * y + fit[2]) / down
    return u, (fit[3] * x + fit[4] * y + fit[5]) / down, down


@kernel
def bent_place(fit: Array, x: float, y: float) -> tuple[float, float]:
    """Return where a place would be if edges did not bow."""
    far, saddle, twist = x * x + y * y - 1.0, x * x - y * y, 2 * x * y
    a, b, c, d, barrel = fit[BOWS], fit[BOWS + 1], fit[BOWS + 2], fit[BOWS + 3], fit[BOWS + 4]
    bent_x = x + far * (a + barrel * x) + c * saddle + d * twist
    return bent_x, y + far * (b + barrel * y) - c * twist + d * saddle


@kernel
def value_at(
    fit: Array,
    levels: tuple[float, float, float, float, float],
    ink: Array,
    x: float,
    y: float,
    edges: Array,
    by_fit: Array,
) -> float:
    """Return the modelled grey value of a pixel, and write its derivatives by the fit.

    Args:
        fit: The numbers, shape (23,).
        levels: From `levels_of`.
        ink: From `printed`.
        x: Place of the pixel.
        y: Downward.
        edges: Room for the work, see `blurred`.
        by_fit: Derivatives, written, shape (23,).
    """
    bent_x, bent_y = bent_place(fit, x, y)
    u, v, down = cells_at(fit, bent_x, bent_y)
    ux, uy = (fit[0] - u * fit[6]) / down, (fit[1] - u * fit[7]) / down
    vx, vy = (fit[3] - v * fit[6]) / down, (fit[4] - v * fit[7]) / down
    xx, xy, yy = fit[BLUR], fit[BLUR + 1], fit[BLUR + 2]
    blur_u = np.sqrt(xx * ux * ux + 2 * xy * ux * uy + yy * uy * uy)
    blur_v = np.sqrt(xx * vx * vx + 2 * xy * vx * vy + yy * vy * vy)
    mixed = xx * ux * vx + xy * (ux * vy + uy * vx) + yy * uy * vy
    both = blur_u * blur_v
    white, by_u, by_v, by_blur_u, by_blur_v, by_mixed = blurred(
        ink, u, v, blur_u, blur_v, mixed / both, edges
    )
    by_blur_u -= by_mixed * mixed / (both * blur_u)
    by_blur_v -= by_mixed * mixed / (both * blur_v)
    value, by_white = _value(fit, levels, x, y, white, by_fit)
    by_u, by_v = by_white * by_u, by_white * by_v
    by_blur_u, by_blur_v = by_white * by_blur_u / blur_u, by_white * by_blur_v / blur_v
    by_ux, by_uy = by_blur_u * (xx * ux + xy * uy), by_blur_u * (xy * ux + yy * uy)
    by_vx, by_vy = by_blur_v * (xx * vx + xy * vy), by_blur_v * (xy * vx + yy * vy)
    by_u -= (by_ux * fit[6] + by_uy * fit[7]) / down
    by_v -= (by_vx * fit[6] + by_vy * fit[7]) / down
    _by_place(by_fit, bent_x, bent_y, by_u / down, by_v / down, u, v)
    by_fit[0], by_fit[1] = by_fit[0] + by_ux / down, by_fit[1] + by_uy / down
    by_fit[3], by_fit[4] = by_fit[3] + by_vx / down, by_fit[4] + by_vy / down
    by_down = (by_ux * ux + by_uy * uy + by_vx * vx + by_vy * vy) / down
    by_fit[6] -= (u * by_ux + v * by_vx) / down + bent_x * by_down
    by_fit[7] -= (u * by_uy + v * by_vy) / down + bent_y * by_down
    by_mixed *= by_white / both
    by_fit[BLUR] = 0.5 * (by_blur_u * ux * ux + by_blur_v * vx * vx) + by_mixed * ux * vx
    by_fit[BLUR + 1] = by_blur_u * ux * uy + by_blur_v * vx * vy + by_mixed * (ux * vy + uy * vx)
    by_fit[BLUR + 2] = 0.5 * (by_blur_u * uy * uy + by_blur_v * vy * vy) + by_mixed * uy * vy
    by_x, by_y = by_u * ux + by_v * vx, by_u * uy + by_v * vy
    far, saddle, twist = x * x + y * y - 1.0, x * x - y * y, 2 * x * y
    by_fit[BOWS], by_fit[BOWS + 1] = far * by_x, far * by_y
    by_fit[BOWS + 2] = saddle * by_x - twist * by_y
    by_fit[BOWS + 3] = twist * by_x + saddle * by_y
    by_fit[BOWS + 4] = far * (by_x * x + by_y * y)
    return value


@kernel
def levels_of(fit: Array) -> tuple[float, float, float, float, float]:
    """Return the exponent, the light of black and of white, and the logarithms of their values."""
    exponent = np.exp(fit[EXPONENT])
    log_black, log_white = np.log(fit[BLACK]), np.log(fit[BLACK + 1])
    return (
        exponent,
        np.exp(exponent * log_black),
        np.exp(exponent * log_white),
        log_black,
        log_white,
    )


@kernel
def _value(
    fit: Array,
    levels: tuple[float, float, float, float, float],
    x: float,
    y: float,
    white: float,
    by_fit: Array,
) -> tuple[float, float]:
    """Return the value of a place that is so white, and its derivative; by the levels, written."""
    exponent, black, paper, log_black, log_white = levels
    slope_black = fit[SLOPES] * x + fit[SLOPES + 1] * y
    slope_contrast = fit[SLOPES + 2] * x + fit[SLOPES + 3] * y
    contrast = paper - black + slope_contrast
    light = max(black + slope_black + contrast * white, _LEAST_LIGHT)
    log_light = np.log(light)
    value = 255.0 * np.exp(log_light / exponent)
    by_light = value / (exponent * light)
    by_fit[BLACK] = by_light * exponent * black / fit[BLACK] * (1 - white)
    by_fit[BLACK + 1] = by_light * exponent * paper / fit[BLACK + 1] * white
    by_fit[SLOPES], by_fit[SLOPES + 1] = by_light * x, by_light * y
    by_fit[SLOPES + 2], by_fit[SLOPES + 3] = by_light * x * white, by_light * y * white
    by_fit[EXPONENT] = by_light * (
        exponent * (black * log_black * (1 - white) + paper * log_white * white) - light * log_light
    )
    return value, by_light * contrast


@kernel
def _by_place(
    by_fit: Array, x: float, y: float, by_u: float, by_v: float, u: float, v: float
) -> None:
    """Write the derivatives by the homography; those by u and v are over its denominator."""
    by_fit[0], by_fit[1], by_fit[2] = by_u * x, by_u * y, by_u
    by_fit[3], by_fit[4], by_fit[5] = by_v * x, by_v * y, by_v
    back = -(by_u * u + by_v * v)
    by_fit[6], by_fit[7] = back * x, back * y

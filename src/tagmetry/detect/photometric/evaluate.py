"""The model's values of one block of pixels, and their derivatives.

where each pixel lies in cells -> how white the blurred picture is there (whiteness) -> what value
that gives (values) -> how it changes with every number of the fit.

That the blur in cells changes a little with the place is left out of the derivatives; the values
have it.
"""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.kernel import Narrow, f32, kernel
from tagmetry.detect.photometric.model import BLUR, BOWS, SLOPES, bent_place
from tagmetry.detect.photometric.values import SQUARE, write_values
from tagmetry.detect.photometric.whiteness import write_whiteness


@kernel
def evaluate(
    room: Narrow, equations: Narrow, fit: Narrow, edges: int, noise: float, count: int
) -> None:
    """Write the weighted residuals of a block, and their derivatives by `count` numbers.

    Args:
        room: The block, see `block`.
        equations: Written, from the block's first one on.
        fit: The numbers, from `narrowed`.
        edges: How many edges of each direction a pixel sees.
        noise: Grey values; residuals far beyond count less.
        count: 10, 18, 19 or 24.
    """
    write_cells(room, fit)
    _write_blurs(room, fit)
    write_whiteness(room, edges)
    write_values(room, equations, fit, noise)
    _write_by_homography(room, equations)
    if count > SLOPES:
        _write_by_blur(room, equations)
    if count > BOWS:
        _write_by_bows(room, equations)


@kernel
def write_cells(room: Narrow, fit: Narrow) -> None:
    """Write where pixels lie in cells, and the slopes of that."""
    for p in range(row.BLOCK):
        x, y = bent_place(fit, room[row.X + p], room[row.Y + p])
        down = f32(1) / (fit[6] * x + fit[7] * y + f32(1))
        u = (fit[0] * x + fit[1] * y + fit[2]) * down
        v = (fit[3] * x + fit[4] * y + fit[5]) * down
        room[row.BENT_X + p], room[row.BENT_Y + p] = x, y
        room[row.U + p], room[row.V + p], room[row.DOWN + p] = u, v, down
        room[row.UX + p], room[row.UY + p] = (
            (fit[0] - u * fit[6]) * down,
            (fit[1] - u * fit[7]) * down,
        )
        room[row.VX + p], room[row.VY + p] = (
            (fit[3] - v * fit[6]) * down,
            (fit[4] - v * fit[7]) * down,
        )


@kernel
def _write_blurs(room: Narrow, fit: Narrow) -> None:
    """Write one over the blur in cells, along u and along v, and how these are correlated.

    Write also how square it is: the part of its fourth cumulant that the pixel's own square has.
    """
    xx, xy, yy, square = fit[BLUR], fit[BLUR + 1], fit[BLUR + 2], fit[SQUARE]
    for p in range(row.BLOCK):
        ux, uy, vx, vy = room[row.UX + p], room[row.UY + p], room[row.VX + p], room[row.VY + p]
        sharp_u = f32(1) / np.sqrt(xx * ux * ux + f32(2) * xy * ux * uy + yy * uy * uy)
        sharp_v = f32(1) / np.sqrt(xx * vx * vx + f32(2) * xy * vx * vy + yy * vy * vy)
        mixed = xx * ux * vx + xy * (ux * vy + uy * vx) + yy * uy * vy
        room[row.SHARP_U + p], room[row.SHARP_V + p] = sharp_u, sharp_v
        room[row.CORRELATION + p] = mixed * sharp_u * sharp_v
        across_u, along_u = (ux * sharp_u) ** 2, (uy * sharp_u) ** 2
        across_v, along_v = (vx * sharp_v) ** 2, (vy * sharp_v) ** 2
        room[row.SQUARE_U + p] = square * (across_u * across_u + along_u * along_u)
        room[row.SQUARE_V + p] = square * (across_v * across_v + along_v * along_v)


@kernel
def _write_by_homography(room: Narrow, equations: Narrow) -> None:
    """Write derivatives by the homography; leave the slopes of the weighted value per cell."""
    first = row.J
    for p in range(row.BLOCK):
        x, y, down = room[row.BENT_X + p], room[row.BENT_Y + p], room[row.DOWN + p]
        by_u = room[row.BY_WHITE + p] * room[row.SHARP_U + p] * room[row.BY_U + p]
        by_v = room[row.BY_WHITE + p] * room[row.SHARP_V + p] * room[row.BY_V + p]
        room[row.BY_U + p], room[row.BY_V + p] = by_u, by_v
        by_u, by_v = down * by_u, down * by_v
        back = -(by_u * room[row.U + p] + by_v * room[row.V + p])
        equations[first + p] = by_u * x
        equations[first + row.LANES + p] = by_u * y
        equations[first + 2 * row.LANES + p] = by_u
        equations[first + 3 * row.LANES + p] = by_v * x
        equations[first + 4 * row.LANES + p] = by_v * y
        equations[first + 5 * row.LANES + p] = by_v
        equations[first + 6 * row.LANES + p] = back * x
        equations[first + 7 * row.LANES + p] = back * y


@kernel
def _write_by_blur(room: Narrow, equations: Narrow) -> None:
    first = row.J + BLUR * row.LANES
    for p in range(row.BLOCK):
        ux, uy, vx, vy = room[row.UX + p], room[row.UY + p], room[row.VX + p], room[row.VY + p]
        sharp_u, sharp_v = room[row.SHARP_U + p], room[row.SHARP_V + p]
        by_white = room[row.BY_WHITE + p]
        turning = room[row.BY_CORRELATION + p]
        lost = turning * room[row.CORRELATION + p]
        by_uu = f32(0.5) * by_white * sharp_u * sharp_u * (room[row.BY_BLUR_U + p] - lost)
        by_vv = f32(0.5) * by_white * sharp_v * sharp_v * (room[row.BY_BLUR_V + p] - lost)
        by_uv = by_white * turning * sharp_u * sharp_v
        equations[first + p] = by_uu * ux * ux + by_vv * vx * vx + by_uv * ux * vx
        equations[first + row.LANES + p] = f32(2) * (by_uu * ux * uy + by_vv * vx * vy) + by_uv * (
            ux * vy + uy * vx
        )
        equations[first + 2 * row.LANES + p] = by_uu * uy * uy + by_vv * vy * vy + by_uv * uy * vy


@kernel
def _write_by_bows(room: Narrow, equations: Narrow) -> None:
    first = row.J + BOWS * row.LANES
    for p in range(row.BLOCK):
        x, y, by_u, by_v = room[row.X + p], room[row.Y + p], room[row.BY_U + p], room[row.BY_V + p]
        by_x = by_u * room[row.UX + p] + by_v * room[row.VX + p]
        by_y = by_u * room[row.UY + p] + by_v * room[row.VY + p]
        far, saddle, twist = x * x + y * y - f32(1), x * x - y * y, f32(2) * x * y
        equations[first + p] = far * by_x
        equations[first + row.LANES + p] = far * by_y
        equations[first + 2 * row.LANES + p] = saddle * by_x - twist * by_y
        equations[first + 3 * row.LANES + p] = twist * by_x + saddle * by_y
        equations[first + 4 * row.LANES + p] = far * (by_x * x + by_y * y)

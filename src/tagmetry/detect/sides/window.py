"""The raw pixels around sides, each pixel once, with its place relative to the side."""

from dataclasses import dataclass

import numpy as np

from tagmetry.detect.sides.sides import SAG_AT, Sides
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_CORNER_GAP_PX = 2.0
_COLUMNS = 96  # most pixels along a side that are looked at


@dataclass(frozen=True)
class Window:
    """The pixels around s sides, m each.

    Attributes:
        values: Grey values, shape (s, m).
        distance_px: Distance outside the first guess, shape (s, m).
        u: Place along the side, -1 to 1, shape (s, m).
        arch: u^2 - 1, how a bow is spread along the side; 0 on sides too short to tell, shape
            (s, m).
        weight: 1 for pixels to use, 0 for the others, shape (s, m).
    """

    values: Array
    distance_px: Array
    u: Array
    arch: Array
    weight: Array


def gather(grey: GreyPixels, sides: Sides) -> Window:
    """Take whole pixels, each once: columns across a level side, rows across a steep one."""
    height_px, width_px = grey.shape
    steep = np.abs(sides.along[:, 1]) > np.abs(sides.along[:, 0])
    rate = np.abs(np.where(steep, sides.along[:, 1], sides.along[:, 0]))
    steps = np.clip(np.ceil(2 * sides.half_px * rate).astype(int), 1, _COLUMNS)
    column = np.arange(min(int(steps.max(initial=1)), _COLUMNS))
    u = (2 * column[None, :] + 1) / steps[:, None] - 1
    guess = sides.middle[:, None] + (u * sides.half_px[:, None])[..., None] * sides.along[:, None]
    across = np.arange(-8.0, 9.0)
    grid = np.rint(guess)[:, :, None, :] + _across_offsets(steep, across)[:, None]
    grid = grid.reshape(len(steep), -1, 2)
    relative = grid - sides.middle[:, None]
    place = (relative * sides.along[:, None]).sum(axis=2) / sides.half_px[:, None]
    distance = (relative * sides.outward[:, None]).sum(axis=2) - _bow(sides.sag_px, place)
    usable = np.repeat(column[None, :] < steps[:, None], len(across), axis=1)
    usable &= np.abs(distance) <= sides.reach_px[:, None]
    gap = np.minimum(_CORNER_GAP_PX / sides.half_px, 0.3)[:, None]
    usable &= np.abs(place) <= 1 - gap
    usable &= (grid >= 0).all(axis=2) & (grid <= [width_px - 1, height_px - 1]).all(axis=2)
    x, y = np.clip(grid, 0, [width_px - 1, height_px - 1]).astype(np.intp).transpose(2, 0, 1)
    arch = np.where(sides.may_bow[:, None], place**2 - 1, 0.0)
    values = np.asarray(grey[y, x], dtype=np.float64)
    return Window(values, distance, place, arch, usable.astype(float))


def _across_offsets(steep: BoolArray, across: Array) -> Array:
    zero = np.zeros_like(across)
    level = np.stack([zero, across], axis=1)
    return np.where(steep[:, None, None], level[:, ::-1], level)


def _bow(sag_px: Array, u: Array) -> Array:
    """Interpolate the sag along the sides, shape (s, m)."""
    steps = len(SAG_AT) - 1
    place = (np.clip(u, -1, 1) + 1) * steps / 2
    left = np.minimum(place.astype(int), steps - 1)
    share = place - left
    row = np.arange(len(sag_px))[:, None]
    return np.asarray(sag_px[row, left] * (1 - share) + sag_px[row, left + 1] * share)

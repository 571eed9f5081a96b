"""Dark or bright squares of any size: looks at the image itself, at half and at double its scale.

Half the scale halves the noise and costs a quarter: large markers are found there. Small ones need
every pixel, the smallest are seen better between the pixels. Each scale looks with low, middle and
high levels of dark: borders that touch dim clutter need a low one, faint borders a high one. A
glance does with the middle level, which finds almost all markers that stand alone, and with what
tells of boards whose markers touch each other.
"""

from dataclasses import dataclass
from functools import partial

import cv2
import numpy as np

from tagmetry.detect.segment.distinct import distinct
from tagmetry.detect.segment.look import Look, dark_squares
from tagmetry.detect.segment.tiles import Tiles
from tagmetry.detect.workers import at_once
from tagmetry.geometry.arrays import Array, BoolArray, GreyPixels

_FULL_BELOW_PX = 32.0  # the full image is looked at where sides may be shorter than this
DOUBLE_BELOW_PX = 10.0
_LEAST_IMAGE_PX = 8
_SHARED_FROM_PIXELS = 500_000  # smaller images take less time than waking a thread is worth
_SLACK = 0.9  # blur rounds corners off, so that squares look smaller at first
_LEVELS = Look(0.35), Look(0.5, thinned=True), Look(0.7)
_LEVELS_AT_DOUBLE = Look(0.35), Look(0.5), Look(0.7)
_GLANCE = Look(0.5, thinned=True, step_share=0.55)
_GLANCE_AT_SMALL = Look(0.5, step_share=0.55, most_px=48.0)
_GLANCE_AT_FAINT = Look(0.7, step_share=0.55, most_px=48.0)
_Plan = dict[float, tuple[Look, ...]]  # the looks at each scale
TURNS = 4  # of looks that are taken one after another in images of a video


@dataclass(frozen=True, eq=False)
class Squares:
    """Outlines with four sides; the same square again where several looks saw it.

    Attributes:
        corners_px: Clockwise as seen, pixel centres at integers, shape (n, 4, 2).
        is_bright: Whether the inside is brighter than the outside, shape (n,).
    """

    corners_px: Array
    is_bright: BoolArray

    def moved(self, right_px: int, down_px: int) -> "Squares":
        """Return them in an image that this one was cut out of."""
        return Squares(self.corners_px + np.array([right_px, down_px]), self.is_bright)


def squares(grey: GreyPixels, min_side_px: float, *, bright: bool) -> Squares:
    """Return outlines with four sides; squares that two looks saw differently are there twice.

    Args:
        grey: 8-bit image.
        min_side_px: Sides shorter than this are passed over.
        bright: Bright squares on dark as well.
    """
    return _both(grey, min_side_px, _plan(min_side_px), bright)


def squares_at_a_glance(grey: GreyPixels, min_side_px: float, *, bright: bool) -> Squares:
    """Return most of what `squares` returns, in a fraction of its time."""
    return _both(grey, min_side_px, _glance(min_side_px), bright)


def squares_in_turn(
    grey: GreyPixels, min_side_px: float, turn: int, *, bright: bool, small: bool = False
) -> Squares:
    """Return what one turn of looks finds: at a glance, then those it leaves out, and so on.

    Every turn finds dark squares of clear contrast that stand alone.

    Args:
        grey: 8-bit image.
        min_side_px: Sides shorter than this are passed over.
        turn: Which turn, 0 to TURNS - 1.
        bright: Bright squares on dark as well.
        small: Only sides of up to 32 px are wanted: they need no look at half the scale.
    """
    plan = _glance(min_side_px) if turn == 0 else _turn(min_side_px, turn)
    if small and 1.0 in plan:
        del plan[0.5]
    return _both(grey, min_side_px, plan, bright)


def _glance(min_side_px: float) -> _Plan:
    plan: _Plan = {0.5: (_GLANCE,), 1.0: (_GLANCE_AT_SMALL,)}
    if min_side_px >= _FULL_BELOW_PX:
        del plan[1.0]
    elif min_side_px < DOUBLE_BELOW_PX:
        plan = {scale: (*looks, _GLANCE_AT_FAINT) for scale, looks in plan.items()}
    return plan


def _turn(min_side_px: float, turn: int) -> _Plan:
    return {scale: (looks[turn - 1],) for scale, looks in _plan(min_side_px).items()}


def _plan(min_side_px: float) -> _Plan:
    """Return all looks that may find something."""
    plan: _Plan = {0.5: _LEVELS, 1.0: _LEVELS, 2.0: _LEVELS_AT_DOUBLE}
    if min_side_px >= _FULL_BELOW_PX:
        del plan[1.0]
    if min_side_px >= DOUBLE_BELOW_PX:
        del plan[2.0]
    return plan


def _both(grey: GreyPixels, min_side_px: float, plan: _Plan, bright: bool) -> Squares:
    """Return the dark squares, and the bright ones if wanted: the dark ones of the negative."""
    dark_px = _seen(grey, min_side_px, plan)
    if not bright:
        return Squares(dark_px, np.zeros(len(dark_px), dtype=bool))
    bright_px = _seen(np.asarray(255 - grey, dtype=np.uint8), min_side_px, plan)
    is_bright = np.repeat([False, True], [len(dark_px), len(bright_px)])
    return Squares(np.concatenate([dark_px, bright_px]), is_bright)


def _seen(grey: GreyPixels, min_side_px: float, plan: _Plan) -> Array:
    """Return the dark squares of all looks, those alike once, shape (n, 4, 2)."""
    tasks = [
        partial(_at_scale, grey, scale, looks, min_side_px)
        for scale, looks in plan.items()
        if scale * min(grey.shape) >= _LEAST_IMAGE_PX
    ]
    shared = cv2.getNumThreads() > 1 and grey.size >= _SHARED_FROM_PIXELS
    found = at_once(tasks) if shared else [task() for task in tasks]
    corners_px = np.concatenate([np.empty((0, 4, 2)), *found])
    return corners_px[distinct(corners_px)]


def _at_scale(grey: GreyPixels, scale: float, looks: tuple[Look, ...], min_side_px: float) -> Array:
    """Return the dark squares of looks at one scale, pixels of the image, shape (n, 4, 2)."""
    scaled = _scaled(grey, scale)
    tiles, least_px = Tiles.of(scaled), _SLACK * scale * min_side_px
    found = [dark_squares(scaled, tiles, look, least_px) for look in looks]
    return (np.concatenate(found) + 0.5) / scale - 0.5


def _scaled(grey: GreyPixels, scale: float) -> GreyPixels:
    """Return the image at half, its own or double scale; half drops an odd last row or column."""
    if scale == 1.0:
        return grey
    height, width = grey.shape
    if scale > 1.0:
        size, method = (2 * width, 2 * height), cv2.INTER_CUBIC
        return np.asarray(cv2.resize(grey, size, interpolation=method), dtype=np.uint8)
    whole = grey[: height // 2 * 2, : width // 2 * 2]
    size = (width // 2, height // 2)
    return np.asarray(cv2.resize(whole, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)

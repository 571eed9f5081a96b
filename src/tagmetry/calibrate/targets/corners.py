"""From about where corners are to exactly where, and which of them to believe."""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.targets.found import DroppedPoint, Found, dropped
from tagmetry.calibrate.targets.saddles import Saddles, fit_saddles
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray

_SECOND_TRY = 0.6  # the second window, as a share of the first
_FARTHEST = 0.1  # how far a corner may move, in steps; at least `_FARTHEST_PX`
_FARTHEST_PX = 1.5
_EDGE_PX = 2.0
_WORST_SD_PX = 1.0


def refined(
    grey: GreyPixels,
    points: IntArray,
    guesses_px: Array,
    along_px: Array,
    down_px: Array,
    *,
    half: float = 1 / 3,
    arm: float = 1.0,
    coarse_px: float = 1.0,
) -> Found:
    """Fit every corner in a window that follows its squares; drop those that are none.

    Args:
        grey: 8-bit image.
        points: Which of the board's points they are, shape (n,), rising.
        guesses_px: Where they are about, shape (n, 2).
        along_px: From each to the next corner in its row, shape (n, 2).
        down_px: From each to the next corner in its column, shape (n, 2).
        half: Half a window's side, in steps.
        arm: How far from an edge pixels may lie, in steps (`fit_saddles`).
        coarse_px: How good the guesses are.
    """
    shortest_px = np.minimum(np.linalg.norm(along_px, axis=1), np.linalg.norm(down_px, axis=1))
    allowed_px = np.maximum(_FARTHEST * shortest_px, _FARTHEST_PX * max(1.0, coarse_px))
    usable = _inside(grey, guesses_px) & (shortest_px >= 3.0)
    outside = dropped(points, guesses_px, ~usable, "too small, or at the picture's edge")
    rest = _Corners(points, guesses_px, along_px, down_px, allowed_px).only(usable)
    lost: tuple[DroppedPoint, ...] = ()
    found: list[Found] = []
    for share in (1.0, _SECOND_TRY):
        if len(rest.points):
            good, rest, lost = _try(grey, rest, share * half, arm)
            found.append(good)
    return _joined(found, (*outside, *lost))


@dataclass(frozen=True, eq=False)
class _Corners:
    """Corners to be fitted."""

    points: IntArray
    guesses_px: Array
    along_px: Array
    down_px: Array
    allowed_px: Array

    def only(self, kept: BoolArray) -> "_Corners":
        places = (self.guesses_px, self.along_px, self.down_px, self.allowed_px)
        return _Corners(self.points[kept], *(part[kept] for part in places))


def _try(
    grey: GreyPixels, corners: _Corners, half: float, arm: float
) -> tuple[Found, _Corners, tuple[DroppedPoint, ...]]:
    """Return the corners that a window fits, the others, and what is wrong with them."""
    fit = fit_saddles(grey, corners.guesses_px, corners.along_px, corners.down_px, half, arm)
    moved_px = np.linalg.norm(fit.centres_px - corners.guesses_px, axis=1)
    too_far = moved_px > corners.allowed_px
    uncertain = fit.sd_px > _WORST_SD_PX
    good = fit.is_saddle & ~too_far & ~uncertain
    lost = _reasons(corners, fit, moved_px, too_far, uncertain)
    found = Found(corners.points[good], fit.centres_px[good], fit.sd_px[good])
    return found, corners.only(~good), lost


def _reasons(
    corners: _Corners, fit: Saddles, moved_px: Array, too_far: BoolArray, uncertain: BoolArray
) -> tuple[DroppedPoint, ...]:
    lost = []
    for i in np.flatnonzero(~fit.is_saddle | too_far | uncertain):
        if not fit.is_saddle[i]:
            reason = "no crossing of two edges"
        elif too_far[i]:
            reason = f"moved {moved_px[i]:.1f} px, more than {corners.allowed_px[i]:.1f} px"
        else:
            reason = f"uncertain by {fit.sd_px[i]:.1f} px"
        lost.append(DroppedPoint(int(corners.points[i]), corners.guesses_px[i], reason))
    return tuple(lost)


def _joined(found: list[Found], lost: tuple[DroppedPoint, ...]) -> Found:
    if not found:
        return Found(np.zeros(0, np.int64), np.zeros((0, 2)), np.zeros(0), lost)
    points = np.concatenate([one.points for one in found])
    order = np.argsort(points)
    corners_px = np.concatenate([one.corners_px for one in found])[order]
    sd_px = np.concatenate([one.sd_px for one in found])[order]
    return Found(points[order], corners_px, sd_px, lost)


def _inside(grey: GreyPixels, places_px: Array) -> BoolArray:
    height_px, width_px = grey.shape
    low = (places_px >= _EDGE_PX).all(axis=1)
    high = (places_px <= np.array([width_px, height_px]) - 1 - _EDGE_PX).all(axis=1)
    return np.asarray(low & high & np.isfinite(places_px).all(axis=1))

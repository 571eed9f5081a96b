"""From about where corners are to exactly where, and which of them to believe.

First every corner is fitted as a crossing of straight edges. What is found says how the board's
lines bend, and then every corner is fitted as a crossing of edges bent like that: taken for
straight they would pull it to the inside of their curve, in all views alike.
"""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.calibrate.targets.bends import Bends, line_bends
from tagmetry.calibrate.targets.found import DroppedPoint, Found, dropped
from tagmetry.calibrate.targets.patches import cut_out
from tagmetry.calibrate.targets.saddles import Saddles, fit_saddles
from tagmetry.calibrate.targets.window import MOST_HALF_PX
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray

_SECOND_TRY = 0.6  # the second window, as a share of the first
_FARTHEST = 0.1  # how far a corner may move, in steps; at least `_FARTHEST_PX`
_FARTHEST_PX = 1.5
_EDGE_PX = 2.0
_WORST_SD_PX = 1.0


@dataclass(frozen=True, eq=False)
class Guesses:
    """Corners of a board, about.

    Attributes:
        points: Which of the board's points they are, shape (n,), rising.
        places: Where they are on the board, x to its right, y to its top, shape (n, 2), any unit.
        corners_px: Where they are in the picture, shape (n, 2).
        along_px: From each to the next corner to the board's right, shape (n, 2).
        down_px: From each to the next corner below on the board, shape (n, 2).
    """

    points: IntArray
    places: Array
    corners_px: Array
    along_px: Array
    down_px: Array

    @property
    def steps_px(self) -> Array:
        """Both steps, one in each column, shape (n, 2, 2)."""
        return np.stack([self.along_px, self.down_px], axis=-1)

    @property
    def shortest_px(self) -> Array:
        """Length of the shorter step of each, shape (n,)."""
        return np.asarray(np.linalg.norm(self.steps_px, axis=1).min(axis=1))

    def only(self, kept: BoolArray | IntArray) -> "Guesses":
        """Return some of them."""
        parts = (self.places, self.corners_px, self.along_px, self.down_px)
        return Guesses(self.points[kept], *(part[kept] for part in parts))


def refined(
    grey: GreyPixels,
    guesses: Guesses,
    *,
    half: float = 1 / 3,
    arm: float = 1.0,
    coarse_px: float = 1.0,
) -> Found:
    """Fit every corner in a window that follows its squares; drop those that are none.

    Args:
        grey: 8-bit image.
        guesses: Where the corners are about.
        half: Half a window's side, in steps.
        arm: How far from an edge pixels may lie, in steps (`fit_saddles`).
        coarse_px: How good the guesses are.
    """
    places_px = guesses.corners_px
    usable = _inside(grey, places_px) & (guesses.shortest_px >= 3.0)
    outside = dropped(guesses.points, places_px, ~usable, "too small, or at the picture's edge")
    guesses = guesses.only(usable)
    straight = _fitted(grey, _Corners(guesses, coarse_px), half, arm)
    guesses = _moved(guesses, straight)
    bends = line_bends(guesses.places, guesses.corners_px)
    bent = _fitted(grey, _Corners(guesses, coarse_px, bends.values), half, arm)
    bent = _doubted(bent, guesses, bends, half)
    kept = guesses.only(np.searchsorted(guesses.points, bent.points))
    patches = cut_out(grey, bent.corners_px, kept.steps_px, half, arm)
    lost = (*outside, *straight.dropped, *bent.dropped)
    return replace(bent, dropped=lost, patches=patches)


@dataclass(frozen=True, eq=False)
class _Corners:
    """Corners to be fitted, and by how much their edges bend, where that is known."""

    guesses: Guesses
    coarse_px: float
    bends: Array | None = None

    @property
    def allowed_px(self) -> Array:
        """How far they may move."""
        least_px = _FARTHEST_PX * max(1.0, self.coarse_px)
        return np.maximum(_FARTHEST * self.guesses.shortest_px, least_px)

    def only(self, kept: BoolArray) -> "_Corners":
        bends = None if self.bends is None else self.bends[kept]
        return _Corners(self.guesses.only(kept), self.coarse_px, bends)


def _moved(guesses: Guesses, found: Found) -> Guesses:
    """Return the guesses that were found, where they were found."""
    kept = guesses.only(np.searchsorted(guesses.points, found.points))
    return replace(kept, corners_px=found.corners_px)


def _doubted(found: Found, guesses: Guesses, bends: Bends, half: float) -> Found:
    """Add to the covariances how far a wrong curvature of their edges would pull the corners.

    Each edge moves along its own normal; the corner is where both are.
    """
    kept = np.searchsorted(guesses.points, found.points)
    steps_px = guesses.only(kept).steps_px
    lengths_px = np.linalg.norm(steps_px, axis=1)
    reach_px = np.minimum(half * lengths_px, MOST_HALF_PX)
    pulled_px = bends.doubts[kept] * reach_px**2 / 6
    normals = np.stack([-steps_px[:, 1], steps_px[:, 0]], axis=-1) / lengths_px[..., None]
    moved = np.linalg.inv(normals) * pulled_px[:, None]
    covariances_px2 = found.covariances_px2 + moved @ np.swapaxes(moved, 1, 2)
    return replace(found, covariances_px2=covariances_px2)


def _fitted(grey: GreyPixels, corners: _Corners, half: float, arm: float) -> Found:
    """Fit corners in a window, and those that it does not fit in a smaller one."""
    found: list[Found] = []
    lost: tuple[DroppedPoint, ...] = ()
    for share in (1.0, _SECOND_TRY):
        if len(corners.guesses.points):
            good, corners, lost = _try(grey, corners, share * half, arm)
            found.append(good)
    return _joined(found, lost)


def _try(
    grey: GreyPixels, corners: _Corners, half: float, arm: float
) -> tuple[Found, _Corners, tuple[DroppedPoint, ...]]:
    """Return the corners that a window fits, the others, and what is wrong with them."""
    near = corners.guesses
    fit = fit_saddles(grey, near.corners_px, near.along_px, near.down_px, half, arm, corners.bends)
    moved_px = np.linalg.norm(fit.centres_px - near.corners_px, axis=1)
    too_far = moved_px > corners.allowed_px
    uncertain = fit.sd_px > _WORST_SD_PX
    good = fit.is_saddle & ~too_far & ~uncertain
    lost = _reasons(corners, fit, moved_px, too_far, uncertain)
    found = Found(near.points[good], fit.centres_px[good], fit.covariances_px2[good])
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
        near = corners.guesses
        lost.append(DroppedPoint(int(near.points[i]), near.corners_px[i], reason))
    return tuple(lost)


def _joined(found: list[Found], lost: tuple[DroppedPoint, ...]) -> Found:
    if not found:
        return Found(np.zeros(0, np.int64), np.zeros((0, 2)), np.zeros((0, 2, 2)), lost)
    points = np.concatenate([one.points for one in found])
    order = np.argsort(points)
    corners_px = np.concatenate([one.corners_px for one in found])[order]
    covariances_px2 = np.concatenate([one.covariances_px2 for one in found])[order]
    return Found(points[order], corners_px, covariances_px2, lost)


def _inside(grey: GreyPixels, places_px: Array) -> BoolArray:
    height_px, width_px = grey.shape
    low = (places_px >= _EDGE_PX).all(axis=1)
    high = (places_px <= np.array([width_px, height_px]) - 1 - _EDGE_PX).all(axis=1)
    return np.asarray(low & high & np.isfinite(places_px).all(axis=1))

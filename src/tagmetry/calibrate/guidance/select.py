"""The few most informative views of many, as of a long video.

A camera from a few views far apart from each other says where the board was in all of them. Each
view's information on the intrinsics, its own pose eliminated, is then a small matrix, and views
are taken one by one: always the one after which projections are least uncertain in the mean over
the image. The gain of a view falls with every other that is taken, so that taking the best each
time is never far from the best choice of all.

Reference: G. Nemhauser, L. Wolsey, M. Fisher, An analysis of approximations for maximizing
submodular set functions, 1978; A. Krause et al., Near-optimal sensor placements, 2008.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tagmetry.calibrate.guidance.gate import distance_px
from tagmetry.calibrate.guidance.knowledge import Knowledge, bundle_of
from tagmetry.calibrate.sightings import gather
from tagmetry.calibrate.view import BoardView
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.errors import InputError
from tagmetry.geometry import Array

_FIRST = 12  # views for a camera to begin with
_APART_SHARE = 0.02  # of the image's diagonal: nearer than that, views are nearly the same


def most_informative(views: Sequence[BoardView], count: int) -> tuple[int, ...]:
    """Return which views to calibrate with, the most informative first.

    Views that are nearly the same as one that is chosen are left out: they share its errors.

    Args:
        views: Of one board, in pictures of one size.
        count: How many are wanted; fewer are given where there are no more different ones.

    Raises:
        InputError: No views, fewer than one wanted, or views of several sizes.
    """
    if not views or count < 1:
        raise InputError(f"expected at least one view and a count, got {len(views)} and {count}")
    known = _first_knowledge(views)
    seen = gather(views)
    told = known.of_views(bundle_of(known.camera, seen), seen)
    left = [int(i) for i in np.flatnonzero(np.isfinite(told).all(axis=(1, 2)))]
    least_px = _APART_SHARE * float(np.hypot(*seen.size_px))
    chosen: list[int] = []
    while left and len(chosen) < count:
        best = _best(known, told, left)
        known = replace(known, information=known.information + told[best])
        chosen.append(best)
        left = [i for i in left if _apart(views[i], views[best]) >= least_px]
    return tuple(chosen)


def far_apart(views: Sequence[BoardView], count: int) -> list[int]:
    """Return views whose corners are far from those of each other, beginning with the first."""
    chosen = [0]
    nearest = np.array([_apart(views[0], view) for view in views])
    while len(chosen) < min(count, len(views)) and nearest.max() > 0:
        chosen.append(int(nearest.argmax()))
        apart = np.array([_apart(views[chosen[-1]], view) for view in views])
        nearest = np.minimum(nearest, apart)
    return chosen


def _first_knowledge(views: Sequence[BoardView]) -> Knowledge:
    """Return the camera of a few views, known as roughly as any camera is."""
    few = [views[i] for i in far_apart(views, _FIRST)]
    rough = Knowledge.rough(views[0].size_px)
    try:
        calibration = calibrate(few, "brown4")
    except InputError:  # the few do not determine a camera: a rough one serves
        return rough
    solved = Knowledge.of_calibration(calibration)
    information = _carried(rough, solved)
    return Knowledge(
        solved.camera, solved.freedom, information, solved.to_pixels, 1.0, solved.corner_sd_px
    )


def _carried(rough: Knowledge, solved: Knowledge) -> Array:
    """Return the rough camera's information in the steps of another's freedom."""
    to_rough = np.linalg.pinv(rough.freedom.basis) @ solved.freedom.basis
    return np.asarray(to_rough.T @ rough.information @ to_rough)


def _best(known: Knowledge, told: Array, left: list[int]) -> int:
    """Return the view after which the mean variance over the image is least."""
    spread = np.einsum("gim,gik->mk", known.to_pixels, known.to_pixels)
    after = np.linalg.inv(known.information + told[left])
    return left[int(np.argmin(np.einsum("nmk,km->n", after, spread)))]


def _apart(view: BoardView, other: BoardView) -> float:
    """Return the distance of two views; views without a common corner are as far as can be."""
    return min(distance_px(view, other), float(np.hypot(*view.size_px)))

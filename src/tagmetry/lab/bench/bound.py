"""The least error of corners that the noise of a rendered case allows."""

import numpy as np

from tagmetry.detect.photometric.bound import corner_bound_px
from tagmetry.lab.bench.case import Case
from tagmetry.markers import family as family_of

_MARKERS = 8  # as many are enough, since all of a case are alike


def bound_px(case: Case) -> float | None:
    """Return the root mean square bound over some markers of the first image."""
    if case.seen is None or case.truths is None or len(case.truths[0].ids) == 0:
        return None
    family, truth, seen = family_of(case.family), case.truths[0], case.seen
    margin_cells = family.layout.margin_cells
    bounds_px = [
        corner_bound_px(corners, seen.printed(family.picture(int(n)), margin_cells), seen.noise)
        for n, corners in zip(truth.ids[:_MARKERS], truth.corners_px, strict=False)
    ]
    return float(np.sqrt(np.mean(np.square(bounds_px))))

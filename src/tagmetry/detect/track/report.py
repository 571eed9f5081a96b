"""Markers that were seen, with their exact corners, as a detector reports them."""

from collections.abc import Sequence

import numpy as np

from tagmetry.detect.detection import Detection
from tagmetry.detect.sides import Corners
from tagmetry.detect.track.seen import Seen
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers import MarkerFamily

_BORDER_PX = 2.0


def detections(
    seen: Seen, corners: Corners, families: Sequence[MarkerFamily], size_px: tuple[int, int]
) -> tuple[Detection, ...]:
    """Return what was seen in an image of a size, ordered by family and id."""
    is_duplicate = seen.count_of_each() > 1
    touches = _touches_border(corners.corners_px, size_px)
    found = [
        Detection(
            families[seen.families[i]].name,
            int(seen.ids[i]),
            corners.corners_px[i],
            corners.covariances_px2[i],
            int(seen.hamming[i]),
            float(seen.confidence[i]),
            bool(seen.is_inverted[i]),
            bool(touches[i]),
            bool(is_duplicate[i]),
        )
        for i in range(len(seen))
    ]
    return tuple(sorted(found, key=lambda one: (one.family, one.id, *one.corners_px[0])))


def _touches_border(corners_px: Array, size_px: tuple[int, int]) -> BoolArray:
    low, high = corners_px.min(axis=(1, 2)), corners_px.max(axis=1)
    return np.asarray((low < _BORDER_PX) | (high > np.array(size_px) - 1 - _BORDER_PX).any(axis=1))

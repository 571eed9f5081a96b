"""Markers looked at by several threads: reading pixels lets go of the interpreter."""

from functools import partial

import cv2

from tagmetry.detect.track.sight import Sights, look
from tagmetry.detect.workers import at_once, shares
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray
from tagmetry.markers import MarkerFamily

_LEAST_SHARE = 24  # markers, that waking a thread be worth it


def look_by_threads(
    grey: GreyPixels,
    family: MarkerFamily,
    ids: IntArray,
    corners_px: Array,
    deviation_px: Array,
    is_inverted: BoolArray,
) -> Sights:
    """Return what `look` does; arguments as there."""

    def looked(share: slice) -> Sights:
        where = corners_px[share], deviation_px[share]
        return look(grey, family, ids[share], *where, is_inverted[share])

    parts = shares(len(ids), _LEAST_SHARE, cv2.getNumThreads())
    if len(parts) == 1:
        return looked(parts[0])
    return Sights.joined(at_once([partial(looked, part) for part in parts]))

"""What was found, as it is reported: objects, in order."""

from collections.abc import Sequence

import numpy as np

from tagmetry.detect.detection import Detection, Rejection
from tagmetry.detect.named import Named
from tagmetry.detect.places import first_per_place
from tagmetry.detect.sides import Corners
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers import MarkerFamily

_BORDER_PX = 2.0


def detections(
    named: Named, corners: Corners, families: Sequence[MarkerFamily], size_px: tuple[int, int]
) -> tuple[Detection, ...]:
    """Return markers of an image as objects, ordered by family and id.

    Args:
        named: Which markers, n.
        corners: Where each is.
        families: Of the detector.
        size_px: (width, height) of the image.
    """
    names = np.array([one.name for one in families])[named.families]
    x, y = corners.corners_px[:, 0].T
    order = np.lexsort((y, x, named.ids, names))
    named, corners = named.at(order), corners.at(order)
    columns = (
        names[order].tolist(),
        named.ids.tolist(),
        corners.corners_px,
        corners.covariances_px2,
        named.hamming.tolist(),
        named.confidence.tolist(),
        named.is_inverted.tolist(),
        _touches_border(corners.corners_px, size_px).tolist(),
        (named.count_of_each > 1).tolist(),
    )
    return tuple(Detection(*one) for one in zip(*columns, strict=True))


def distinct_rejections(
    rejections: Sequence[Rejection], detections: Sequence[Detection]
) -> tuple[Rejection, ...]:
    """Return one rejection per place, none where a marker was found."""
    squares_px = [one.corners_px for one in detections] + [one.corners_px for one in rejections]
    first = np.flatnonzero(first_per_place(np.array(squares_px).reshape(-1, 4, 2))).tolist()
    return tuple(rejections[i - len(detections)] for i in first if i >= len(detections))


def _touches_border(corners_px: Array, size_px: tuple[int, int]) -> BoolArray:
    """Say of each marker (n, 4, 2) whether a corner lies at the image's edge, shape (n,)."""
    near = np.minimum(corners_px, np.array(size_px) - 1 - corners_px) < _BORDER_PX
    return np.asarray(near.any(axis=(1, 2)))

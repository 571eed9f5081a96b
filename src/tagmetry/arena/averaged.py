"""The markers of several images of a scene that stands still, as one image would show them."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tagmetry.detect import Detection
from tagmetry.markers.bodies import MarkerKey

_LEAST_SHARE = 0.1  # of the variance; what stays the same from image to image is not averaged


def averaged(images: Sequence[Sequence[Detection]]) -> tuple[Detection, ...]:
    """Return each marker once, its corners the mean of all images that show it.

    Markers that are seen twice in an image, or in less than half of the images that the most seen
    marker is in, are left out.

    Args:
        images: The detections of every image.
    """
    by_key: dict[MarkerKey, list[Detection]] = {}
    for one in (one for detections in images for one in detections if not one.is_duplicate):
        by_key.setdefault(MarkerKey(one.family, one.id), []).append(one)
    most = max((len(seen) for seen in by_key.values()), default=0)
    return tuple(_mean(seen) for seen in by_key.values() if 2 * len(seen) >= most)


def _mean(seen: Sequence[Detection]) -> Detection:
    corners_px = np.mean([one.corners_px for one in seen], axis=0)
    covariance_px2 = np.mean([one.corners_cov_px2 for one in seen], axis=0)
    share = max(1 / len(seen), _LEAST_SHARE)
    return replace(seen[0], corners_px=corners_px, corners_cov_px2=share * covariance_px2)

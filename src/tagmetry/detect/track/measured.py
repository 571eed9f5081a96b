"""Where exactly the markers are that were seen."""

from collections.abc import Sequence

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.exact import Exact, exact_corners
from tagmetry.detect.expected import expected_pictures
from tagmetry.detect.photometric import LOOK_COUNT
from tagmetry.detect.track.seen import Seen
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import MarkerFamily


def measured(
    grey: GreyPixels,
    seen: Seen,
    families: Sequence[MarkerFamily],
    camera: Camera | None,
    looks: Array | None = None,
) -> Exact:
    """Return where exactly markers are.

    Args:
        grey: 8-bit image.
        seen: The markers, m.
        families: Of the detector.
        camera: Intrinsics, if known.
        looks: How each looked in the image before, shape (m, 10).
    """
    if not len(seen):
        return Exact.nothing()
    unknown = np.full((len(seen), LOOK_COUNT), np.nan)
    pictures = expected_pictures(grey, seen, families)
    looks = unknown if looks is None else looks
    return exact_corners(grey, seen.corners_px, pictures, camera, looks)

"""Where the peers' corners begin, turned and moved to ours."""

import numpy as np

from tagmetry.geometry import Array

HALF_PIXEL = 0.5  # of those whose integers are the pixels' corners


def from_opencv_pictures(corners_px: Array, family: str) -> Array:
    """Return corners (n, 4, 2) that begin at the marker's own top left.

    OpenCV's pictures of AprilTags are turned by 180 degrees against those of the AprilTag project.
    """
    return np.roll(corners_px, 2, axis=-2) if family.startswith("tag") else corners_px

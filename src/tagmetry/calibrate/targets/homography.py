"""The homography of a flat board's picture."""

import cv2
import numpy as np

from tagmetry.geometry import Array


def fitted_homography(places_m: Array, places_px: Array, farthest_px: float | None = None) -> Array:
    """Return H with `H @ (x, y, 1) ~ (u, v, 1)`, shape (3, 3); NaN where there is none.

    Args:
        places_m: x and y on the board, shape (n, 2).
        places_px: Where the picture shows them, shape (n, 2).
        farthest_px: Leave out places farther than this from where the others put them; by default
            all count.
    """
    if len(places_m) < 4:
        return np.full((3, 3), np.nan)
    method, threshold_px = (0, 3.0) if farthest_px is None else (cv2.RANSAC, farthest_px)
    fitted = cv2.findHomography(places_m, places_px, method, threshold_px)[0]
    # OpenCV gives None, which its types do not say
    return np.full((3, 3), np.nan) if np.ndim(fitted) != 2 else np.asarray(fitted, np.float64)

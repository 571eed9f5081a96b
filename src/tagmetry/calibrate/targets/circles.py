"""Find a grid of discs: OpenCV's finder says about where, the centre of darkness exactly where.

A disc seen at an angle is an ellipse whose centre is not the picture of the disc's centre. The
disc is a dual conic C*; its picture is H C* H^T, with the ellipse's centre in the last column, and
H p is the centre's picture. The difference is taken away with the board's own homography H; what a
lens' distortion adds within one disc remains.

A straight grid looks the same upside down (a square one also on its side), a staggered one with an
even number of rows too: rows then run to the picture's right.
"""

import cv2
import numpy as np

from tagmetry.calibrate.targets.discs import disc_centres
from tagmetry.calibrate.targets.found import Found, NotFound, dropped
from tagmetry.calibrate.targets.homography import fitted_homography
from tagmetry.calibrate.targets.order import in_board_order
from tagmetry.calibrate.view import round_covariances
from tagmetry.geometry import Array, apply_homography
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import CircleGrid

_FARTHEST = 0.25  # of the distance between discs: how far one may lie from where one plane puts it
_LEAST_KEPT = 0.5
_SMALLEST_PX2 = 12.0


def find_circles(grey: GreyPixels, board: CircleGrid) -> Found | NotFound:
    """Return the centres of a circle grid's discs, free of perspective's bias.

    Args:
        grey: 8-bit image, shape (height, width).
        board: What to look for.
    """
    wanted = f"{board.columns}x{board.rows} discs"
    grid_px = _coarse(grey, board)
    if grid_px is None:
        return NotFound(f"no grid of {wanted} is seen whole")
    ordered = in_board_order(grid_px, lambda one: _is_flat(board, one)).reshape(-1, 2)
    if not _is_flat(board, ordered):
        return NotFound(f"discs are seen, but not as one grid of {wanted}", ordered)
    H = _homography(board, ordered)
    centres_px, sd_px, is_disc = disc_centres(grey, board.circles_m(), board.nearest_m, H, ordered)
    unbiased = centres_px - perspective_bias_px(board.circles_m(), H)
    points = np.arange(len(ordered))
    if is_disc.mean() < _LEAST_KEPT:
        return NotFound(f"only {is_disc.sum()} of {wanted} stand out from their ground", ordered)
    lost = dropped(points, ordered, ~is_disc, "no dark disc on a bright ground")
    return Found(points[is_disc], unbiased[is_disc], round_covariances(sd_px[is_disc]), lost)


def perspective_bias_px(circles_m: Array, H: Array) -> Array:
    """Return each ellipse's centre less the picture of its disc's centre, shape (n, 2).

    Args:
        circles_m: Discs on the board, shape (n, 3): x, y, radius.
        H: From the board's x and y to pixels, shape (3, 3).
    """
    x, y, radius = circles_m.T
    homogeneous = np.stack([x, y, np.ones_like(x)], axis=1)
    dual = np.einsum("ni,nj->nij", homogeneous, homogeneous)
    dual -= (radius**2)[:, None, None] * np.diag([1.0, 1.0, 0.0])
    last = (H @ dual @ H.T)[:, :, 2]
    return np.asarray(last[:, :2] / last[:, 2:] - apply_homography(H, circles_m[:, :2]))


def _coarse(grey: GreyPixels, board: CircleGrid) -> Array | None:
    """Return the finder's centres, shape (rows, columns, 2)."""
    stretched = _stretched(grey)
    size = (board.columns, board.rows)
    kind = cv2.CALIB_CB_ASYMMETRIC_GRID if board.asymmetric else cv2.CALIB_CB_SYMMETRIC_GRID
    for flags in (kind, kind | cv2.CALIB_CB_CLUSTERING):
        found, centres = cv2.findCirclesGrid(
            stretched, size, flags=flags, blobDetector=_blobs(grey, board)
        )
        if found:
            return np.asarray(centres, dtype=np.float64).reshape(board.rows, board.columns, 2)
    return None


def _stretched(grey: GreyPixels) -> GreyPixels:
    darkest, brightest = int(grey.min()), int(grey.max())
    gain = 255.0 / max(brightest - darkest, 1)
    return np.asarray(cv2.convertScaleAbs(grey - darkest, alpha=gain), dtype=np.uint8)


def _blobs(grey: GreyPixels, board: CircleGrid) -> cv2.SimpleBlobDetector:
    wanted = cv2.SimpleBlobDetector.Params()
    largest_px2 = grey.size / (board.columns * board.rows)
    wanted.minArea, wanted.maxArea = _SMALLEST_PX2, max(largest_px2, 2 * _SMALLEST_PX2)
    wanted.minThreshold, wanted.maxThreshold, wanted.thresholdStep = 20.0, 235.0, 10.0
    wanted.minDistBetweenBlobs = 4.0
    return cv2.SimpleBlobDetector.create(wanted)


def _is_flat(board: CircleGrid, grid_px: Array) -> bool:
    """Return whether one view of the flat board puts every disc about where it is."""
    places_px = grid_px.reshape(-1, 2)
    H = _homography(board, places_px)
    if not np.isfinite(H).all():
        return False
    off_px = np.linalg.norm(apply_homography(H, board.corners_m[:, :2]) - places_px, axis=1)
    apart_px = np.linalg.norm(places_px[:, None] - places_px, axis=2)
    nearest_px = np.min(apart_px + np.where(np.eye(len(places_px)) > 0, np.inf, 0.0), axis=1)
    return bool((off_px < _FARTHEST * nearest_px).all())


def _homography(board: CircleGrid, places_px: Array) -> Array:
    return fitted_homography(board.corners_m[:, :2], places_px)

"""Is a view fit to be measured? Blur, motion, saturation and contrast around the board's points.

An edge of contrast c, blurred by s, is nowhere steeper than c / (sqrt(2 pi) s). The steepest place
near each point, across the rows and across the columns of the board, gives two blurs; when one is
much larger, the camera or the board moved. Motion along a diagonal blurs both and counts as blur.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from tagmetry.calibrate.view import BoardView
from tagmetry.detect.grey import grey_8bit
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels, GreyPixels, IntArray

_SMOOTH_PX = 0.8
_LARGEST_PATCH_PX = 24
_MARGIN_PX = _LARGEST_PATCH_PX + 5  # what smoothing and the gradient reach
_BURNT = 254
_MOST_POINTS = 150
_NEIGHBOURS = 4


@dataclass(frozen=True)
class ViewQuality:
    """What the picture is like around the board's points.

    Attributes:
        blur_px: Standard deviation of the edges' blur, median over the points, of the softer
            direction.
        sharp_px: The same of the sharper direction.
        saturated_share: Share of the pixels around the points that are fully white or black.
        contrast: White minus black, grey values of 0 to 255, median over the points.
        spacing_px: From a point to its four neighbours, mean, median over the points.
        touches_border: A point lies within five pixels of the picture's edge.
    """

    blur_px: float
    sharp_px: float
    saturated_share: float
    contrast: float
    spacing_px: float
    touches_border: bool


@dataclass(frozen=True)
class QualityLimits:
    """What a view must keep to be used; infinity switches a limit off.

    Attributes:
        blur_share: Largest blur as a share of the distance between points.
        motion_ratio: Largest ratio of the blurs of the two directions, where the larger one is more
            than `motion_px`.
        motion_px: Blur below which nothing counts as motion.
        saturated_share: Largest share of saturated pixels.
        contrast: Least contrast, grey values.
    """

    blur_share: float = 0.15
    motion_ratio: float = 2.0
    motion_px: float = 1.5
    saturated_share: float = 0.6
    contrast: float = 15.0

    def refusal(self, quality: ViewQuality) -> str | None:
        """Return why a view is not to be used, in words; None when it is."""
        ratio = quality.blur_px / max(quality.sharp_px, 0.3)
        if quality.contrast < self.contrast:
            return f"too little contrast: {quality.contrast:.0f} grey values; more or softer light"
        if quality.saturated_share > self.saturated_share:
            return (
                f"clipped: {quality.saturated_share:.0%} of the pixels around the corners are "
                "fully white or black; another exposure, less gain or less contrast"
            )
        if quality.blur_px > self.motion_px and ratio > self.motion_ratio:
            return (
                f"moved: edges of one direction are blurred by {quality.blur_px:.1f} px, of the "
                f"other by {quality.sharp_px:.1f} px; hold board and camera still"
            )
        if quality.blur_px > self.blur_share * quality.spacing_px:
            return (
                f"blurred by {quality.blur_px:.1f} px where corners are {quality.spacing_px:.0f} "
                "px apart; focus, or come closer"
            )
        return None


def view_quality(image: AnyPixels, view: BoardView) -> ViewQuality:
    """Return what a picture is like around a view's points.

    Args:
        image: The picture that the view was found in: grey or BGR, uint8 or uint16.
        view: What was found in it.
    """
    grey = grey_8bit(image)
    some = _some(len(view.points))
    spacing_px = _spacings_px(view.corners_px)[some]
    normals = _edge_normals(view)
    near, origin_px = _cut_out(grey, view.corners_px)
    gradient = _gradient(near)
    patches = [
        _Patch.around(near, gradient, centre, 0.5 * spacing)
        for centre, spacing in zip(view.corners_px[some] - origin_px, spacing_px, strict=True)
    ]
    blurs_px = np.median([[patch.blur_px(n) for n in normals] for patch in patches], axis=0)
    return ViewQuality(
        blur_px=float(blurs_px.max()),
        sharp_px=float(blurs_px.min()),
        saturated_share=float(np.mean([patch.saturated_share for patch in patches])),
        contrast=float(np.median([patch.contrast for patch in patches])),
        spacing_px=float(np.median(spacing_px)),
        touches_border=_touches_border(grey, view.corners_px),
    )


@dataclass(frozen=True, eq=False)
class _Patch:
    """The pixels around a point, the gradient there, (2, h, w), and white minus black."""

    grey: GreyPixels
    gradient: Array
    contrast: float

    @classmethod
    def around(cls, grey: GreyPixels, gradient: Array, centre: Array, half_px: float) -> "_Patch":
        half = int(np.clip(half_px, 2, _LARGEST_PATCH_PX))
        column, row = np.rint(centre).astype(int)
        rows = slice(max(0, row - half), max(0, row + half) + 1)
        columns = slice(max(0, column - half), max(0, column + half) + 1)
        pixels = grey[rows, columns]
        return cls(pixels, gradient[:, rows, columns], _contrast(pixels))

    @property
    def saturated_share(self) -> float:
        return float(np.mean((self.grey >= _BURNT) | (self.grey == 0)))

    def blur_px(self, normal: Array) -> float:
        """Return the blur of the edges across a direction, without the smoothing's own."""
        steepest = float(np.abs(np.tensordot(normal, self.gradient, axes=1)).max())
        spread = self.contrast / (np.sqrt(2 * np.pi) * max(steepest, 1e-3))
        return float(np.sqrt(max(spread**2 - _SMOOTH_PX**2, 0.01)))


def _contrast(grey: GreyPixels) -> float:
    """Return the span of the grey values, without the 4 % at either end."""
    rising = np.sort(grey, axis=None)
    low, high = (rising[round(share * (rising.size - 1))] for share in (0.04, 0.96))
    return float(high) - float(low)


def _some(count: int) -> IntArray:
    """Return which points to look at: all, or evenly chosen ones of very many."""
    return np.unique(np.linspace(0, count - 1, min(count, _MOST_POINTS)).astype(np.int64))


def _spacings_px(places_px: Array) -> Array:
    from scipy.spatial import cKDTree

    around = min(_NEIGHBOURS, len(places_px) - 1)
    distances = np.asarray(cKDTree(places_px).query(places_px, k=around + 1)[0])
    return np.asarray(distances[:, 1:].mean(axis=1))


def _edge_normals(view: BoardView) -> Array:
    """Return unit normals of the pictures of the board's rows and columns, shape (2, 2)."""
    board = np.column_stack([view.p_board[:, :2], np.ones(len(view.points))])
    linear = np.linalg.lstsq(board, view.corners_px, rcond=None)[0][:2]  # rows: x and y of board
    normals = np.stack([-linear[:, 1], linear[:, 0]], axis=1)
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12))


def _cut_out(grey: GreyPixels, places_px: Array) -> tuple[GreyPixels, IntArray]:
    """Return the part of the picture around the points, and its first pixel's column and row."""
    low = np.maximum(np.floor(places_px.min(axis=0)).astype(np.int64) - _MARGIN_PX, 0)
    high = np.maximum(np.ceil(places_px.max(axis=0)).astype(np.int64) + _MARGIN_PX, low) + 1
    return grey[low[1] : high[1], low[0] : high[0]], low


def _gradient(grey: GreyPixels) -> Array:
    smooth = cv2.GaussianBlur(grey.astype(np.float32), (0, 0), _SMOOTH_PX)
    across, down = (
        cv2.Sobel(smooth, cv2.CV_32F, dx, dy, ksize=1, scale=0.5) for dx, dy in ((1, 0), (0, 1))
    )
    return np.stack([across, down])


def _touches_border(grey: GreyPixels, places_px: Array) -> bool:
    limit_px = np.array(grey.shape[::-1]) - 6.0
    return bool((places_px < 5.0).any() or (places_px > limit_px).any())

"""How uncertain corners are: one standard deviation as an ellipse, much enlarged."""

import numpy as np

from tagmetry.detect.detection import Detection
from tagmetry.geometry.arrays import Array, GreyPixels
from tagmetry.record.drawing import Pen, draw_path, draw_text
from tagmetry.record.palette import PURPLE
from tagmetry.record.scale import caption_px

CIRCLE_RAD = np.linspace(0.0, 2.0 * np.pi, 32, endpoint=False)
CIRCLE = np.stack([np.cos(CIRCLE_RAD), np.sin(CIRCLE_RAD)], axis=-1)


def draw_ellipses(canvas: GreyPixels, detection: Detection, magnification: float) -> None:
    """Draw one standard deviation of every corner; without those that are not known."""
    for corner in range(4):
        here = slice(2 * corner, 2 * corner + 2)
        covariance_px2 = detection.corners_cov_px2[here, here]
        if np.isfinite(covariance_px2).all():
            outline = detection.corners_px[corner] + magnification * ellipse(covariance_px2)
            draw_path(canvas, outline, Pen(PURPLE), closed=True)


def draw_ellipse_caption(canvas: GreyPixels, magnification: float) -> None:
    """State the factor at the lower left."""
    text = f"corner ellipses: 1 sigma x {magnification:g}"
    lower_left = np.array([0.0, canvas.shape[0]])
    draw_text(canvas, text, lower_left, caption_px(canvas), PURPLE)


def ellipse(covariance_px2: Array) -> Array:
    """Return points one standard deviation of a covariance (2, 2) from the centre, (n, 2)."""
    variances, directions = np.linalg.eigh(covariance_px2)
    return np.asarray((CIRCLE * np.sqrt(np.clip(variances, 0.0, None))) @ directions.T)

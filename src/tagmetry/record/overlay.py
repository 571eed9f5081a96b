"""A picture of what was found: outlines, ids, axes and cubes over the image.

Every marker gets its outline, a dot at its own top left corner and its id; with a pose also its
axes (x red, y green, z blue) and, if wanted, the cube of which it is the floor.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.camera.model import Camera
from tagmetry.detect.detection import Detection, Rejection
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels, Array, GreyPixels
from tagmetry.pose.result import MarkerPose
from tagmetry.record.display import displayable
from tagmetry.record.drawing import Pen, draw_dot, draw_path, draw_text
from tagmetry.record.palette import ORANGE, PURPLE, SKY_BLUE, VERMILLION, WHITE, Color
from tagmetry.record.wires import axis_wires, cube_wires

CIRCLE = np.linspace(0.0, 2.0 * np.pi, 33)[:-1]


@dataclass(frozen=True)
class _Scale:
    """Widths and heights that suit a marker's size and the picture's."""

    line_px: int
    text_px: float

    @classmethod
    def of(cls, corners_px: Array, canvas: GreyPixels) -> "_Scale":
        diagonal = float(np.hypot(*canvas.shape[:2]))
        side = float(np.linalg.norm(np.roll(corners_px, -1, axis=0) - corners_px, axis=1).mean())
        side = side if np.isfinite(side) else 0.0
        line = max(1, round(min(side / 50, diagonal / 350)))
        text = min(max(side * 0.2, 10.0, diagonal / 110), max(10.0, diagonal / 30))
        return cls(line, text)


def draw_overlay(
    pixels: AnyPixels,
    detections: Sequence[Detection],
    poses: Sequence[MarkerPose | None] | None = None,
    camera: Camera | None = None,
    *,
    axes: bool = True,
    cube: bool = False,
    ellipse_magnification: float | None = None,
    rejections: Sequence[Rejection] = (),
) -> GreyPixels:
    """Return the picture with what was found drawn over it.

    Args:
        pixels: Grey, BGR or BGRA, 8 or 16 bits; unchanged.
        detections: The markers.
        poses: One for each detection, None where there is none.
        camera: Needed for axes and cubes; without it they are left out.
        axes: Draw the axes of markers with a pose.
        cube: Draw a cube that stands on each marker with a pose.
        ellipse_magnification: Draw each corner's standard deviation as an ellipse, so many times
            enlarged; the picture states the factor.
        rejections: What was turned down, drawn in another colour with its reason.

    Returns:
        Shape (height, width, 3), BGR, uint8.

    Raises:
        InputError: The picture is none, or the camera's intrinsics belong to another size.
    """
    canvas = displayable(pixels)
    _check(canvas, detections, poses, camera)
    for rejection in rejections:
        _draw_rejection(canvas, rejection)
    for detection in detections:
        pen = Pen(SKY_BLUE, _Scale.of(detection.corners_px, canvas).line_px)
        draw_path(canvas, detection.corners_px, pen, closed=True)
    if camera is not None:
        for detection, pose in zip(detections, poses or (), strict=False):
            _draw_pose(canvas, detection, pose, camera, axes=axes, cube=cube)
    if ellipse_magnification is not None:
        _draw_ellipses(canvas, detections, ellipse_magnification)
    _draw_names(canvas, detections)
    return canvas


def _check(
    canvas: GreyPixels,
    detections: Sequence[Detection],
    poses: Sequence[MarkerPose | None] | None,
    camera: Camera | None,
) -> None:
    if poses is not None and len(poses) != len(detections):
        raise InputError(f"expected {len(detections)} poses, one per marker, got {len(poses)}")
    if camera is not None:
        camera.check_image(canvas.shape[1], canvas.shape[0])


def _draw_rejection(canvas: GreyPixels, rejection: Rejection) -> None:
    scale = _Scale.of(rejection.corners_px, canvas)
    draw_path(canvas, rejection.corners_px, Pen(VERMILLION, scale.line_px), closed=True)
    _write_below(canvas, rejection.reason, rejection.corners_px, scale, VERMILLION)


def _draw_pose(
    canvas: GreyPixels,
    detection: Detection,
    pose: MarkerPose | None,
    camera: Camera,
    *,
    axes: bool,
    cube: bool,
) -> None:
    if pose is None or not pose.hypotheses:
        return
    T_camera_marker, size_m = pose.best.T_camera_marker, pose.size_m
    width = _Scale.of(detection.corners_px, canvas).line_px
    for wire in cube_wires(T_camera_marker, camera, size_m) if cube else ():
        draw_path(canvas, wire.points_px, Pen(wire.color, width, rim_px=min(width - 1, 1)))
    for wire in axis_wires(T_camera_marker, camera, size_m) if axes else ():
        draw_path(canvas, wire.points_px, Pen(wire.color, 2 * width))


def _draw_ellipses(
    canvas: GreyPixels, detections: Sequence[Detection], magnification: float
) -> None:
    """Draw one standard deviation of every corner, enlarged, and say by how much."""
    unit = np.stack([np.cos(CIRCLE), np.sin(CIRCLE)], axis=-1)
    for detection in detections:
        blocks = [detection.corners_cov_px2[i : i + 2, i : i + 2] for i in (0, 2, 4, 6)]
        for corner, block in zip(detection.corners_px, blocks, strict=True):
            if np.isfinite(block).all():
                variances, directions = np.linalg.eigh(block)
                radii = magnification * np.sqrt(np.clip(variances, 0.0, None))
                outline = corner + (unit * radii) @ directions.T
                draw_path(canvas, outline, Pen(PURPLE, 1), closed=True)
    height, width = canvas.shape[:2]
    size = max(10.0, float(np.hypot(height, width)) / 90)
    where = np.array([0.0, height - 1.0])
    draw_text(canvas, f"corner ellipses: 1 sigma x {magnification:g}", where, size, PURPLE)


def _draw_names(canvas: GreyPixels, detections: Sequence[Detection]) -> None:
    """Mark each marker's own top left corner and write its id, with the family if there are two."""
    one_family = len({detection.family for detection in detections}) == 1
    for detection in detections:
        scale = _Scale.of(detection.corners_px, canvas)
        draw_dot(canvas, detection.corners_px[0], 1.6 * scale.line_px + 0.4, ORANGE)
    for detection in detections:
        scale = _Scale.of(detection.corners_px, canvas)
        name = str(detection.id) if one_family else f"{detection.family} {detection.id}"
        _write_below(canvas, name, detection.corners_px, scale, WHITE)


def _write_below(
    canvas: GreyPixels, text: str, corners_px: Array, scale: _Scale, color: Color
) -> None:
    below = np.array([corners_px[:, 0].mean(), corners_px[:, 1].max() + 2.0 * scale.line_px + 2.0])
    draw_text(canvas, text, below, scale.text_px, color)

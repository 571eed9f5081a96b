"""A picture of what was found: outlines, ids, axes and cubes over the image.

Every marker gets its outline, a dot at its own top left corner and its id; with a pose also its
axes (x red, y green, z blue) and, if wanted, the cube of which it is the floor.
"""

from collections.abc import Sequence

import numpy as np

from tagmetry.camera.model import Camera
from tagmetry.detect.detection import Detection, Rejection
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels, Array, GreyPixels
from tagmetry.pose.result import MarkerPose
from tagmetry.record.display import displayable
from tagmetry.record.drawing import Pen, draw_dot, draw_path, draw_text
from tagmetry.record.ellipses import draw_ellipse_caption, draw_ellipses
from tagmetry.record.palette import ORANGE, SKY_BLUE, VERMILLION, WHITE, Color
from tagmetry.record.result import MarkerResult
from tagmetry.record.scale import Scale
from tagmetry.record.wires import axis_wires, cube_wires

FARTHEST_PX = 1e7  # corners beyond are left out with all that belongs to them


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
    markers = _drawable(detections, poses)
    for rejection in filter(_is_drawable, rejections):
        _draw_rejection(canvas, rejection)
    for marker in markers:
        _draw_outline(canvas, marker.detection)
    if camera is not None:
        for marker in markers:
            _draw_pose(canvas, marker, camera, axes=axes, cube=cube)
    if ellipse_magnification is not None:
        for marker in markers:
            draw_ellipses(canvas, marker.detection, ellipse_magnification)
        draw_ellipse_caption(canvas, ellipse_magnification)
    _draw_names(canvas, [marker.detection for marker in markers])
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


def _drawable(
    detections: Sequence[Detection], poses: Sequence[MarkerPose | None] | None
) -> list[MarkerResult]:
    pairs = zip(detections, poses or [None] * len(detections), strict=True)
    return [MarkerResult(seen, pose) for seen, pose in pairs if _is_drawable(seen)]


def _is_drawable(seen: Detection | Rejection) -> bool:
    return bool((np.abs(seen.corners_px) < FARTHEST_PX).all())


def _draw_rejection(canvas: GreyPixels, rejection: Rejection) -> None:
    scale = Scale.of(rejection.corners_px, canvas)
    draw_path(canvas, rejection.corners_px, Pen(VERMILLION, scale.line_px), closed=True)
    _write_below(canvas, rejection.reason, rejection.corners_px, VERMILLION)


def _draw_outline(canvas: GreyPixels, detection: Detection) -> None:
    pen = Pen(SKY_BLUE, Scale.of(detection.corners_px, canvas).line_px)
    draw_path(canvas, detection.corners_px, pen, closed=True)


def _draw_pose(
    canvas: GreyPixels, marker: MarkerResult, camera: Camera, *, axes: bool, cube: bool
) -> None:
    if marker.pose is None or not marker.pose.hypotheses:
        return
    T_camera_marker, size_m = marker.pose.best.T_camera_marker, marker.pose.size_m
    width = Scale.of(marker.detection.corners_px, canvas).line_px
    for wire in cube_wires(T_camera_marker, camera, size_m) if cube else ():
        draw_path(canvas, wire.points_px, Pen(wire.color, width, rim_px=min(width - 1, 1)))
    for wire in axis_wires(T_camera_marker, camera, size_m) if axes else ():
        draw_path(canvas, wire.points_px, Pen(wire.color, 2 * width))


def _draw_names(canvas: GreyPixels, detections: Sequence[Detection]) -> None:
    """Mark each marker's own top left corner and write its id, with the family if there are two."""
    for detection in detections:
        width = Scale.of(detection.corners_px, canvas).line_px
        draw_dot(canvas, detection.corners_px[0], 1.6 * width + 0.4, ORANGE)
    one_family = len({detection.family for detection in detections}) == 1
    for detection in detections:
        name = str(detection.id) if one_family else f"{detection.family} {detection.id}"
        _write_below(canvas, name, detection.corners_px, WHITE)


def _write_below(canvas: GreyPixels, text: str, corners_px: Array, color: Color) -> None:
    scale = Scale.of(corners_px, canvas)
    below = np.array([corners_px[:, 0].mean(), corners_px[:, 1].max() + 2.0 * scale.line_px + 2.0])
    draw_text(canvas, text, below, scale.text_px, color)

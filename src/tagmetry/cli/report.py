"""Results as lines of text for people: millimetres and degrees, with what they are sure of."""

import json
from collections.abc import Sequence

import numpy as np

from tagmetry.cli.deviations import with_deviation
from tagmetry.detect import Rejection
from tagmetry.pose import MarkerPose
from tagmetry.record import ImageResult, MarkerResult, format_line

_AMBIGUOUS = 0.05


def result_lines(result: ImageResult) -> list[str]:
    """Return one line for an image and one for each of its markers."""
    count = len(result.markers)
    found = "no markers" if count == 0 else "1 marker" if count == 1 else f"{count} markers"
    size = f"{result.width_px}x{result.height_px}"
    head = f"{result.source} [{result.sequence}] {size}: {found}"
    return [head, *map(_marker_line, result.markers)]


def json_line(result: ImageResult, rejections: Sequence[Rejection] | None = None) -> str:
    """Return an image as JSON; rejections, where they were asked for, as `rejected`."""
    line = format_line(result)
    if rejections is None:
        return line
    rejected = [{"reason": r.reason, "corners_px": r.corners_px.tolist()} for r in rejections]
    return json.dumps({**json.loads(line), "rejected": rejected}, separators=(",", ":"))


def explain_lines(rejections: Sequence[Rejection]) -> list[str]:
    """Return one line for each square that was turned down."""
    return [
        f"  rejected at ({x:.0f}, {y:.0f}) px: {rejection.reason}"
        for rejection in rejections
        for x, y in [rejection.corners_px.mean(axis=0)]
    ]


def _marker_line(marker: MarkerResult) -> str:
    seen = marker.detection
    x, y = seen.center_px
    name = f"{seen.family} {seen.id}"
    place = f"  {name:<20} at ({x:8.2f}, {y:8.2f}) px, side {seen.side_px:6.1f} px"
    return place + "".join([_pose_text(marker.pose), *_remarks(marker)])


def _pose_text(pose: MarkerPose | None) -> str:
    if pose is None:
        return ""
    if not pose.hypotheses:
        return ", no pose"
    x_mm, y_mm, z_mm = 1000 * np.asarray(pose.best.T_camera_marker.translation)
    sx_mm, sy_mm, sz_mm = 1000 * np.sqrt(np.diag(pose.covariance)[:3])
    x, y = with_deviation(x_mm, sx_mm, "+"), with_deviation(y_mm, sy_mm, "+")
    return f", x {x}, y {y}, z {with_deviation(z_mm, sz_mm)} mm"


def _remarks(marker: MarkerResult) -> list[str]:
    seen, pose = marker.detection, marker.pose
    remarks = [
        (seen.hamming > 0, f", {seen.hamming} wrong bits"),
        (seen.is_inverted, ", inverted"),
        (seen.touches_border, ", touches the border"),
        (seen.is_duplicate, ", found more than once"),
    ]
    if pose is not None and pose.hypotheses and pose.ambiguity > _AMBIGUOUS:
        remarks.append((True, f", flipped with probability {pose.ambiguity:.0%}"))
    return [text for applies, text in remarks if applies]

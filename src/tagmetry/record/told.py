"""Results as lines of the contract, and back."""

from collections.abc import Iterable

import numpy as np
from pydantic import ValidationError

from tagmetry.detect.detection import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.pose.result import MarkerPose, PoseHypothesis
from tagmetry.record.line import ImageLine, MarkerLine, Number, PoseLine, first_complaint, printable
from tagmetry.record.result import ImageResult, MarkerResult


def to_line(result: ImageResult) -> ImageLine:
    """Return a result as it is written.

    Raises:
        InputError: It cannot be written, such as an image whose time is not finite.
    """
    try:
        return ImageLine(
            source=printable(result.source),
            sequence=int(result.sequence),
            time_s=float(result.time_s),
            time_kind=result.time_kind,
            width=result.width_px,
            height=result.height_px,
            markers=[_marker_line(marker) for marker in result.markers],
        )
    except ValidationError as error:
        raise InputError(f"this result cannot be written: {first_complaint(error)}") from None


def from_line(line: ImageLine) -> ImageResult:
    """Return the result that a line tells of; the inverse of `to_line`."""
    markers = tuple(_marker_result(marker) for marker in line.markers)
    return ImageResult(
        line.source, line.sequence, line.time_s, line.time_kind, line.width, line.height, markers
    )


def quaternion_xyzw(T_camera_marker: RigidTransform) -> Array:
    """Return the rotation as a unit quaternion with w >= 0, shape (4,)."""
    return np.asarray(T_camera_marker.rotation.as_quat(canonical=True)) + 0.0  # no -0.0


def _marker_line(marker: MarkerResult) -> MarkerLine:
    seen, pose = marker.detection, marker.pose
    line = MarkerLine(
        family=seen.family,
        id=int(seen.id),
        corners_px=_numbers(seen.corners_px),
        corners_cov_px2=_numbers(seen.corners_cov_px2),
        hamming=int(seen.hamming),
        confidence=_number(seen.confidence),
        is_inverted=bool(seen.is_inverted),
        touches_border=bool(seen.touches_border),
        is_duplicate=bool(seen.is_duplicate),
    )
    if pose is None:
        return line
    found = [_pose_line(hypothesis) for hypothesis in pose.hypotheses]
    return line.model_copy(update={"size_m": _number(pose.size_m), "poses": found})


def _pose_line(found: PoseHypothesis) -> PoseLine:
    return PoseLine(
        rotation_xyzw=quaternion_xyzw(found.T_camera_marker).tolist(),
        translation_m=np.asarray(found.T_camera_marker.translation).tolist(),
        covariance=_numbers(found.covariance),
        reprojection_rms_px=_number(found.reprojection_rms_px),
        probability=_number(found.probability),
        chi2=_number(found.chi2),
    )


def _marker_result(line: MarkerLine) -> MarkerResult:
    detection = Detection(
        line.family,
        line.id,
        _array(line.corners_px),
        _array(line.corners_cov_px2),
        line.hamming,
        _float(line.confidence),
        line.is_inverted,
        line.touches_border,
        line.is_duplicate,
    )
    if line.poses is None:
        return MarkerResult(detection)
    hypotheses = tuple(_hypothesis(pose) for pose in line.poses)
    return MarkerResult(
        detection, MarkerPose(line.family, line.id, _float(line.size_m), hypotheses)
    )


def _hypothesis(line: PoseLine) -> PoseHypothesis:
    rotation = Rotation.from_quat(line.rotation_xyzw)
    return PoseHypothesis(
        RigidTransform.from_components(line.translation_m, rotation),
        _array(line.covariance),
        _float(line.reprojection_rms_px),
        _float(line.chi2),
        _float(line.probability),
    )


def _number(value: float) -> Number:
    return float(value) if np.isfinite(value) else None


def _finite(number: Number) -> Number:
    return None if number is None else _number(number)


def _numbers(matrix: Array) -> list[list[Number]]:
    rows: list[list[Number]] = np.asarray(matrix, dtype=np.float64).tolist()
    return rows if np.isfinite(matrix).all() else [list(map(_finite, row)) for row in rows]


def _float(number: Number) -> float:
    return float("nan") if number is None else number


def _array(rows: Iterable[Iterable[Number]]) -> Array:
    return np.array([[_float(number) for number in row] for row in rows])

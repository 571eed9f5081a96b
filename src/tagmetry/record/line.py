"""The contract: what one image looks like in a file, key by key.

Every format that keeps everything (JSON lines, Parquet) is this model, written in its own way. A
number that is not known (NaN, infinite) is null in the file, and NaN when it is read.
"""

from collections.abc import Iterable
from typing import Annotated

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError
from pydantic.types import FiniteFloat

from tagmetry.camera.image import TimeKind
from tagmetry.detect.detection import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.pose.result import MarkerPose, PoseHypothesis
from tagmetry.record.result import ImageResult, MarkerResult


def _of_unit_length(quaternion: list[float]) -> list[float]:
    if abs(np.linalg.norm(quaternion) - 1.0) > 1e-3:
        raise ValueError(f"expected a quaternion of length 1, got {quaternion}")
    return quaternion


Number = float | None
Count = Annotated[int, Field(ge=0, lt=2**63)]
Size = Annotated[int, Field(ge=1, lt=2**31)]
Point = Annotated[list[Number], Field(min_length=2, max_length=2)]
Corners = Annotated[list[Point], Field(min_length=4, max_length=4)]
Row6 = Annotated[list[Number], Field(min_length=6, max_length=6)]
Matrix6 = Annotated[list[Row6], Field(min_length=6, max_length=6)]
Row8 = Annotated[list[Number], Field(min_length=8, max_length=8)]
Matrix8 = Annotated[list[Row8], Field(min_length=8, max_length=8)]
Vector = Annotated[list[FiniteFloat], Field(min_length=3, max_length=3)]
Quaternion = Annotated[
    list[FiniteFloat], Field(min_length=4, max_length=4), AfterValidator(_of_unit_length)
]


class _Strict(BaseModel):
    """Numbers are numbers and texts are texts; keys of a later version are passed over."""

    model_config = ConfigDict(strict=True, frozen=True)


class PoseLine(_Strict):
    """One hypothesis of `T_camera_marker`; w of the quaternion is not negative."""

    rotation_xyzw: Quaternion
    translation_m: Vector
    covariance: Matrix6
    reprojection_rms_px: Number
    probability: Number
    chi2: Number = None


class MarkerLine(_Strict):
    """One marker; `poses` is absent where none was asked for, and empty where there is none."""

    family: str
    id: Count
    corners_px: Corners
    corners_cov_px2: Matrix8
    hamming: Count
    confidence: Number = None
    is_inverted: bool = False
    touches_border: bool = False
    is_duplicate: bool = False
    size_m: Number = None
    poses: list[PoseLine] | None = None


class ImageLine(_Strict):
    """One image."""

    source: str
    sequence: Count
    time_s: FiniteFloat
    time_kind: TimeKind = "none"
    width: Size
    height: Size
    markers: list[MarkerLine]


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


def printable(text: str) -> str:
    """Return a text that UTF-8 can hold: file names need not be any text at all."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def first_complaint(error: ValidationError) -> str:
    """Return what is wrong and where, in one line."""
    first = error.errors(include_url=False, include_input=False)[0]
    where = ".".join(map(str, first["loc"]))
    return f"{where}: {first['msg']}" if where else str(first["msg"])


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


def _numbers(matrix: Array) -> list[list[Number]]:
    return [[_number(value) for value in row] for row in np.asarray(matrix).tolist()]


def _float(number: Number) -> float:
    return float("nan") if number is None else number


def _array(rows: Iterable[Iterable[Number]]) -> Array:
    return np.array([[_float(number) for number in row] for row in rows])

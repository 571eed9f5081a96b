"""The contract: what one image looks like in a file, key by key.

Every format that keeps everything (JSON lines, Parquet) is this model, written in its own way. A
number that is not known (NaN, infinite) is null in the file, and NaN when it is read.
"""

from typing import Annotated

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError
from pydantic.types import FiniteFloat

from tagmetry.camera.image import TimeKind


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


def printable(text: str) -> str:
    """Return a text that UTF-8 can hold: file names need not be any text at all."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def first_complaint(error: ValidationError) -> str:
    """Return what is wrong and where, in one line."""
    first = error.errors(include_url=False, include_input=False)[0]
    where = ".".join(map(str, first["loc"]))
    return f"{where}: {first['msg']}" if where else str(first["msg"])

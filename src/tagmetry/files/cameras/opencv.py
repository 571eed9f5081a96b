"""OpenCV FileStorage YAML or JSON, under the names that calibration programs write.

OpenCV's own calibration sample marks a fisheye lens with `fisheye_model: 1`, and so do we.
"""

import numpy as np
from pydantic import AliasChoices, Field

from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.errors import InputError
from tagmetry.files.cameras.matrix import Matrix, coefficients, intrinsics
from tagmetry.files.cameras.section import Section, completed, section_of
from tagmetry.files.checked import FileModel, checked
from tagmetry.files.filestorage import OpenCVMatrix, filestorage_text
from tagmetry.files.tables import Table

_MATRIX_NAMES = ("camera_matrix", "cameraMatrix", "K")
_DISTORTION_NAMES = (
    "distortion_coefficients", "dist_coeffs", "dist_coeff", "distCoeffs", "distortionCoefficients",
    "D",
)  # fmt: skip


class _Calibration(FileModel):
    image_width: int
    image_height: int
    camera_matrix: Matrix = Field(validation_alias=AliasChoices(*_MATRIX_NAMES))
    distortion_coefficients: Matrix = Field(validation_alias=AliasChoices(*_DISTORTION_NAMES))
    fisheye_model: int | bool = False
    tagmetry: Section = Field(default_factory=Section)


def is_opencv(table: Table) -> bool:
    """Say whether a table is a calibration from OpenCV."""
    return any(name in table for name in _MATRIX_NAMES)


def camera_from_opencv(table: Table) -> Camera:
    """Return the camera of an OpenCV calibration."""
    _check_size_is_there(table)
    calibration = checked(_Calibration, table)
    lens = FisheyeLens if calibration.fisheye_model else BrownLens
    camera = Camera.from_matrix(
        calibration.image_width,
        calibration.image_height,
        intrinsics(calibration.camera_matrix),
        lens(coefficients(calibration.distortion_coefficients)),
    )
    return completed(camera, calibration.tagmetry)


def opencv_text(camera: Camera, *, as_json: bool) -> str:
    """Return the text of an OpenCV calibration."""
    column = np.array(camera.lens.coefficients, dtype=np.float64).reshape(-1, 1)
    table: Table = {
        "image_width": camera.width_px,
        "image_height": camera.height_px,
        "fisheye_model": int(camera.lens.kind == "fisheye"),
        "camera_matrix": OpenCVMatrix(camera.matrix),
        "distortion_coefficients": OpenCVMatrix(column),
        "tagmetry": {"name": camera.name} | section_of(camera),
    }
    return filestorage_text(table, as_json=as_json)


def _check_size_is_there(table: Table) -> None:
    missing = [name for name in ("image_width", "image_height") if name not in table]
    if missing:
        raise InputError(
            f"{' and '.join(missing)} missing: intrinsics belong to images of one size; add the "
            "size in pixels that the camera was calibrated at"
        )

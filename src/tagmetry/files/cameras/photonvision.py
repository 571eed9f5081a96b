"""PhotonVision's calibration JSON: the size as fractions, matrices as rows, columns and numbers.

Its pixels are OpenCV's. It has no fisheye model; what it does not know it passes over.
"""

import json

from pydantic import Field

from tagmetry.camera import BrownLens, Camera
from tagmetry.errors import InputError
from tagmetry.files.cameras.matrix import Matrix, coefficients, intrinsics
from tagmetry.files.cameras.section import Section, completed, section_of
from tagmetry.files.cameras.size import whole_pixels
from tagmetry.files.checked import FileModel, checked
from tagmetry.files.tables import Table

_DOUBLES = 6  # OpenCV's CV_64FC1


class _Resolution(FileModel):
    width: float
    height: float


class _Calibration(FileModel):
    resolution: _Resolution
    cameraIntrinsics: Matrix  # noqa: N815
    distCoeffs: Matrix  # noqa: N815
    lensmodel: str = "LENSMODEL_OPENCV"
    tagmetry: Section = Field(default_factory=Section)


def is_photonvision(table: Table) -> bool:
    """Say whether a table is a calibration of PhotonVision."""
    return "cameraIntrinsics" in table


def camera_from_photonvision(table: Table) -> Camera:
    """Return the camera of a PhotonVision calibration."""
    found = checked(_Calibration, table)
    if found.lensmodel != "LENSMODEL_OPENCV":
        raise InputError(
            f"expected the lensmodel LENSMODEL_OPENCV, found {found.lensmodel!r}, whose projection "
            "this package does not have; calibrate with OpenCV's model"
        )
    camera = Camera.from_matrix(
        whole_pixels("resolution.width", found.resolution.width),
        whole_pixels("resolution.height", found.resolution.height),
        intrinsics(found.cameraIntrinsics),
        BrownLens(coefficients(found.distCoeffs)),
    )
    return completed(camera, found.tagmetry)


def photonvision_text(camera: Camera) -> str:
    """Return the text of a PhotonVision calibration, without the observations that led to it."""
    if camera.lens.kind != "brown":
        raise InputError(
            "PhotonVision has no fisheye model; save this camera in the format ros, opencv or "
            "kalibr"
        )
    numbers = [float(number) for number in camera.lens.coefficients]
    table: Table = {
        "resolution": {"width": float(camera.width_px), "height": float(camera.height_px)},
        "cameraIntrinsics": _matrix(3, 3, camera.matrix.ravel().tolist()),
        "distCoeffs": _matrix(1, len(numbers), numbers),
        "calobjectWarp": [0.0, 0.0],
        "observations": [],
        "calobjectSize": {"width": 0.0, "height": 0.0},
        "calobjectSpacing": 0.0,
        "lensmodel": "LENSMODEL_OPENCV",
        "tagmetry": {"name": camera.name} | section_of(camera),
    }
    return json.dumps(table, indent=2, ensure_ascii=False) + "\n"


def _matrix(rows: int, columns: int, numbers: list[float]) -> Table:
    return {"rows": rows, "cols": columns, "type": _DOUBLES, "data": numbers}

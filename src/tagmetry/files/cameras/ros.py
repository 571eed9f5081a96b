"""ROS `camera_info` YAML, as its camera calibrators write it and its drivers read it.

`plumb_bob` has 5 coefficients there, so fewer are padded with zeros and the section `tagmetry`
keeps their number; `rational_polynomial` has 8, and 12 or 14 for OpenCV's longer models.
"""

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import BeforeValidator, Field

from tagmetry.camera import Camera
from tagmetry.files.cameras.lenses import named_lens
from tagmetry.files.cameras.matrix import Matrix, coefficients, intrinsics
from tagmetry.files.cameras.section import Section, completed, meant, section_of
from tagmetry.files.checked import FileModel, checked
from tagmetry.files.plain import word_of
from tagmetry.files.tables import Table
from tagmetry.files.yaml_writer import yaml_of
from tagmetry.geometry.arrays import Array


class _CameraInfo(FileModel):
    image_width: int
    image_height: int
    camera_matrix: Matrix
    distortion_model: str
    distortion_coefficients: Matrix
    camera_name: Annotated[str, BeforeValidator(word_of)] = "camera"
    tagmetry: Section = Field(default_factory=Section)


def is_ros(table: Table) -> bool:
    """Say whether a table is a ROS camera file."""
    return "distortion_model" in table


def camera_from_ros(table: Table) -> Camera:
    """Return the camera of a ROS camera file."""
    info = checked(_CameraInfo, table)
    lens = named_lens(
        info.distortion_model,
        meant(coefficients(info.distortion_coefficients), info.tagmetry),
        brown=("plumb_bob", "rational_polynomial"),
        fisheye=("equidistant",),
    )
    K = intrinsics(info.camera_matrix)
    camera = Camera.from_matrix(info.image_width, info.image_height, K, lens)
    return completed(replace(camera, name=info.camera_name), info.tagmetry)


def ros_text(camera: Camera) -> str:
    """Return the text of a ROS camera file."""
    model, padded = _ros_lens(camera)
    K = camera.matrix
    table: Table = {
        "image_width": camera.width_px,
        "image_height": camera.height_px,
        "camera_name": camera.name,
        "camera_matrix": _matrix(K),
        "distortion_model": model,
        "distortion_coefficients": _matrix(np.array([padded])),
        "rectification_matrix": _matrix(np.eye(3)),
        "projection_matrix": _matrix(np.column_stack([K, np.zeros(3)])),
    }
    section = section_of(camera)
    if len(padded) != len(camera.lens.coefficients):
        section["coefficient_count"] = len(camera.lens.coefficients)
    return yaml_of(table | ({"tagmetry": section} if section else {}))


def _ros_lens(camera: Camera) -> tuple[str, list[float]]:
    numbers = [float(number) for number in camera.lens.coefficients]
    if camera.lens.kind == "fisheye":
        return "equidistant", numbers
    if len(numbers) <= 5:
        return "plumb_bob", numbers + [0.0] * (5 - len(numbers))
    return "rational_polynomial", numbers


def _matrix(values: Array) -> Table:
    rows, columns = values.shape
    return {"rows": rows, "cols": columns, "data": values.ravel().tolist()}

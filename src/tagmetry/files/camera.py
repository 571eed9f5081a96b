"""Camera files in and out, in the formats of others, told apart by their content."""

from collections.abc import Callable
from pathlib import Path
from typing import Literal, get_args

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.files.atomic import write_atomically
from tagmetry.files.cameras.colmap import camera_from_colmap, colmap_text, is_colmap
from tagmetry.files.cameras.kalibr import camera_from_kalibr, is_kalibr, kalibr_text
from tagmetry.files.cameras.mrcal import camera_from_mrcal, is_mrcal, mrcal_text
from tagmetry.files.cameras.opencv import camera_from_opencv, is_opencv, opencv_text
from tagmetry.files.cameras.photonvision import (
    camera_from_photonvision,
    is_photonvision,
    photonvision_text,
)
from tagmetry.files.cameras.ros import camera_from_ros, is_ros, ros_text
from tagmetry.files.plain import shortened
from tagmetry.files.tables import Table, parse_table
from tagmetry.files.text import named_errors, read_text

CameraFormat = Literal["ros", "opencv", "kalibr", "mrcal", "photonvision", "colmap"]


def load_camera(path: str | Path, name: str | None = None) -> Camera:
    """Return the camera of a file from ROS, OpenCV, Kalibr, mrcal, PhotonVision or COLMAP.

    Args:
        path: `camera_info` YAML, FileStorage YAML or JSON, camchain YAML, `.cameramodel`,
            calibration JSON, or `cameras.txt`.
        name: Which camera of a file with several (Kalibr, COLMAP); the first when not given.

    Raises:
        InputError: The file is missing or broken, or describes no camera of this package's models.
    """
    path = Path(path)
    text = read_text(path)
    with named_errors(path):
        return _camera_of(text, name)


def save_camera(camera: Camera, path: str | Path, format: CameraFormat = "ros") -> None:  # noqa: A002
    """Write a camera; it reads back exactly, but for COLMAP's shift by half a pixel to 1e-16.

    Args:
        camera: What is written; what the format has no place for stands in a section `tagmetry`.
        path: Replaced as a whole. OpenCV's format becomes JSON where the name ends in `.json`, and
            PhotonVision's must end so.
        format: Whose format it is.

    Raises:
        InputError: The format cannot hold this camera, or the file cannot be written.
    """
    path = Path(path)
    with named_errors(path):
        text = _text(camera, format, path.suffix.lower())
        _camera_of(text, None)  # nothing is written that could not be read again
    write_atomically(path, text)


def _camera_of(text: str, name: str | None) -> Camera:
    if is_mrcal(text):
        return _named(camera_from_mrcal(text), name)
    if is_colmap(text):
        return camera_from_colmap(text, name)
    return _camera(parse_table(text), name)


def _camera(table: Table, name: str | None) -> Camera:
    if is_kalibr(table):
        return camera_from_kalibr(table, name)
    if is_ros(table):
        return _named(camera_from_ros(table), name)
    if is_photonvision(table):
        return _named(camera_from_photonvision(table), name)
    if is_opencv(table):
        return _named(camera_from_opencv(table), name)
    raise InputError(
        "expected a camera file (ROS camera_info, OpenCV calibration, Kalibr camchain, mrcal, "
        "PhotonVision or COLMAP), found "
        f"the keys {shortened(', '.join(table), 80) or 'none'}"
    )


def _named(camera: Camera, name: str | None) -> Camera:
    if name not in (None, camera.name):
        raise InputError(f"there is no camera {name!r}; there is {camera.name}")
    return camera


def _text(camera: Camera, camera_format: CameraFormat, suffix: str) -> str:
    if camera_format not in get_args(CameraFormat):
        known = ", ".join(get_args(CameraFormat))
        raise InputError(f"unknown camera format {camera_format!r}; there are {known}")
    if camera_format == "opencv":
        return opencv_text(camera, as_json=suffix == ".json")
    if (suffix == ".json") != (camera_format == "photonvision"):
        kind, ending = _KINDS[camera_format]
        raise InputError(f"the format {camera_format} is {kind}; name the file {ending}")
    return _WRITERS[camera_format](camera)


_WRITERS: dict[CameraFormat, Callable[[Camera], str]] = {
    "ros": ros_text,
    "kalibr": kalibr_text,
    "mrcal": mrcal_text,
    "photonvision": photonvision_text,
    "colmap": colmap_text,
}
_KINDS: dict[CameraFormat, tuple[str, str]] = {
    "ros": ("YAML", ".yaml"),
    "kalibr": ("YAML", ".yaml"),
    "mrcal": ("a Python literal", ".cameramodel"),
    "photonvision": ("JSON", ".json"),
    "colmap": ("text", "cameras.txt"),
}

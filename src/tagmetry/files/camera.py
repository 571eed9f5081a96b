"""Camera files in and out: ROS, OpenCV and Kalibr, told apart by their content."""

from pathlib import Path
from typing import Literal, get_args

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.files.atomic import write_atomically
from tagmetry.files.cameras.kalibr import camera_from_kalibr, is_kalibr, kalibr_text
from tagmetry.files.cameras.opencv import camera_from_opencv, is_opencv, opencv_text
from tagmetry.files.cameras.ros import camera_from_ros, is_ros, ros_text
from tagmetry.files.plain import shortened
from tagmetry.files.tables import Table, load_table, parse_table
from tagmetry.files.text import named_errors

CameraFormat = Literal["ros", "opencv", "kalibr"]


def load_camera(path: str | Path, name: str | None = None) -> Camera:
    """Return the camera of a ROS camera_info, OpenCV FileStorage or Kalibr camchain file.

    Args:
        path: YAML or JSON.
        name: Which camera of a Kalibr file with several; the first one when not given.

    Raises:
        InputError: The file is missing or broken, or describes no camera of this package's models.
    """
    table = load_table(path)
    with named_errors(Path(path)):
        return _camera(table, name)


def save_camera(camera: Camera, path: str | Path, format: CameraFormat = "ros") -> None:  # noqa: A002
    """Write a camera; it reads back exactly.

    Args:
        camera: What is written; what the format has no place for stands in a section `tagmetry`.
        path: Replaced as a whole. OpenCV's format becomes JSON where the name ends in `.json`.
        format: Whose format it is.

    Raises:
        InputError: The format cannot hold this camera, or the file cannot be written.
    """
    path = Path(path)
    with named_errors(path):
        text = _text(camera, format, path.suffix.lower())
        _camera(parse_table(text), None)  # nothing is written that could not be read again
    write_atomically(path, text)


def _camera(table: Table, name: str | None) -> Camera:
    if is_kalibr(table):
        return camera_from_kalibr(table, name)
    if is_ros(table):
        return _named(camera_from_ros(table), name)
    if is_opencv(table):
        return _named(camera_from_opencv(table), name)
    raise InputError(
        "expected a camera file (ROS camera_info, OpenCV calibration or Kalibr camchain), found "
        f"the keys {shortened(', '.join(table), 80) or 'none'}"
    )


def _named(camera: Camera, name: str | None) -> Camera:
    if name not in (None, camera.name):
        raise InputError(f"there is no camera {name!r}; there is {camera.name}")
    return camera


def _text(camera: Camera, camera_format: CameraFormat, suffix: str) -> str:
    if camera_format == "opencv":
        return opencv_text(camera, as_json=suffix == ".json")
    if suffix == ".json":
        raise InputError(f"the format {camera_format} is YAML; name the file .yaml")
    if camera_format == "ros":
        return ros_text(camera)
    if camera_format == "kalibr":
        return kalibr_text(camera)
    raise InputError(
        f"unknown camera format {camera_format!r}; there are {', '.join(get_args(CameraFormat))}"
    )

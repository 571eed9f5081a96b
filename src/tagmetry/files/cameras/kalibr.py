"""Kalibr's camchain YAML: `cam0`, `cam1` and so on, one table for each camera.

Of its models, `pinhole` with `radtan` (4 coefficients), `equidistant` (4) or `none` is this
package's camera. Our section stands inside the camera's table, where Kalibr passes it over.
"""

from pydantic import Field

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.files.cameras.lenses import named_lens
from tagmetry.files.cameras.section import Section, completed, section_of
from tagmetry.files.checked import FileModel, checked
from tagmetry.files.tables import Table
from tagmetry.files.text import named_errors
from tagmetry.files.yaml_writer import yaml_of

_COUNTS = {"radtan": 4, "equidistant": 4, "none": 0}


class _KalibrCamera(FileModel):
    camera_model: str
    intrinsics: list[float]
    distortion_model: str
    distortion_coeffs: list[float]
    resolution: list[int]
    tagmetry: Section = Field(default_factory=Section)


def is_kalibr(table: Table) -> bool:
    """Say whether a table is a Kalibr camchain."""
    return bool(_cameras(table))


def camera_from_kalibr(table: Table, name: str | None = None) -> Camera:
    """Return one camera of a camchain, the first one unless another is named."""
    cameras = _cameras(table)
    key = next(iter(cameras)) if name is None else name
    if key not in cameras:
        raise InputError(f"there is no camera {key!r}; there are {', '.join(cameras)}")
    with named_errors(key):
        return _camera(key, checked(_KalibrCamera, cameras[key]))


def kalibr_text(camera: Camera) -> str:
    """Return the text of a camchain with this one camera."""
    table: Table = {
        "camera_model": "pinhole",
        "intrinsics": [float(number) for number in (*camera.focal_px, *camera.center_px)],
        "distortion_model": _kalibr_lens(camera),
        "distortion_coeffs": [float(number) for number in camera.lens.coefficients],
        "resolution": [camera.width_px, camera.height_px],
        "tagmetry": {"name": camera.name} | section_of(camera),
    }
    return yaml_of({"cam0": table})


def _cameras(table: Table) -> dict[str, Table]:
    return {
        key: value
        for key, value in table.items()
        if isinstance(value, dict) and {"camera_model", "intrinsics"} & set(value)
    }


def _camera(key: str, found: _KalibrCamera) -> Camera:
    if found.camera_model != "pinhole":
        raise InputError(
            f"expected the camera model pinhole, found {found.camera_model!r}, whose projection "
            "this package does not have; calibrate with pinhole-radtan or pinhole-equi"
        )
    _check_counts(found)
    model, coefficients = found.distortion_model, tuple(found.distortion_coeffs)
    lens = named_lens(model, coefficients, brown=("radtan", "none"), fisheye=("equidistant",))
    fx, fy, cx, cy = found.intrinsics
    width_px, height_px = found.resolution
    camera = Camera(width_px, height_px, (fx, fy), (cx, cy), lens, name=key)
    return completed(camera, found.tagmetry)


def _check_counts(found: _KalibrCamera) -> None:
    expected = {"intrinsics": 4, "resolution": 2}
    expected["distortion_coeffs"] = _COUNTS.get(found.distortion_model, 4)
    for field, count in expected.items():
        numbers = getattr(found, field)
        if len(numbers) != count:
            raise InputError(f"{field}: expected {count} numbers, found {len(numbers)}")


def _kalibr_lens(camera: Camera) -> str:
    count = len(camera.lens.coefficients)
    if camera.lens.kind == "fisheye":
        return "equidistant"
    if count not in (0, 4):
        raise InputError(
            f"Kalibr's radtan has 4 distortion coefficients, this camera has {count}; save it in "
            "the format ros or opencv"
        )
    return "radtan" if count else "none"

"""mrcal's .cameramodel: a Python literal, of which LENSMODEL_OPENCV4, 5, 8 and 12 are ours.

Its pixels are OpenCV's. The pose and whatever else the file holds is passed over; what is written
stands at the origin.
"""

import ast
import re
import warnings

from tagmetry.camera import BrownLens, Camera
from tagmetry.errors import InputError
from tagmetry.files.cameras.comment import commented_section, section_comment
from tagmetry.files.cameras.section import completed
from tagmetry.files.checked import FileModel, checked
from tagmetry.files.plain import shortened
from tagmetry.files.text import DEEPEST_NESTING

_COUNTS = {
    "LENSMODEL_PINHOLE": 0,
    "LENSMODEL_OPENCV4": 4,
    "LENSMODEL_OPENCV5": 5,
    "LENSMODEL_OPENCV8": 8,
    "LENSMODEL_OPENCV12": 12,
}
_KEY = re.compile(r"""^\s*b?['"]lens_?model['"]\s*:""", re.MULTILINE)
_PASSED_OVER = re.compile(r"""'(?:[^'\\\n]|\\.)*+'?|"(?:[^"\\\n]|\\.)*+"?|\#[^\n]*""")
_BRACKETS = re.compile(r"[\[({]|[\])}]")
_MANY_SIGNS = re.compile(rf"(?:[-+~]\s*+){{{DEEPEST_NESTING}}}")


class _Model(FileModel):
    lensmodel: str
    intrinsics: list[float]
    imagersize: list[int]


def is_mrcal(text: str) -> bool:
    """Say whether a text is a .cameramodel: a literal with a lens model, and not PhotonVision's."""
    return _KEY.search(text) is not None and '"cameraIntrinsics"' not in text


def camera_from_mrcal(text: str) -> Camera:
    """Return the camera of a .cameramodel."""
    table = _literal(text)
    if "lens_model" in table:  # its name until 2020
        table["lensmodel"] = table.pop("lens_model")
    found = checked(_Model, table)
    if found.lensmodel not in _COUNTS:
        raise InputError(
            f"the lens model {shortened(found.lensmodel)!r} is not one of this package's; there "
            f"are {', '.join(_COUNTS)}"
        )
    _check_count("intrinsics", found.intrinsics, 4 + _COUNTS[found.lensmodel])
    _check_count("imagersize", found.imagersize, 2)
    fx, fy, cx, cy, *numbers = found.intrinsics
    width_px, height_px = found.imagersize
    camera = Camera(width_px, height_px, (fx, fy), (cx, cy), BrownLens(tuple(numbers)))
    return completed(camera, commented_section(text))


def mrcal_text(camera: Camera) -> str:
    """Return the text of a .cameramodel at the origin."""
    numbers = [*camera.focal_px, *camera.center_px, *camera.lens.coefficients]
    written = ", ".join(repr(float(number)) for number in numbers)
    return (
        section_comment(camera) + "{\n"
        f"    'lensmodel':  '{_lensmodel(camera)}',\n"
        "    # intrinsics are fx,fy,cx,cy,distortion0,distortion1,....\n"
        f"    'intrinsics': [ {written} ],\n"
        "    # extrinsics are rt_fromref\n"
        "    'extrinsics': [ 0., 0., 0., 0., 0., 0. ],\n"
        f"    'imagersize': [ {camera.width_px}, {camera.height_px} ]\n"
        "}\n"
    )


def _lensmodel(camera: Camera) -> str:
    count = len(camera.lens.coefficients)
    names = {number: name for name, number in _COUNTS.items()}
    if camera.lens.kind == "fisheye" or count not in names:
        kind = "a fisheye lens" if camera.lens.kind == "fisheye" else f"{count} coefficients"
        raise InputError(
            f"mrcal's OpenCV models have 0, 4, 5, 8 or 12 distortion coefficients, this camera has "
            f"{kind}; save it in the format ros or opencv"
        )
    return names[count]


def _literal(text: str) -> dict[str, object]:
    """Evaluate a Python literal: no names, no calls, not deep since the parser is recursive."""
    _check_depth(text)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # odd escapes in strings that are passed over
            value = ast.literal_eval(text.strip())
    except (SyntaxError, ValueError, TypeError, MemoryError, RecursionError) as error:
        line = getattr(error, "lineno", None)
        where = f"line {line}: " if line else ""
        raise InputError(f"this is no .cameramodel: {where}expected a Python literal") from error
    if not isinstance(value, dict) or not all(isinstance(key, str | bytes) for key in value):
        raise InputError("this is no .cameramodel: expected keys with values in braces")
    return {str(_decoded(key)): _decoded(each) for key, each in value.items()}


def _decoded(value: object) -> object:
    """Return bytes as text: mrcal allows b'…' for names."""
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else value


def _check_depth(text: str) -> None:
    """Count brackets and look for chains of signs, outside strings and comments."""
    bare, depth = _PASSED_OVER.sub("", text), 0
    for match in _BRACKETS.finditer(bare):
        depth += 1 if match[0] in "[({" else -1
        if depth > DEEPEST_NESTING:
            raise InputError(f"nested deeper than {DEEPEST_NESTING} levels")
    if _MANY_SIGNS.search(bare):
        raise InputError("expected numbers, found a long chain of signs")


def _check_count(field: str, numbers: list[float] | list[int], expected: int) -> None:
    if len(numbers) != expected:
        raise InputError(f"{field}: expected {expected} numbers, found {len(numbers)}")

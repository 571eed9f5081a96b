"""COLMAP's cameras.txt: `ID MODEL WIDTH HEIGHT PARAMETERS…`, one line for each camera.

COLMAP's pixel (0.5, 0.5) is the centre of the first pixel, ours is (0, 0): its principal point is
half a pixel larger. Missing coefficients of its short models are zero here.
"""

import re
from dataclasses import replace

import numpy as np

from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.errors import InputError
from tagmetry.files.cameras.comment import commented_section, section_comment
from tagmetry.files.cameras.section import completed, meant
from tagmetry.files.cameras.size import whole_pixels
from tagmetry.files.plain import plain_value, shortened
from tagmetry.files.text import named_errors

_HALF_A_PIXEL = 0.5
_LINE = re.compile(r"^[ \t]*\d+[ \t]+[A-Z][A-Z_0-9]*(?:[ \t]+\S+){3,}[ \t]*$", re.ASCII)

# model: how many focal lengths, how many coefficients, whether a fisheye lens
_MODELS = {
    "SIMPLE_PINHOLE": (1, 0, False),
    "PINHOLE": (2, 0, False),
    "SIMPLE_RADIAL": (1, 1, False),
    "RADIAL": (1, 2, False),
    "OPENCV": (2, 4, False),
    "FULL_OPENCV": (2, 8, False),
    "SIMPLE_RADIAL_FISHEYE": (1, 1, True),
    "RADIAL_FISHEYE": (1, 2, True),
    "OPENCV_FISHEYE": (2, 4, True),
}
_WRITTEN = {0: "PINHOLE", 4: "OPENCV", 5: "FULL_OPENCV", 8: "FULL_OPENCV"}


def is_colmap(text: str) -> bool:
    """Say whether the first line that is no comment is a camera of COLMAP."""
    return any(_LINE.match(line) for line in _lines(text)[:1])


def camera_from_colmap(text: str, name: str | None = None) -> Camera:
    """Return one camera of the text, the first one unless another is named by its number."""
    rows = {words[0]: words for words in (line.split() for line in _lines(text))}
    section = commented_section(text)
    key = next(iter(rows)) if name in (None, section.name) else str(name)
    if key not in rows:
        raise InputError(f"there is no camera {key!r}; there are {shortened(', '.join(rows), 80)}")
    with named_errors(f"camera {key}"):
        camera = _camera(rows[key])
        if len(rows) > 1:
            return camera
        lens = replace(camera.lens, coefficients=meant(camera.lens.coefficients, section))  # type: ignore[type-var]
        return completed(replace(camera, lens=lens), section)


def colmap_text(camera: Camera) -> str:
    """Return the text of a cameras.txt with this one camera."""
    count = len(camera.lens.coefficients)
    model = "OPENCV_FISHEYE" if camera.lens.kind == "fisheye" else _WRITTEN.get(count)
    if model is None:
        raise InputError(
            f"COLMAP's models have up to 8 distortion coefficients, this camera has {count}; save "
            "it in the format ros or opencv"
        )
    padding = (0.0,) * (_MODELS[model][1] - count)
    cx, cy = camera.center_px
    shifted = (cx + _HALF_A_PIXEL, cy + _HALF_A_PIXEL)
    numbers = (*camera.focal_px, *shifted, *camera.lens.coefficients, *padding)
    words = [model, camera.width_px, camera.height_px, *(repr(float(n)) for n in numbers)]
    return (
        "# Camera list with one line of data per camera:\n"
        "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
        + section_comment(camera, count if padding else None)
        + f"1 {' '.join(map(str, words))}\n"
    )


def _lines(text: str) -> list[str]:
    stripped = (line.strip() for line in text.splitlines())
    return [line for line in stripped if line and not line.startswith("#")]


def _camera(words: list[str]) -> Camera:
    if len(words) < 4 or words[1] not in _MODELS:
        raise InputError(
            f"expected ID MODEL WIDTH HEIGHT PARAMETERS with a model of {', '.join(_MODELS)}, "
            f"found {shortened(' '.join(words))!r}"
        )
    focal_count, coefficient_count, is_fisheye = _MODELS[words[1]]
    width_px, height_px, *numbers = [_number(word) for word in words[2:]]
    expected = focal_count + 2 + coefficient_count
    if len(numbers) != expected:
        raise InputError(f"{words[1]} has {expected} parameters, found {len(numbers)}")
    focal, center = numbers[:focal_count], np.array(numbers[focal_count : focal_count + 2])
    cx, cy = (float(number) for number in center - _HALF_A_PIXEL)
    lens = _lens(tuple(numbers[focal_count + 2 :]), is_fisheye)
    size = whole_pixels("WIDTH", width_px), whole_pixels("HEIGHT", height_px)
    return Camera(*size, (focal[0], focal[-1]), (cx, cy), lens, name=words[0])


def _lens(coefficients: tuple[float, ...], is_fisheye: bool) -> Lens:
    padded = coefficients + (0.0,) * (4 - len(coefficients))
    if is_fisheye:
        return FisheyeLens(padded)
    return BrownLens(padded if coefficients else ())


def _number(word: str) -> float:
    value = plain_value(word)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(f"expected a number, found {shortened(word)!r}")
    return value

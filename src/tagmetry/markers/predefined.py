"""The marker families that everyone has, under the field's names.

The codes are OpenCV's tables, and those of `apriltag3`. Two things are ours:

* **Which way is up.** OpenCV's AprilTag pictures are turned by 180 degrees against those of the
  AprilTag project. An AprilTag's own top left is here that of the AprilTag project, whose pictures
  most printed tags come from; ArUco markers are as OpenCV prints them.
* **Correction bits.** OpenCV's wheels have shipped wrong ones, so they are set here, never above
  what the family's minimum distance allows.
"""

import re
from functools import lru_cache

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels, BoolArray
from tagmetry.markers.apriltag3 import APRILTAG3, apriltag3_family
from tagmetry.markers.family import MarkerFamily
from tagmetry.markers.layout import Layout

_OPENCV_NAMES = {
    **{
        f"{n}x{n}_{count}": f"DICT_{n}X{n}_{count}"
        for n in (4, 5, 6, 7)
        for count in (50, 100, 250, 1000)
    },
    "aruco_original": "DICT_ARUCO_ORIGINAL",
    "aruco_mip_36h12": "DICT_ARUCO_MIP_36h12",
    "tag16h5": "DICT_APRILTAG_16h5",
    "tag25h9": "DICT_APRILTAG_25h9",
    "tag36h10": "DICT_APRILTAG_36h10",
    "tag36h11": "DICT_APRILTAG_36h11",
}

# (minimum distance over all pairs and turns - 1) // 2; `test_predefined` measures it again.
# aruco_original has markers that equal another one turned: nothing can be corrected there.
_CORRECTION_BITS = {
    "4x4_50": 1, "4x4_100": 1, "4x4_250": 1, "4x4_1000": 0,
    "5x5_50": 3, "5x5_100": 3, "5x5_250": 2, "5x5_1000": 2,
    "6x6_50": 6, "6x6_100": 5, "6x6_250": 5, "6x6_1000": 4,
    "7x7_50": 9, "7x7_100": 8, "7x7_250": 8, "7x7_1000": 6,
    "aruco_original": 0, "aruco_mip_36h12": 5,
    "tag16h5": 2, "tag25h9": 4, "tag36h10": 4, "tag36h11": 5,
}  # fmt: skip

_APRILTAG3_NAMES = {
    spelling.lower(): name for name in APRILTAG3 for spelling in (name, name.removeprefix("tag"))
}

_BORDER_SUFFIX = re.compile(r"^(?P<family>.+)_border(?P<cells>\d)$")


def family_names() -> tuple[str, ...]:
    """Return the names of all predefined families."""
    return (*_OPENCV_NAMES, *APRILTAG3)


@lru_cache(maxsize=64)
def family(name: str) -> MarkerFamily:
    """Return a predefined family.

    Args:
        name: One of `family_names()` in any case; OpenCV's `DICT_…` names and AprilTag 3's without
            `tag` are understood too. The suffix `_border2` asks for the border of two cells that
            Kalibr prints.

    Raises:
        InputError: No family has this name; the text lists those there are.
    """
    plain = _plain_name(name)
    if match := _BORDER_SUFFIX.match(plain):
        return family(match["family"]).with_border(int(match["cells"]))
    if plain in _APRILTAG3_NAMES:
        return apriltag3_family(_APRILTAG3_NAMES[plain])
    if plain not in _OPENCV_NAMES:
        raise InputError(
            f"unknown marker family {name!r}; there are {', '.join(family_names())}, "
            "and those of black squares with a border of two cells, for example tag36h11_border2"
        )
    return _load(plain)


def _plain_name(name: str) -> str:
    """Turn OpenCV's constants, `DICT_APRILTAG_36h11`, and capitals into the names used here."""
    plain = name.strip().lower().removeprefix("dict_")
    return plain.replace("apriltag_", "tag").replace("aruco_mip36", "aruco_mip_36")


def _load(name: str) -> MarkerFamily:
    import cv2

    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, _OPENCV_NAMES[name]))
    codes = _unpacked(dictionary.bytesList, dictionary.markerSize)
    layout = Layout.square(dictionary.markerSize)
    if name.startswith("tag"):
        codes = codes[:, layout.rotations[2]]
    return MarkerFamily(name, layout, codes, _CORRECTION_BITS[name])


def _unpacked(packed: AnyPixels, side_cells: int) -> BoolArray:
    """Return OpenCV's bytes as bits; a last byte that is not full holds its bits at the low end."""
    whole, rest = divmod(side_cells**2, 8)
    upright = np.ascontiguousarray(packed).reshape(len(packed), 4, -1)[:, 0]
    bits = np.unpackbits(upright, axis=1)
    parts = [bits[:, : 8 * whole]]
    if rest:
        parts.append(bits[:, 8 * (whole + 1) - rest : 8 * (whole + 1)])
    return np.concatenate(parts, axis=1).astype(bool)

"""Marker maps from files and into them; whose format it is, the content says."""

from collections.abc import Callable
from pathlib import Path
from typing import Literal, get_args

from tagmetry.errors import InputError
from tagmetry.files.atomic import write_atomically
from tagmetry.files.maps.apriltag_ros import (
    apriltag_ros_text,
    is_apriltag_ros,
    map_from_apriltag_ros,
)
from tagmetry.files.maps.aruco import aruco_text, is_aruco, map_from_aruco, mended
from tagmetry.files.maps.own import is_own, map_from_own, own_text
from tagmetry.files.maps.places import MapDefaults
from tagmetry.files.maps.tagslam import is_tagslam, map_from_tagslam, tagslam_text
from tagmetry.files.maps.wpilib import is_wpilib, map_from_wpilib, wpilib_text
from tagmetry.files.plain import shortened
from tagmetry.files.tables import Table, parse_table
from tagmetry.files.text import named_errors, read_text
from tagmetry.localize import MarkerMap

MapFormat = Literal["tagmetry", "wpilib", "apriltag_ros", "tagslam", "aruco"]
_NOTHING = MapDefaults()


def load_map(
    path: str | Path, defaults: MapDefaults = _NOTHING, bundle: str | None = None
) -> MarkerMap:
    """Return the marker map of a file of ours, WPILib, apriltag_ros, TagSLAM or ArUco.

    Args:
        path: YAML or JSON.
        defaults: Family and size of markers where the file does not say them.
        bundle: Which of the bundles of an apriltag_ros file; not needed where there is one.

    Raises:
        InputError: The file is missing or broken, or describes no map: an id stands there twice, a
            size is impossible, a rotation is none or left-handed.
    """
    path = Path(path)
    text = read_text(path)
    with named_errors(path):
        return _map_of(parse_table(mended(text)), defaults, bundle)


def save_map(marker_map: MarkerMap, path: str | Path, format: MapFormat = "tagmetry") -> None:  # noqa: A002
    """Write a map; what the format has no place for stands in a section `tagmetry`.

    Args:
        marker_map: What is written.
        path: Replaced as a whole; `.json` for WPILib, YAML for the others.
        format: Whose format it is.

    Raises:
        InputError: The format cannot hold this map, or the file cannot be written.
    """
    path = Path(path)
    with named_errors(path):
        text = _text(marker_map, format, path.suffix.lower())
        _map_of(parse_table(text), _NOTHING, None)  # nothing is written that cannot be read again
    write_atomically(path, text)


def _map_of(table: Table, defaults: MapDefaults, bundle: str | None) -> MarkerMap:
    if is_apriltag_ros(table):
        return map_from_apriltag_ros(table, defaults, bundle)
    if bundle is not None:
        raise InputError("only apriltag_ros files have bundles to choose from")
    for is_format, map_from in _READERS:
        if is_format(table):
            return map_from(table, defaults)
    raise InputError(
        "expected a marker map (tagmetry, WPILib field layout, apriltag_ros tags.yaml, TagSLAM or "
        f"ArUco), found the keys {shortened(', '.join(table), 80) or 'none'}"
    )


def _text(marker_map: MarkerMap, map_format: MapFormat, suffix: str) -> str:
    if map_format not in get_args(MapFormat):
        known = ", ".join(get_args(MapFormat))
        raise InputError(f"unknown map format {map_format!r}; there are {known}")
    if (suffix == ".json") != (map_format == "wpilib"):
        ending = ".json" if map_format == "wpilib" else ".yaml"
        raise InputError(f"the format {map_format} is {ending[1:].upper()}; name the file {ending}")
    return _WRITERS[map_format](marker_map)


_READERS: tuple[tuple[Callable[[Table], bool], Callable[[Table, MapDefaults], MarkerMap]], ...] = (
    (is_own, map_from_own),
    (is_wpilib, map_from_wpilib),
    (is_tagslam, map_from_tagslam),
    (is_aruco, map_from_aruco),
)
_WRITERS: dict[MapFormat, Callable[[MarkerMap], str]] = {
    "tagmetry": own_text,
    "wpilib": wpilib_text,
    "apriltag_ros": apriltag_ros_text,
    "tagslam": tagslam_text,
    "aruco": aruco_text,
}

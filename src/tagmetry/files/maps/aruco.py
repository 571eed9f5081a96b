"""Marker maps and boards of the ArUco library: the corners of every marker, metres.

Corners go clockwise from the marker's own top left, as ours. The library leaves out the blank after
`id:`, which is no YAML, and is put in here.
"""

import re

import numpy as np
from pydantic import Field

from tagmetry.errors import InputError
from tagmetry.files.checked import FileModel, checked
from tagmetry.files.maps.places import MapDefaults, rotation_of
from tagmetry.files.maps.section import Found, Notes, section_of
from tagmetry.files.tables import Table
from tagmetry.files.text import named_errors
from tagmetry.files.yaml_writer import yaml_of
from tagmetry.geometry import Array, RigidTransform
from tagmetry.localize import MarkerMap

_NO_BLANK = re.compile(r"\b(id|corners):(?=[\[\d-])")
_FAMILIES = {"ARUCO": "aruco_original", "TAG36h11": "tag36h11", "TAG25h9": "tag25h9"}
_FAMILIES |= {"TAG16h5": "tag16h5", "ARUCO_MIP_36h12": "aruco_mip_36h12"}
_METRES = 1
_SQUARE = 0.02  # by how much a side or a diagonal may be off, as a share of the side


class _Marker(FileModel):
    id: int
    corners: list[list[float]] = Field(min_length=4, max_length=4)


class _Board(FileModel):
    aruco_bc_dict: str | None = None
    aruco_bc_mInfoType: int = _METRES  # noqa: N815
    aruco_bc_markers: list[_Marker] = Field(min_length=1)


def mended(text: str) -> str:
    """Return the text of an ArUco file as YAML."""
    return _NO_BLANK.sub(r"\1: ", text) if "aruco_bc_markers" in text else text


def is_aruco(table: Table) -> bool:
    """Say whether a table is a map or board of the ArUco library."""
    return "aruco_bc_markers" in table


def map_from_aruco(table: Table, defaults: MapDefaults) -> MarkerMap:
    """Return the map of a board."""
    board = checked(_Board, table)
    if board.aruco_bc_mInfoType != _METRES:
        raise InputError(
            "the corners are in pixels of a picture (aruco_bc_mInfoType is not 1); convert the "
            "board to metres first"
        )
    family = _FAMILIES.get(board.aruco_bc_dict or "", board.aruco_bc_dict)
    notes, markers = Notes(table, defaults), []
    for number, one in enumerate(board.aruco_bc_markers):
        with named_errors(f"id {one.id}"):
            if {len(corner) for corner in one.corners} != {3}:
                raise InputError("expected corners of three numbers each")
            T_world_marker, size_m = _pose_and_size(np.array(one.corners))
            found = Found(one.id, T_world_marker)
            markers.append(notes.marker(number, found, family or defaults.family, size_m))
    return MarkerMap(tuple(markers), notes.name)


def aruco_text(marker_map: MarkerMap) -> str:
    """Return the text of a marker map of one family."""
    if len(marker_map.families) > 1:
        listed = ", ".join(marker_map.families)
        raise InputError(f"an ArUco map has one family, this one has {listed}")
    family = marker_map.families[0]
    names = {ours: theirs for theirs, ours in _FAMILIES.items()}
    markers = [{"id": one.id, "corners": one.p_world.tolist()} for one in marker_map.markers]
    table: Table = {
        "aruco_bc_dict": names.get(family, family),
        "aruco_bc_nmarkers": len(markers),
        "aruco_bc_mInfoType": _METRES,
        "aruco_bc_markers": markers,
        "tagmetry": section_of(marker_map),
    }
    return "%YAML:1.0\n---\n" + yaml_of(table)


def _pose_and_size(corners_m: Array) -> tuple[RigidTransform, float]:
    """Return the pose and the side of a square of four corners, shape (4, 3), metres."""
    a, b, c, d = corners_m
    sides = np.linalg.norm([b - a, c - b, d - c, a - d], axis=1)
    size_m = float(sides.mean())
    diagonals = np.linalg.norm([c - a, d - b], axis=1) / np.sqrt(2)
    bent = np.linalg.norm(a - b + c - d)
    off = np.abs(np.concatenate([sides, diagonals]) - size_m).max()
    if size_m == 0 or not max(off, bent) <= _SQUARE * size_m:
        raise InputError(f"the corners {corners_m.tolist()} are not those of a square")
    x, up = (b - a + c - d) / (2 * size_m), (a - d + b - c) / (2 * size_m)
    x = x / np.linalg.norm(x)
    y = up - (up @ x) * x
    y = y / np.linalg.norm(y)
    rotation = rotation_of(np.stack([x, y, np.cross(x, y)], axis=1))
    return RigidTransform.from_components(corners_m.mean(axis=0), rotation), size_m

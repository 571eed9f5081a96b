"""WPILib's field layouts: JSON with ids and poses, without sizes or families.

A tag's frame is there x out of its face, y to its right as one looks at it, z up: our x, y, z are
its y, z, x. The field's z is up, its origin a corner.
"""

import json

import numpy as np
from pydantic import Field

from tagmetry.files.checked import FileModel, checked
from tagmetry.files.maps.places import MapDefaults, Vector, pose_of, quaternion_xyzw, vector_table
from tagmetry.files.maps.section import Found, Notes, section_of
from tagmetry.files.tables import Table
from tagmetry.files.text import named_errors
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MarkerMap

_FAMILY = "tag36h11"  # the only one that is played with
_R_tag_marker = Rotation.from_matrix([[0, 0, 1], [1, 0, 0], [0, 1, 0]])


class _Quaternion(FileModel):
    W: float
    X: float
    Y: float
    Z: float


class _Rotation(FileModel):
    quaternion: _Quaternion


class _Pose(FileModel):
    translation: Vector
    rotation: _Rotation


class _Tag(FileModel):
    ID: int
    pose: _Pose


class _Field(FileModel):
    tags: list[_Tag] = Field(min_length=1)


def is_wpilib(table: Table) -> bool:
    """Say whether a table is a field layout."""
    return "tags" in table and "field" in table


def map_from_wpilib(table: Table, defaults: MapDefaults) -> MarkerMap:
    """Return the map of a field layout; the size has to come from elsewhere."""
    notes, markers = Notes(table, defaults), []
    for number, tag in enumerate(checked(_Field, table).tags):
        with named_errors(f"tag {tag.ID}"):
            q = tag.pose.rotation.quaternion
            T_world_tag = pose_of(tag.pose.translation.array, (q.X, q.Y, q.Z, q.W))
            T_world_marker = T_world_tag * RigidTransform.from_rotation(_R_tag_marker)
            family = defaults.family or _FAMILY
            markers.append(notes.marker(number, Found(tag.ID, T_world_marker), family))
    return MarkerMap(tuple(markers), notes.name)


def wpilib_text(marker_map: MarkerMap) -> str:
    """Return the text of a field layout; the field reaches from the origin to the farthest tag."""
    reach_m = np.max([one.T_world_marker.translation for one in marker_map.markers], axis=0)
    table: Table = {
        "tags": [
            {"ID": one.id, "pose": _pose_table(one.T_world_marker)} for one in marker_map.markers
        ],
        "field": {"length": max(float(reach_m[0]), 0.0), "width": max(float(reach_m[1]), 0.0)},
        "tagmetry": section_of(marker_map),
    }
    return json.dumps(table, indent=2) + "\n"


def _pose_table(T_world_marker: RigidTransform) -> Table:
    T_world_tag = T_world_marker * RigidTransform.from_rotation(_R_tag_marker.inv())
    x, y, z, w = quaternion_xyzw(T_world_tag)
    return {
        "translation": vector_table(T_world_tag.translation),
        "rotation": {"quaternion": {"W": w, "X": x, "Y": y, "Z": z}},
    }

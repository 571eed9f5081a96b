"""TagSLAM's bodies of tags: `tagslam.yaml` as it is written by hand, and its solved poses.

A tag's frame is x right, y up, z out of its face, as ours; rotations are rotation vectors; noises
are standard deviations along the axes of the posed frame itself. Static bodies make up the map;
their own noise and the tags' are added, and markers are taken to err each by itself.
"""

from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, Field

from tagmetry.errors import InputError
from tagmetry.files.checked import FileModel, checked
from tagmetry.files.maps.places import (
    MapDefaults,
    Vector,
    covariance_of,
    local_deviations,
    vector_table,
)
from tagmetry.files.maps.section import Found, Notes, section_of
from tagmetry.files.tables import Table
from tagmetry.files.text import named_errors
from tagmetry.files.yaml_writer import yaml_of
from tagmetry.geometry import RigidTransform, UncertainTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap

_FAMILY = "tag36h11"  # what its detector looks for unless it is told otherwise


class _Pose(FileModel):
    position: Vector
    rotation: Vector
    position_noise: Vector | None = None
    rotation_noise: Vector | None = None

    @property
    def uncertain(self) -> UncertainTransform:
        """The pose with its covariance on the left in the outer frame."""
        T = RigidTransform.from_components(
            self.position.array, Rotation.from_rotvec(self.rotation.array)
        )
        position_m = np.zeros(3) if self.position_noise is None else self.position_noise.array
        rotation_rad = np.zeros(3) if self.rotation_noise is None else self.rotation_noise.array
        return UncertainTransform(T, covariance_of(position_m, rotation_rad, T))


class _Tag(FileModel):
    id: int
    size: float | None = None
    pose: _Pose | None = None


class _Body(FileModel):
    is_static: bool = True
    default_tag_size: float | None = None
    pose: _Pose | None = None
    tags: list[_Tag] = Field(default_factory=list)


def _listed_bodies(value: Any) -> Any:  # noqa: ANN401
    """Make one table of a list of tables with one key each."""
    if not isinstance(value, list) or not all(isinstance(one, dict) for one in value):
        return value
    pairs = [pair for one in value for pair in one.items()]
    if len({name for name, _ in pairs}) != len(pairs):
        raise ValueError("a body's name stands there twice")
    return dict(pairs)


class _Bodies(FileModel):
    bodies: Annotated[dict[str, _Body], BeforeValidator(_listed_bodies)]


def is_tagslam(table: Table) -> bool:
    """Say whether a table has TagSLAM's bodies."""
    return "bodies" in table


def map_from_tagslam(table: Table, defaults: MapDefaults) -> MarkerMap:
    """Return the map of all tags on static bodies whose poses are known."""
    notes = Notes(table, defaults)
    markers: list[MapMarker] = []
    for name, body in checked(_Bodies, table).bodies.items():
        if not body.is_static or body.pose is None:
            continue
        for tag in body.tags:
            if tag.pose is None:
                continue
            with named_errors(f"body {name}, tag {tag.id}"):
                pose = body.pose.uncertain @ tag.pose.uncertain
                found = Found(tag.id, pose.T_a_b, pose.covariance)
                size_m = tag.size if tag.size is not None else body.default_tag_size
                family = defaults.family or _FAMILY
                markers.append(notes.marker(len(markers), found, family, size_m))
    if not markers:
        raise InputError("no static body has a tag whose pose is known")
    return MarkerMap(tuple(markers), notes.name)


def tagslam_text(marker_map: MarkerMap) -> str:
    """Return the text of a file with the map as its one static body at the origin."""
    body: Table = {
        "is_static": True,
        "pose": _pose_table(RigidTransform.identity()),
        "type": "simple",
        "tags": [_tag_table(one) for one in marker_map.markers],
    }
    return yaml_of(
        {
            "default_body": marker_map.name,
            "bodies": [{marker_map.name: body}],
            "tagmetry": section_of(marker_map),
        }
    )


def _tag_table(marker: MapMarker) -> Table:
    pose = _pose_table(marker.T_world_marker)
    if not marker.is_exact:
        position_m, rotation_rad = local_deviations(marker.covariance, marker.T_world_marker)
        pose |= {
            "position_noise": vector_table(position_m),
            "rotation_noise": vector_table(rotation_rad),
        }
    return {"id": marker.id, "size": float(marker.size_m), "pose": pose}


def _pose_table(T: RigidTransform) -> Table:
    return {
        "position": vector_table(T.translation),
        "rotation": vector_table(T.rotation.as_rotvec()),
    }

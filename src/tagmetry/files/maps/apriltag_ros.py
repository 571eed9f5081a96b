"""apriltag_ros's `tags.yaml`: bundles of tags, each a world of its own.

A tag's frame is x right, y up, z out of its face, as ours. Standalone tags have no place and are
passed over.
"""

from typing import Annotated

import numpy as np
from pydantic import BeforeValidator, Field

from tagmetry.errors import InputError
from tagmetry.files.checked import FileModel, checked
from tagmetry.files.maps.places import MapDefaults, pose_of, quaternion_xyzw
from tagmetry.files.maps.section import Found, Notes, section_of
from tagmetry.files.plain import word_of
from tagmetry.files.tables import Table
from tagmetry.files.text import named_errors
from tagmetry.files.yaml_writer import yaml_of
from tagmetry.localize import MapMarker, MarkerMap


class _Tag(FileModel):
    id: int
    size: float
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    qw: float = 1.0
    qx: float = 0.0
    qy: float = 0.0
    qz: float = 0.0


class _Bundle(FileModel):
    name: Annotated[str, BeforeValidator(word_of)]
    layout: list[_Tag] = Field(min_length=1)


class _Tags(FileModel):
    tag_bundles: list[_Bundle] = Field(default_factory=list)


def is_apriltag_ros(table: Table) -> bool:
    """Say whether a table is a `tags.yaml`."""
    return "tag_bundles" in table or "standalone_tags" in table


def map_from_apriltag_ros(
    table: Table, defaults: MapDefaults, name: str | None = None
) -> MarkerMap:
    """Return the map of a bundle, of the only one where none is named."""
    bundle = _chosen(checked(_Tags, table).tag_bundles, name)
    notes, markers = Notes(table, defaults), []
    for number, tag in enumerate(bundle.layout):
        with named_errors(f"tag {tag.id}"):
            quaternion = (tag.qx, tag.qy, tag.qz, tag.qw)
            T_world_marker = pose_of(np.array([tag.x, tag.y, tag.z]), quaternion)
            family = defaults.family or "tag36h11"  # the tool's own default
            found = Found(tag.id, T_world_marker)
            markers.append(notes.marker(number, found, family, tag.size))
    return MarkerMap(tuple(markers), bundle.name)


def apriltag_ros_text(marker_map: MarkerMap) -> str:
    """Return the text of a `tags.yaml` with the map as its only bundle."""
    layout = [_tag_table(one) for one in marker_map.markers]
    return yaml_of(
        {
            "standalone_tags": [],
            "tag_bundles": [{"name": marker_map.name, "layout": layout}],
            "tagmetry": section_of(marker_map),
        }
    )


def _tag_table(marker: MapMarker) -> Table:
    table: Table = {"id": marker.id, "size": float(marker.size_m)}
    table |= dict(zip("xyz", marker.T_world_marker.translation.tolist(), strict=True))
    keys = ("qx", "qy", "qz", "qw")
    return table | dict(zip(keys, quaternion_xyzw(marker.T_world_marker), strict=True))


def _chosen(bundles: list[_Bundle], name: str | None) -> _Bundle:
    named = [one for one in bundles if name in (None, one.name)]
    if not bundles:
        raise InputError("the file has no tag_bundles; standalone tags have no place in a world")
    if len(named) != 1:
        listed = ", ".join(one.name for one in bundles)
        raise InputError(
            f"choose one of the bundles: {listed}"
            if name is None
            else f"expected one bundle {name!r}, there are {listed}"
        )
    return named[0]

"""Our own marker maps: YAML with everything that is known, checked strictly."""

from typing import Literal

import numpy as np
from pydantic import Field

from tagmetry.errors import InputError
from tagmetry.files.checked import OwnFileModel, checked
from tagmetry.files.maps.places import MapDefaults, pose_of, quaternion_xyzw, rotation_of
from tagmetry.files.maps.section import covariance_array, note_of
from tagmetry.files.tables import Table
from tagmetry.files.text import named_errors
from tagmetry.files.yaml_writer import yaml_of
from tagmetry.geometry import Array, RigidTransform
from tagmetry.localize import MapMarker, MarkerMap

_FORMAT, _VERSION = "marker map", 1


class _Deviations(OwnFileModel):
    position_m: float = Field(ge=0)
    rotation_rad: float = Field(ge=0)


class _Marker(OwnFileModel):
    id: int
    family: str | None = None
    size_m: float | None = None
    translation_m: list[float] = Field(min_length=3, max_length=3)
    rotation_xyzw: list[float] | None = Field(None, min_length=4, max_length=4)
    rotation_matrix: list[list[float]] | None = Field(None, min_length=3, max_length=3)
    covariance: list[list[float]] | None = None
    deviations: _Deviations | None = None
    body: str | None = None


class _Map(OwnFileModel):
    tagmetry: Literal["marker map"]
    version: int
    name: str = "map"
    family: str | None = None
    size_m: float | None = None
    deviations: _Deviations | None = None
    markers: list[_Marker]


def is_own(table: Table) -> bool:
    """Say whether a table is one of our maps."""
    return table.get("tagmetry") == _FORMAT


def map_from_own(table: Table, defaults: MapDefaults) -> MarkerMap:
    """Return the map of a table."""
    if table.get("version") != _VERSION:
        raise InputError(
            f"expected version {_VERSION} of a marker map, found {table.get('version')}; a later "
            "tagmetry may read it"
        )
    found = checked(_Map, table)
    markers = []
    for one in found.markers:
        with named_errors(f"id {one.id}"):
            markers.append(_marker(one, found, defaults))
    return MarkerMap(tuple(markers), found.name)


def own_text(marker_map: MarkerMap) -> str:
    """Return the text of a map."""
    markers = [
        note_of(one)
        | {
            "translation_m": one.T_world_marker.translation.tolist(),
            "rotation_xyzw": quaternion_xyzw(one.T_world_marker),
        }
        for one in marker_map.markers
    ]
    return yaml_of(
        {"tagmetry": _FORMAT, "version": _VERSION, "name": marker_map.name, "markers": markers}
    )


def _marker(one: _Marker, found: _Map, defaults: MapDefaults) -> MapMarker:
    return MapMarker(
        defaults.family_of(one.id, one.family or found.family),
        one.id,
        defaults.size_of(one.id, one.size_m if one.size_m is not None else found.size_m),
        _pose(one),
        _covariance(one, one.deviations or found.deviations),
        one.body,
    )


def _pose(one: _Marker) -> RigidTransform:
    translation_m = np.array(one.translation_m)
    if (one.rotation_xyzw is None) == (one.rotation_matrix is None):
        raise InputError("expected its rotation either as rotation_xyzw or as rotation_matrix")
    if one.rotation_xyzw is not None:
        return pose_of(translation_m, one.rotation_xyzw)
    rows = one.rotation_matrix or []
    if {len(row) for row in rows} != {3}:
        raise InputError(f"rotation_matrix: expected 3 rows of 3 numbers, found {rows}")
    return RigidTransform.from_components(translation_m, rotation_of(np.array(rows)))


def _covariance(one: _Marker, deviations: _Deviations | None) -> Array:
    if one.covariance is not None:
        return covariance_array(one.covariance)
    if deviations is None:
        return np.zeros((6, 6))
    sigmas = np.repeat([deviations.position_m, deviations.rotation_rad], 3)
    return np.diag(sigmas**2)

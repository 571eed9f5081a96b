"""An arena's world as it was measured: floor, camera, and how the floor looked to it."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field

from tagmetry.arena import FloorCorners, OverheadView
from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.files.atomic import write_atomically
from tagmetry.files.checked import Metres, OwnFileModel, checked
from tagmetry.files.maps.places import pose_of, quaternion_xyzw
from tagmetry.files.maps.section import covariance_array
from tagmetry.files.tables import Table, load_yaml
from tagmetry.files.text import named_errors
from tagmetry.files.yaml_writer import yaml_of
from tagmetry.geometry import Array, RigidTransform
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers.bodies import MarkerKey

_VERSION = 1


@dataclass(frozen=True, eq=False)
class ArenaWorld:
    """What calibration found.

    Attributes:
        view: The camera at its place.
        floor: The floor markers at theirs.
        reference: The floor markers' corners, to notice when the camera is moved.
    """

    view: OverheadView
    floor: MarkerMap
    reference: tuple[FloorCorners, ...]


class _Pose(OwnFileModel):
    translation_m: list[Metres] = Field(min_length=3, max_length=3)
    rotation_xyzw: list[float] = Field(min_length=4, max_length=4)
    covariance: list[list[float]]


class _Marker(OwnFileModel):
    family: str
    id: int
    size_m: Metres
    pose: _Pose
    corners_px: list[list[float]] | None = None
    deviation_px: float | None = Field(None, gt=0)


class _World(OwnFileModel):
    tagmetry: Literal["arena world"]
    version: int
    image_size_px: list[int] = Field(min_length=2, max_length=2)
    camera: _Pose
    floor: list[_Marker]


def load_world(path: str | Path, camera: Camera) -> ArenaWorld:
    """Return a world from its file.

    Args:
        path: The file.
        camera: The intrinsics that it was measured with.

    Raises:
        InputError: There is none, it is broken, or it belongs to images of another size.
    """
    path = Path(path)
    if not path.exists():
        raise InputError(
            f"{path}: the arena has no world yet; measure it: tagmetry arena calibrate SOURCE ARENA"
        )
    table = load_yaml(path)
    with named_errors(path):
        found = checked(_World, table)
        if found.version != _VERSION:
            raise InputError(f"expected version {_VERSION} of a world, found {found.version}")
        if tuple(found.image_size_px) != camera.size_px:
            width, height = found.image_size_px
            raise InputError(
                f"this world was measured in images of {width}x{height}, the camera's are of "
                f"{camera.width_px}x{camera.height_px}; calibrate the arena anew"
            )
        return _world(found, camera)


def save_world(world: ArenaWorld, path: str | Path) -> None:
    """Write a world to its file, which appears whole or not at all."""
    by_marker = {one.marker: one for one in world.reference}
    floor = [_marker_table(one, by_marker.get(one.key)) for one in world.floor.markers]
    camera = world.view.camera
    table = {
        "tagmetry": "arena world",
        "version": _VERSION,
        "image_size_px": [camera.width_px, camera.height_px],
        "camera": _pose_table(world.view.T_world_camera, world.view.covariance),
        "floor": floor,
    }
    write_atomically(Path(path), yaml_of(table))


def _world(found: _World, camera: Camera) -> ArenaWorld:
    T, covariance = _pose(found.camera)
    markers, reference = [], []
    for one in found.floor:
        with named_errors(f"floor marker {one.id}"):
            T_marker, of_marker = _pose(one.pose)
            markers.append(MapMarker(one.family, one.id, one.size_m, T_marker, of_marker))
            if one.corners_px is not None and one.deviation_px is not None:
                corners = _corners(one.corners_px)
                key = MarkerKey(one.family, one.id)
                reference.append(FloorCorners(key, corners, one.deviation_px))
    view = OverheadView(camera, T, covariance)
    return ArenaWorld(view, MarkerMap(tuple(markers), "floor"), tuple(reference))


def _pose(one: _Pose) -> tuple[RigidTransform, Array]:
    return pose_of(np.array(one.translation_m), one.rotation_xyzw), covariance_array(one.covariance)


def _corners(rows: list[list[float]]) -> Array:
    if [len(row) for row in rows] != [2, 2, 2, 2]:
        raise InputError(f"corners_px: expected four rows of x and y, found {rows}")
    return np.array(rows, dtype=np.float64)


def _pose_table(T: RigidTransform, covariance: Array) -> Table:
    return {
        "translation_m": T.translation.tolist(),
        "rotation_xyzw": quaternion_xyzw(T),
        "covariance": covariance.tolist(),
    }


def _marker_table(one: MapMarker, seen: FloorCorners | None) -> Table:
    table: Table = {
        "family": one.family,
        "id": one.id,
        "size_m": one.size_m,
        "pose": _pose_table(one.T_world_marker, one.covariance),
    }
    if seen is not None:
        table["corners_px"] = seen.corners_px.tolist()
        table["deviation_px"] = seen.deviation_px
    return table

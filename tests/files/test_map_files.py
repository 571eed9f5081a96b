"""Marker maps in files: ours read back, others' are understood."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from map_examples import FORMATS, a_map, named, read

from tagmetry.errors import InputError
from tagmetry.files.maps import MapDefaults, load_map, save_map
from tagmetry.geometry import pose_difference

DATA = Path(os.environ.get("TAGMETRY_DATA", Path(__file__).parents[3] / "shared" / "data"))


def check_same(one, other):
    assert one.name == other.name
    assert [m.key for m in one.markers] == [m.key for m in other.markers]
    for a, b in zip(one.markers, other.markers, strict=True):
        np.testing.assert_allclose(
            pose_difference(a.T_world_marker, b.T_world_marker), 0, atol=1e-9
        )
        assert a.size_m == pytest.approx(b.size_m)
        assert a.body == b.body
        np.testing.assert_allclose(a.covariance, b.covariance, rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("map_format", FORMATS)
def test_a_map_reads_back(map_format, tmp_path):
    path = named(map_format, tmp_path)
    save_map(a_map(), path, map_format)
    check_same(load_map(path), a_map())


@pytest.mark.parametrize("map_format", [name for name in FORMATS if name != "tagmetry"])
def test_others_read_it_without_our_section(map_format, tmp_path):
    path = named(map_format, tmp_path)
    save_map(a_map(), path, map_format)
    found = json.loads(path.read_text()) if map_format == "wpilib" else None
    if found is not None:
        del found["tagmetry"]
        path.write_text(json.dumps(found))
    else:
        path.write_text(path.read_text().split("\ntagmetry:")[0] + "\n")
    defaults = MapDefaults("tag36h11", {one.id: one.size_m for one in a_map().markers})
    for a, b in zip(load_map(path, defaults).markers, a_map().markers, strict=True):
        np.testing.assert_allclose(
            pose_difference(a.T_world_marker, b.T_world_marker), 0, atol=1e-9
        )
        assert a.key == b.key
        assert a.size_m == pytest.approx(b.size_m)


def test_a_field_layout_s_tag_faces_along_its_x(tmp_path):
    """A tag on the left wall of the field, rotation 0: it looks along +x, seen from the field."""
    turn = {"quaternion": {"W": 1.0, "X": 0.0, "Y": 0.0, "Z": 0.0}}
    tag = {"ID": 7, "pose": {"translation": {"x": 0.0, "y": 5.5, "z": 1.4}, "rotation": turn}}
    path = tmp_path / "field.json"
    path.write_text(json.dumps({"tags": [tag], "field": {"length": 16.5, "width": 8.2}}))
    (marker,) = load_map(path, MapDefaults(size_m=0.1651)).markers
    R = marker.T_world_marker.rotation.as_matrix()
    np.testing.assert_allclose(R[:, 2], [1, 0, 0], atol=1e-12)  # out of its face
    np.testing.assert_allclose(R[:, 1], [0, 0, 1], atol=1e-12)  # its top is up
    np.testing.assert_allclose(R[:, 0], [0, 1, 0], atol=1e-12)  # its right, looking along -x
    assert marker.family == "tag36h11"
    np.testing.assert_allclose(marker.p_world[0], [0.0, 5.5 - 0.08255, 1.4 + 0.08255], atol=1e-12)


def test_the_real_field_layout():
    path = DATA / "field_video" / "2024-crescendo.json"
    if not path.exists():
        pytest.skip(f"no {path}; TAGMETRY_DATA names the folder")
    field = load_map(path, MapDefaults(size_m=0.1651))
    assert [one.id for one in field.markers] == list(range(1, 17))
    outward = np.array([one.T_world_marker.rotation.as_matrix()[:, 2] for one in field.markers])
    places_m = np.array([one.T_world_marker.translation for one in field.markers])
    assert np.abs(outward[:, 2]).max() < 1e-9  # all stand upright
    middle_m = np.array([16.541 / 2, 8.211 / 2])
    ends = np.abs(places_m[:, 0] - middle_m[0]) > 6  # those at the ends look at the field's middle
    assert (((middle_m - places_m[:, :2]) * outward[:, :2]).sum(axis=1)[ends] > 0).all()


def test_an_aruco_map_as_the_library_writes_it(tmp_path):
    text = """%YAML:1.0
---
aruco_bc_dict: ARUCO_MIP_36h12
aruco_bc_nmarkers: 2
aruco_bc_mInfoType: 1
aruco_bc_markers:
   - { id:0, corners:[ [ -0.1, 0.1, 0. ], [ 0.1, 0.1, 0. ], [ 0.1, -0.1, 0. ],
       [ -0.1, -0.1, 0. ] ] }
   - { id:5, corners:[ [ 1., 0., 0.2 ], [ 1., 0.2, 0.2 ], [ 1., 0.2, 0. ], [ 1., 0., 0. ] ] }
"""
    first, second = read(text, tmp_path).markers
    assert (first.family, first.id, second.id) == ("aruco_mip_36h12", 0, 5)
    np.testing.assert_allclose(first.T_world_marker.as_matrix(), np.eye(4), atol=1e-12)
    np.testing.assert_allclose(
        second.T_world_marker.rotation.as_matrix()[:, 2], [1, 0, 0], atol=1e-9
    )
    assert second.size_m == pytest.approx(0.2)


def test_a_bundle_of_apriltag_ros(tmp_path):
    text = """standalone_tags: [{id: 10, size: 0.05}]
tag_bundles:
- name: wall
  layout:
  - {id: 0, size: 0.1, x: 0.0, y: 0.0, z: 0.0, qw: 1.0, qx: 0.0, qy: 0.0, qz: 0.0}
  - {id: 4, size: 0.2, x: 0.5, y: -0.25, z: 0.0, qw: 0.7071067811865476, qx: 0, qy: 0,
     qz: 0.7071067811865476}
- name: floor
  layout: [{id: 7, size: 0.3}]
"""
    path = tmp_path / "tags.yaml"
    path.write_text(text)
    with pytest.raises(InputError, match="choose one of the bundles: wall, floor"):
        load_map(path)
    found = load_map(path, bundle="wall")
    assert [one.key.id for one in found.markers] == [0, 4]
    quarter = found.markers[1].T_world_marker.rotation.as_euler("xyz", degrees=True)
    np.testing.assert_allclose(quarter, [0, 0, 90], atol=1e-9)
    assert load_map(path, bundle="floor").markers[0].size_m == 0.3


def test_tags_on_a_body_of_tagslam(tmp_path):
    text = """default_body: lab
bodies:
 - lab:
     is_static: true
     default_tag_size: 0.12
     pose:
       position: {x: 1, y: 0, z: 0}
       rotation: {x: 0, y: 0, z: 1.5707963267948966}
       position_noise: {x: 0.003, y: 0.001, z: 0.001}
       rotation_noise: {x: 0.00001, y: 0.00001, z: 0.00001}
     tags:
     - id: 0
       pose: {position: {x: 2, y: 0, z: 0}, rotation: {x: 0, y: 0, z: 0}}
     - {id: 9, size: 0.2}
 - rig: {is_static: false}
"""
    (marker,) = read(text, tmp_path).markers
    np.testing.assert_allclose(marker.T_world_marker.translation, [1, 2, 0], atol=1e-12)
    assert marker.size_m == 0.12
    deviations_m = np.sqrt(np.diag(marker.covariance)[:3])
    np.testing.assert_allclose(deviations_m, [0.001, 0.003, 0.001], atol=1e-5)


def test_our_own_may_leave_out_what_is_common(tmp_path):
    text = """tagmetry: marker map
version: 1
family: tag36h11
size_m: 0.16
deviations: {position_m: 0.002, rotation_rad: 0.01}
markers:
- {id: 3, translation_m: [1, 2, 3], rotation_matrix: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]}
- {id: 4, translation_m: [1, 2, 4], rotation_xyzw: [0, 0, 0, 1], size_m: 0.2}
"""
    first, second = read(text, tmp_path).markers
    assert (first.size_m, second.size_m, first.family) == (0.16, 0.2, "tag36h11")
    np.testing.assert_allclose(first.T_world_marker.rotation.as_rotvec(), [0, 0, np.pi / 2])
    np.testing.assert_allclose(np.diag(second.covariance), [4e-6] * 3 + [1e-4] * 3)

"""Marker maps that are refused: with the file, the place and what was expected."""

from contextlib import suppress
from dataclasses import replace

import pytest
from map_examples import FORMATS, ONE, a_map, named, read

from tagmetry.errors import InputError
from tagmetry.files.maps import load_map, save_map
from tagmetry.localize import MarkerMap

FAULTS = {
    "size_m: 0.16|size_m: 160": r"tag36h11 id 3 has a size of 160.0 m; expected .* at most 20",
    "size_m: 0.16|size_m: 0": r"id 3 has a size of 0.0 m",
    "size_m: 0.16, |": r"does not say how large id 3 is; .*\(--size\)",
    "family: tag36h11, |": r"does not say of which family id 3 is; name it \(--family\)",
    "rotation_xyzw: [0, 0, 0, 1]|rotation_xyzw: [0, 0, 0, 2]": "quaternion of length 1, found .* 2",
    "rotation_xyzw: [0, 0, 0, 1]|rotation_matrix: [[-1, 0, 0], [0, 1, 0], [0, 0, 1]]": "left-hand",
    "rotation_xyzw: [0, 0, 0, 1]|rotation_matrix: [[1, 0, 0], [0, 1, 0], [1, 0, 1]]": "no unit ax",
    "rotation_xyzw: [0, 0, 0, 1]|rotation_matrix: [[1, 0], [0, 1], [1, 0]]": "3 rows of 3 numbers",
    ", rotation_xyzw: [0, 0, 0, 1]|": "either as rotation_xyzw or as rotation_matrix",
    "translation_m: [1, 2, 3]|translation_m: [1, 2]": r"markers.0.translation_m",
    "translation_m: [1, 2, 3]|translation_m: [1, 2, .inf]": r"markers.0.translation_m",
    "version: 1|version: 2": "expected version 1 of a marker map, found 2",
    "id: 3|id: -3": "a marker's id is not negative",
    "id: 3|idx: 3": "there is no key 'idx'",
    "tagmetry: marker map|tagmetry: camera bank": "expected a marker map",
    "0, 1]}|0, 1], covariance: [[1]]}": "expected 6 rows of 6 numbers, found 1 rows",
}  # fmt: skip


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_named_in_one_line(fault, tmp_path):
    old, new = fault.split("|")
    assert old in ONE
    with pytest.raises(InputError, match=FAULTS[fault]) as caught:
        read(ONE.replace(old, new), tmp_path)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith(str(tmp_path / "map.yaml"))


def test_an_id_that_stands_there_twice_is_named(tmp_path):
    with pytest.raises(InputError, match="the map has tag36h11 id 3 twice"):
        read(ONE + ONE.splitlines()[-1] + "\n", tmp_path)


def test_a_section_that_does_not_go_with_its_markers_is_refused(tmp_path):
    path = tmp_path / "map.json"
    save_map(a_map(), path, "wpilib")
    path.write_text(path.read_text().replace('"ID": 2,', '"ID": 5,'))
    with pytest.raises(InputError, match="number 1 is id 5; the file was changed"):
        load_map(path)


def test_formats_refuse_what_they_cannot_hold(tmp_path):
    mixed = MarkerMap((*a_map().markers, replace(a_map().markers[0], family="tag25h9")))
    with pytest.raises(InputError, match="an ArUco map has one family, this one has tag36h11"):
        save_map(mixed, tmp_path / "map.yaml", "aruco")
    with pytest.raises(InputError, match=r"the format wpilib is JSON; name the file \.json"):
        save_map(a_map(), tmp_path / "map.yaml", "wpilib")
    with pytest.raises(InputError, match="unknown map format 'xml'; there are tagmetry"):
        save_map(a_map(), tmp_path / "map.yaml", "xml")
    assert not (tmp_path / "map.yaml").exists()


PIXELS = """aruco_bc_mInfoType: 0
aruco_bc_markers: [{id: 1, corners: [[0,0,0],[1,0,0],[1,-1,0],[0,-1,0]]}]
"""


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("aruco_bc_markers: [{id: 1, corners: [[0,0,0],[1,0,0],[1,1,0],[0,2,0]]}]", "square"),
        ("aruco_bc_markers: [{id: 1, corners: [[0,0],[1,0],[1,1],[0,1]]}]", "three numbers each"),
        ("aruco_bc_markers: [{id: 1, corners: [[0,0,0],[0,0,0],[0,0,0],[0,0,0]]}]", "square"),
        (PIXELS, "in pixels"),
        ("bodies: [{rig: {is_static: false}}]", "no static body has a tag"),
        ("bodies: [{a: {}}, {a: {}}]", "name stands there twice"),
        ("standalone_tags: [{id: 1, size: 0.1}]", "no tag_bundles"),
        ("markers: []", "expected a marker map"),
        ("tags: []\nfield: {}", "tags"),
    ],
)  # fmt: skip
def test_files_of_others_with_faults(text, why, tmp_path):
    with pytest.raises(InputError, match=why):
        read(text, tmp_path, size_m=0.1, family="tag36h11")


@pytest.mark.parametrize("cut", range(0, 400, 23))
def test_a_truncated_file_never_crashes(cut, tmp_path):
    for map_format in FORMATS:
        path = named(map_format, tmp_path)
        save_map(a_map(2), path, map_format)
        text = path.read_text()
        path.write_text(text[: max(1, cut * len(text) // 400)])
        with suppress(InputError):
            load_map(path)

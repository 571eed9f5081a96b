"""An arena's file says what it says, bad ones are refused with one clear line, worlds come back."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from tagmetry.arena import Disc, FloorCorners, OverheadView, Wall
from tagmetry.arena.place import Place
from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.files.arena import ArenaWorld, load_arena, load_world, save_world, with_virtual
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers.bodies import MarkerKey

ARENA = """
tagmetry: arena
version: 1
name: lab
camera: ceiling.yaml
family: tag36h11
marker_size_m: 0.08
diameter_m: 0.16
floor:
  size_m: 0.15
  origin: 100
  toward: 101
  markers:
    - {id: 100}
    - {id: 101, size_m: 0.2}
sensor: {range_m: 0.5, view_deg: 180, bearing_sd_deg: 2, line_of_sight: true}
obstacles:
  - {name: pillar, center_m: [0.2, 0.3], radius_m: 0.1}
  - {from_m: [0, 0], to_m: [1, 0]}
fence_m: [[-1, -1], [1, -1], [1, 1]]
safety: {unseen_s: 0.3, margin_m: 0.05}
seed: 7
robots:
  - id: 1
    name: ada
    marker: {id: 1, height_m: 0.093, forward_m: 0.01, turn_deg: 90}
    key: "KEY"
  - id: 2
    diameter_m: 0.2
    marker: {id: 5, height_m: 0.1, size_m: 0.06, family: tag25h9}
    sensor: {range_m: 1}
""".replace("KEY", "0a" * 32)


def written(folder: Path, text: str) -> Path:
    path = folder / "lab.yaml"
    path.write_text(text, "utf-8")
    return path


def test_an_arena_is_what_its_file_says(tmp_path: Path) -> None:
    found = load_arena(written(tmp_path, ARENA))
    ada, other = found.roster.robots
    assert (ada.id, ada.name, ada.diameter_m, ada.marker_size_m) == (1, "ada", 0.16, 0.08)
    assert (ada.mount.height_m, ada.mount.forward_m) == (0.093, 0.01)
    assert ada.mount.turn_rad == pytest.approx(np.pi / 2)
    assert ada.key == bytes.fromhex("0a" * 32)
    assert (other.name, other.family, other.marker_size_m) == ("robot 2", "tag25h9", 0.06)
    assert [one.size_m for one in found.floor] == [0.15, 0.2]
    assert (found.origin, found.toward) == (
        MarkerKey("tag36h11", 100),
        MarkerKey("tag36h11", 101),
    )
    assert found.measured_floor is None
    assert [one.name for one in found.families] == ["tag36h11", "tag25h9"]
    assert (found.camera_file, found.world_file) == (
        tmp_path / "ceiling.yaml",
        tmp_path / "lab.world.yaml",
    )
    assert found.sensor is not None
    assert found.sensor.view_rad == pytest.approx(np.pi)
    assert found.sensor.bearing_sd_rad == pytest.approx(np.radians(2))
    assert found.sensors[2].range_m == 1.0
    assert found.obstacles == (
        Disc((0.2, 0.3), 0.1, "pillar"),
        Wall((0, 0), (1, 0), "obstacle 2"),
    )
    assert found.safety.unseen_s == 0.3
    assert found.safety.fence is not None
    assert found.neighbourhood is not None
    assert found.neighbourhood.seed == 7


def test_floor_markers_may_be_measured_by_hand(tmp_path: Path) -> None:
    text = ARENA.replace("{id: 100}", "{id: 100, x_m: 0, y_m: 0}").replace(
        "{id: 101, size_m: 0.2}", "{id: 101, x_m: 1.5, y_m: 0.25, turn_deg: 90}"
    )
    found = load_arena(written(tmp_path, text))
    assert found.measured_floor is not None
    T = found.measured_floor.markers[1].T_world_marker
    np.testing.assert_allclose(T.apply([0.1, 0, 0]), [1.5, 0.35, 0], atol=1e-12)
    assert found.origin is None


def test_a_board_may_lie_on_the_floor(tmp_path: Path) -> None:
    floor = ARENA[ARENA.index("floor:") : ARENA.index("sensor:")]
    board = 'floor: {board: "grid:3x2:80mm:20mm:tag36h11:100"}\n'
    found = load_arena(written(tmp_path, ARENA.replace(floor, board)))
    assert [one.key.id for one in found.floor] == [100, 101, 102, 103, 104, 105]
    assert found.measured_floor is not None
    at = found.measured_floor.markers[0].T_world_marker.translation
    np.testing.assert_allclose(at, [-0.1, 0.05, 0.0], atol=1e-12)
    for bad, match in (("chessboard:9x6:25mm", "has no markers"), ("grid:3", "floor.board: ")):
        with pytest.raises(InputError, match=match):
            load_arena(written(tmp_path, ARENA.replace(floor, f'floor: {{board: "{bad}"}}\n')))
    both = board.replace("}", ", markers: [{id: 1}]}")
    with pytest.raises(InputError, match="expected markers or a board, found both"):
        load_arena(written(tmp_path, ARENA.replace(floor, both)))


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ("tagmetry: arena", "tagmetry: map", "expected an arena"),
        ("size_m: 0.2}", "size_m: 1e300}", "less than or equal to 1000000000, found 1e.300"),
        ("version: 1", "version: 9", "expected version 1 of an arena, found 9"),
        ("- {id: 100}", "", "origin: 100 is no floor marker; there are 101"),
        ("toward: 101", "toward: 55", "toward: 55 is no floor marker; there are 100, 101"),
        ("toward: 101", "toward: 100", "another marker than the origin"),
        ("- {id: 101, size_m: 0.2}", "- {id: 100}", "tag36h11 id 100 stands there twice"),
        ("{id: 100}", "{id: 100, x_m: 1, y_m: 2}", "some have a place"),
        ("{id: 100}", "{id: 100, x_m: 1}", "floor marker 100: expected both x_m and y_m"),
        ("  size_m: 0.15", "", "floor marker 100: expected its size_m"),
        ("id: 2\n", "id: 1\n", "the id 1 stands at two robots"),
        ("{id: 5,", "{family: tag36h11, id: 1,", "family"),
        ("id: 5, height_m: 0.1, size_m: 0.06, family: tag25h9", "id: 1, height_m: 0.1", "marker"),
        ("marker: {id: 1,", "marker: {id: 100,", "id 100 is a floor marker and ada's"),
        ("{id: 5, height", "{id: 35, height", "robot 2: family tag25h9 has ids 0 to 34"),
        ("- {id: 100}", "- {id: 1000}", "floor marker 1000: family tag36h11 has ids 0 to 586"),
        ("family: tag25h9", "family: tag99", "robot 2: .*tag99"),
        ("marker_size_m: 0.08", "", "robot 1: the size of its marker is missing"),
        ("\ndiameter_m: 0.16", "", "robot 1: its diameter is missing"),
        ("height_m: 0.093, ", "", "height_m is missing"),
        ("0a" * 32, "0a", "robot 1: expected a key of 64 hexadecimal digits, found 2 characters"),
        ("radius_m: 0.1}", "from_m: [0, 1]}", "pillar: expected a disc .* or a wall"),
        ("radius_m: 0.1}", "radius_m: -1}", "positive radius"),
        ("[[-1, -1], [1, -1], [1, 1]]", "[[-1, -1], [1, -1]]", "three corners"),
        ("[[-1, -1], [1, -1], [1, 1]]", "[[-1], [1, -1], [1, 1]]", "expected a place"),
        ("range_m: 0.5", "range_m: 0", "sensor: range_m must be positive"),
        ("range_m: 0.5", "reach: 0.5", "there is no key 'reach'"),
        ("unseen_s: 0.3", "unseen_s: 0", "unseen_s must be positive"),
        ("name: ada", "nome: ada", "there is no key 'nome'"),
    ],
)
def test_refuses_a_bad_arena_in_one_line(tmp_path: Path, old: str, new: str, match: str) -> None:
    assert old in ARENA
    path = written(tmp_path, ARENA.replace(old, new))
    with pytest.raises(InputError, match=match) as refused:
        load_arena(path)
    assert "\n" not in str(refused.value)
    assert "0a0a" not in str(refused.value)


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("floor: {markers: []}\nrobots: []", "floor.markers: there is none"),
        ("floor: {size_m: 0.1, markers: [{id: 3}]}\nrobots: []", "robots: there is none"),
        ("robots: []", "floor is missing"),
    ],
)
def test_refuses_an_arena_without_floor_markers_or_robots(
    tmp_path: Path, text: str, match: str
) -> None:
    with pytest.raises(InputError, match=match):
        load_arena(written(tmp_path, f"tagmetry: arena\nversion: 1\n{text}"))


def test_refuses_a_link_without_keys(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="robot 2 has no key"):
        load_arena(written(tmp_path, ARENA)).keys()


VIRTUAL = """
  - id: 3
    virtual: true
    start: {x_m: 0.5, y_m: -0.5, heading_deg: 90}
    marker: {id: 3, height_m: 0.1}
  - {id: 4, virtual: true, marker: {id: 4, height_m: 0.1}}
"""


def test_some_robots_are_simulated_and_need_no_key(tmp_path: Path) -> None:
    text = ARENA.replace("    diameter_m: 0.2", f"    diameter_m: 0.2\n    key: {'0b' * 32}")
    found = load_arena(written(tmp_path, text + VIRTUAL))
    assert found.virtual[3] == Place(0.5, -0.5, np.pi / 2)
    assert found.safety.fence is not None
    assert found.safety.fence.inside_m(found.virtual[4].xy_m) > 0.1
    assert found.virtual[4].distance_m(found.virtual[3]) >= 0.3
    assert set(found.keys()) == {1, 2}


def test_more_simulated_robots_take_free_numbers_markers_and_places(tmp_path: Path) -> None:
    found = with_virtual(load_arena(written(tmp_path, ARENA)), 3)
    more = found.roster.robots[2:]
    assert [(one.id, one.name, one.marker_id) for one in more] == [
        (3, "virtual 3", 586),
        (4, "virtual 4", 585),
        (5, "virtual 5", 584),
    ]
    places = list(found.virtual.values())
    assert min(a.distance_m(b) for a, b in combinations(places, 2)) >= 0.3
    with pytest.raises(InputError, match="600 more robots find no free marker of tag36h11: 581"):
        with_virtual(found, 600)
    with pytest.raises(InputError, match="no free place any more"):
        with_virtual(found, 300)


def test_refuses_a_start_of_a_real_robot(tmp_path: Path) -> None:
    text = ARENA + "    start: {x_m: 0, y_m: 0}\n"
    with pytest.raises(InputError, match="robot 2: a start is for simulated robots"):
        load_arena(written(tmp_path, text))


def test_refuses_an_arena_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such file"):
        load_arena(tmp_path / "none.yaml")


CAMERA = Camera(640, 480, (600.0, 600.0), (319.5, 239.5))


def world() -> ArenaWorld:
    rng = np.random.default_rng(0)
    root = 1e-3 * rng.standard_normal((6, 6))
    T = RigidTransform.from_components([0.1, 0.2, 2.0], Rotation.from_euler("x", 179, degrees=True))
    view = OverheadView(CAMERA, T, root @ root.T)
    lying = RigidTransform.from_components([0.3, 0.4, 0], Rotation.from_euler("z", 1.0))
    floor = MarkerMap(
        (MapMarker("tag36h11", 9, 0.2, lying, 2 * root @ root.T), MapMarker("4x4_50", 1, 0.1, T)),
        "floor",
    )
    seen = FloorCorners(MarkerKey("tag36h11", 9), rng.uniform(0, 400, (4, 2)), 0.03)
    return ArenaWorld(view, floor, (seen,))


def test_a_world_comes_back_exactly(tmp_path: Path) -> None:
    before = world()
    save_world(before, tmp_path / "w.yaml")
    after = load_world(tmp_path / "w.yaml", CAMERA)
    np.testing.assert_array_equal(after.view.covariance, before.view.covariance)
    np.testing.assert_allclose(
        after.view.T_world_camera.as_matrix(), before.view.T_world_camera.as_matrix(), atol=1e-15
    )
    assert [one.key for one in after.floor.markers] == [one.key for one in before.floor.markers]
    np.testing.assert_array_equal(
        after.floor.markers[0].covariance, before.floor.markers[0].covariance
    )
    (seen,) = after.reference
    np.testing.assert_array_equal(seen.corners_px, before.reference[0].corners_px)
    assert seen.deviation_px == 0.03


def test_refuses_worlds_that_are_missing_broken_or_of_another_camera(tmp_path: Path) -> None:
    path = tmp_path / "w.yaml"
    with pytest.raises(InputError, match="no world yet; measure it: tagmetry arena calibrate"):
        load_world(path, CAMERA)
    save_world(world(), path)
    other = Camera(1280, 960, (600.0, 600.0), (319.5, 239.5))
    with pytest.raises(InputError, match="images of 640x480, the camera's are of 1280x960"):
        load_world(path, other)
    text = path.read_text("utf-8")
    path.write_text(text.replace("size_m: 0.2", "size_m: -1.0"), "utf-8")
    with pytest.raises(InputError, match="floor marker 9"):
        load_world(path, CAMERA)
    path.write_text(text[: len(text) // 2], "utf-8")
    with pytest.raises(InputError, match=r"w\.yaml: "):
        load_world(path, CAMERA)

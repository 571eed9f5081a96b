"""`tagmetry locate`: a rendered wall whose map is known, and what is refused."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.cli.main import run
from tagmetry.cli.planar import parse_planar
from tagmetry.errors import InputError
from tagmetry.files import save_camera
from tagmetry.files.maps import save_map
from tagmetry.geometry import RigidTransform, mahalanobis_squared, pose_difference
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.twin.recipe import pictures
from tagmetry.twin.scenes.ready import ready_recipe


@pytest.fixture(scope="module")
def hall(tmp_path_factory):
    """A folder with a picture of a wall, its map and its camera; and the camera's true pose."""
    folder = tmp_path_factory.mktemp("hall")
    (one,) = list(pictures(ready_recipe("wall")))[:1]
    T_world_camera = one.truth.T_world_camera
    markers = tuple(
        MapMarker(m.family, m.id, m.size_m, T_world_camera * m.T_camera_marker)
        for m in one.truth.markers
    )
    save_map(MarkerMap(markers, "wall"), folder / "map.yaml")
    save_camera(one.truth.camera, folder / "camera.yaml")
    cv2.imwrite(str(folder / "wall.png"), one.pixels)
    return folder, T_world_camera


def arguments(folder: Path, *options: str) -> list[str]:
    picture, known = str(folder / "wall.png"), str(folder / "map.yaml")
    return ["locate", picture, "--map", known, "--camera", str(folder / "camera.yaml"), *options]


def pose_of(line):
    T = line["T_world_camera"]
    return RigidTransform.from_components(
        T["translation_m"], Rotation.from_quat(T["rotation_xyzw"])
    )


@pytest.mark.parametrize("method", ["single", "mean", "weighted", "covariance", "joint"])
def test_every_method_finds_the_camera_before_a_rendered_wall(hall, method, capsys):
    folder, T = hall
    assert run(arguments(folder, "--method", method, "--json")) == 0
    (line,) = map(json.loads, capsys.readouterr().out.splitlines())
    assert line["method"] == method
    apart = pose_difference(pose_of(line), T)
    assert np.linalg.norm(apart[:3]) < (0.003 if method == "joint" else 0.05)
    if method == "joint":
        assert len(line["markers"]) == 8
        assert mahalanobis_squared(apart, np.array(line["covariance"])) < 35


def test_the_twin_tells_its_camera_and_the_filter_takes_its_time(hall, capsys):
    folder, T = hall
    known = ["--map", str(folder / "map.yaml"), "--method", "filter", "--json"]
    assert run(["locate", "twin:wall", *known]) == 0
    (line,) = map(json.loads, capsys.readouterr().out.splitlines())
    assert line["method"] == "filter"
    assert np.linalg.norm(pose_difference(pose_of(line), T)[:3]) < 0.003


def test_files_and_a_picture_are_written(hall, capsys):
    folder, T = hall
    pytest.importorskip("matplotlib")
    out, picture = folder / "poses.tum", folder / "way.png"
    assert run(arguments(folder, "--out", str(out), "--picture", str(picture))) == 0
    told = capsys.readouterr().out
    assert "8 markers" in told
    x, y, z = T.rotation.as_matrix()[:, 2]
    aim_deg = np.degrees([np.arctan2(y, x), abs(np.arctan2(z, np.hypot(x, y)))])
    words = told.split("looks ")[1].split()
    assert [float(words[0][:-1]), float(words[2][:-1])] == pytest.approx(aim_deg, abs=0.5)
    assert words[3] == ("down" if z < 0 else "up")
    np.testing.assert_allclose(np.loadtxt(out)[1:4], T.translation, atol=0.003)
    drawn = cv2.imread(str(picture))
    assert drawn.shape[1] > 1000
    assert drawn.std() > 5


def test_a_camera_on_a_robot_is_held_to_its_floor(hall, capsys):
    folder, T = hall
    height_m = T.translation[2]
    up_deg = np.degrees(np.arcsin(T.rotation.as_matrix()[2, 2]))
    robot = f"z={height_m},up={up_deg},tilt=0.2,bumps=1mm"
    assert run(arguments(folder, "--planar", robot, "--json")) == 0
    line = json.loads(capsys.readouterr().out)
    assert abs(pose_of(line).translation[2] - height_m) < 0.002


def test_a_planar_robot_s_camera_as_it_is_typed():
    robot = parse_planar("x=12cm, z=0.4, up=25, left=90, floor=-0.1, bumps=2mm, tilt=1")
    np.testing.assert_allclose(robot.T_robot_camera.translation, [0.12, 0, 0.4])
    forward = robot.T_robot_camera.rotation.apply([0, 0, 1])
    np.testing.assert_allclose(
        forward, [0, np.cos(np.deg2rad(25)), np.sin(np.deg2rad(25))], atol=1e-12
    )
    assert (robot.floor_m, robot.height_deviation_m) == (-0.1, 0.002)
    assert robot.tilt_deviation_rad == pytest.approx(np.deg2rad(1))


@pytest.mark.parametrize("text", ["", "z", "z=1,z=2", "height=1", "z=high", "up=steep"])
def test_refuses_a_planar_robot_s_camera_that_is_none(text):
    with pytest.raises(InputError, match="expected"):
        parse_planar(text)


REFUSED = {
    ("--picture", "none/way.png"): "there is no folder none; create it first",
    ("--method", "best"): "there is no method 'best'; there are single, mean",
    ("--method", "mean", "--planar", "z=1"): "the method mean cannot make use of gravity",
    ("--method", "filter"): "a filter needs images with times",
    ("--odometry", "odo.csv"): "odometry needs --method filter, and --planar",
    ("--picture", "way.pdf"): "the picture is a PNG; name it like map.png",
    ("--out", "poses.xml"): "camera poses are written as .jsonl or .tum",
    ("--map", "nowhere.yaml"): "nowhere.yaml: there is no such file",
    ("--bundle", "wall"): "only apriltag_ros files have bundles to choose from",
}


@pytest.mark.parametrize("options", REFUSED)
def test_what_cannot_be_done_is_one_line(hall, options, capsys):
    folder, _ = hall
    assert run(arguments(folder, *options)) == 2
    error = capsys.readouterr().err
    assert REFUSED[options] in error
    assert error.count("\n") == 1


def test_a_map_of_other_markers_gives_no_pose_with_the_reason(hall, capsys, tmp_path):
    folder, _ = hall
    stranger = MapMarker("tag36h11", 400, 0.1, RigidTransform.identity())
    save_map(MarkerMap((stranger,)), tmp_path / "map.yaml")
    assert run([*arguments(folder, "--json"), "--map", str(tmp_path / "map.yaml")]) == 0
    line = json.loads(capsys.readouterr().out)
    assert line["T_world_camera"] is None
    assert "it is not in the map" in line["why"]

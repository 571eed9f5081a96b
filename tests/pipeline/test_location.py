"""Images to camera poses: with and without a filter, and as files."""

import json
from dataclasses import replace

import numpy as np
import pytest

from tagmetry.camera import Camera, Image
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.localize.filter import PoseFilter, Speeds
from tagmetry.pipeline.location import Location
from tagmetry.pipeline.location_files import location_line, open_location_writer
from tagmetry.pipeline.location_odometry import load_odometry

CAMERA = Camera(640, 480, (600.0, 600.0), (319.5, 239.5))
AHEAD = Rotation.from_matrix([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])
FACING = Rotation.from_matrix([[0, 0, -1], [-1, 0, 0], [0, 1, 0]]) * Rotation.from_euler(
    "y", 30, degrees=True
)
MAP = MarkerMap(
    tuple(
        MapMarker("tag36h11", n, 0.2, RigidTransform.from_components([0, 0.5 * n, 1.0], FACING))
        for n in (-1, 0, 1)
        if n >= 0
    )
)


class Eyes:
    """A detector that knows what is there: markers as a camera at `T_world_camera` sees them."""

    def __init__(self, way):
        self._way = iter(way)

    def detect(self, _, camera):
        T = next(self._way)
        if T is None:
            return ()
        return tuple(
            Detection(
                m.family, m.id, camera.project(T.inv().apply(m.p_world)), 0.01 * np.eye(8), 0, 1.0
            )
            for m in MAP.markers
        )


def at(x_m):
    return RigidTransform.from_components([x_m, 0.2, 1.0], AHEAD)


def image(n, **changes):
    pixels = np.zeros((480, 640), dtype=np.uint8)
    whole = Image(pixels, 0.1 * n, "capture", n, "hall.mp4", CAMERA)
    return replace(whole, **changes)


def test_a_line_says_all_there_is():
    found = Location(Eyes([at(-2.0)]), MAP).locate(image(3))
    line = json.loads(location_line(found))
    assert line["source"] == "hall.mp4"
    assert (line["sequence"], line["method"], line["markers"]) == (3, "joint", [0, 1])
    assert line["time_s"] == pytest.approx(0.3)
    np.testing.assert_allclose(line["T_world_camera"]["translation_m"], [-2, 0.2, 1], atol=1e-6)
    R = Rotation.from_quat(line["T_world_camera"]["rotation_xyzw"])
    assert (R * AHEAD.inv()).magnitude() < 1e-6
    np.testing.assert_allclose(line["covariance"], found.covariance)
    assert (line["rejected"], line["age_s"]) == ([], 0.0)


def test_no_pose_is_null_with_the_reason():
    line = json.loads(location_line(Location(Eyes([None]), MAP).locate(image(0))))
    assert (line["T_world_camera"], line["covariance"]) == (None, None)
    assert line["why"] == "the image shows no marker"


def test_files_of_both_kinds(tmp_path):
    way = [at(-2.0), None, at(-1.8)]
    found = [Location(Eyes([T]), MAP).locate(image(n)) for n, T in enumerate(way)]
    for name in ("poses.jsonl", "poses.tum"):
        with open_location_writer(tmp_path / name) as writer:
            for one in found:
                writer.write(one)
    lines = (tmp_path / "poses.jsonl").read_text().splitlines()
    assert [json.loads(one)["T_world_camera"] is None for one in lines] == [False, True, False]
    rows = np.loadtxt(tmp_path / "poses.tum")
    np.testing.assert_allclose(rows[:, :4], [[0, -2, 0.2, 1], [0.2, -1.8, 0.2, 1]], atol=1e-6)
    with pytest.raises(InputError, match=r"written as \.jsonl or \.tum"):
        open_location_writer(tmp_path / "poses.csv")


def test_a_filter_goes_on_without_markers_and_says_how_long():
    way = [at(-2.0 + 0.05 * n) for n in range(10)] + [None] * 5
    task = Location(Eyes(way), MAP, follower=PoseFilter())
    found = [task.locate(image(n)) for n in range(15)]
    assert {one.method for one in found} == {"filter"}
    assert found[9].age_s == 0
    assert found[14].age_s == pytest.approx(0.5)
    assert found[14].T_world_camera.translation[0] == pytest.approx(-1.3, abs=0.05)
    assert np.trace(found[14].covariance) > np.trace(found[9].covariance)


def test_a_filter_before_any_marker_has_no_pose_and_without_times_is_refused():
    task = Location(Eyes([None]), MAP, follower=PoseFilter())
    assert task.locate(image(0)).why == "the image shows no marker"
    with pytest.raises(InputError, match=r"hall.mp4: a filter needs images with times"):
        Location(Eyes([at(-2)]), MAP, follower=PoseFilter()).locate(image(0, time_kind="none"))


def test_odometry_carries_on_when_the_markers_are_gone(tmp_path):
    path = tmp_path / "odo.csv"
    rows = "".join(f"{0.05 * n:.2f},0.5,0.0\n" for n in range(60))
    path.write_text("time_s, forward_m_s, turn_rad_s\n" + rows)
    T_robot_camera = RigidTransform.from_components([0.1, 0, 0.4], AHEAD)
    speeds = load_odometry(path, T_robot_camera)
    assert len(speeds) == 60
    way = [at(-2.0), at(-1.95)] + [None] * 20
    task = Location(Eyes(way), MAP, follower=PoseFilter(), speeds=speeds)
    found = [task.locate(image(n)) for n in range(22)]
    assert found[-1].T_world_camera.translation[0] == pytest.approx(-0.95, abs=0.03)


def test_a_turning_robot_carries_its_camera_around(tmp_path):
    path = tmp_path / "odo.csv"
    path.write_text("time_s,turn_rad_s,left_m_s\n0,2.0,0\n")
    camera = RigidTransform.from_components([0.3, 0.1, 0.4], AHEAD)
    ((_, speeds),) = load_odometry(path, camera)
    assert isinstance(speeds, Speeds)
    np.testing.assert_allclose(AHEAD.apply(speeds.speed_m_s), [-0.2, 0.6, 0])  # w x p
    np.testing.assert_allclose(AHEAD.apply(speeds.rate_rad_s), [0, 0, 2])


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("a,b\n1,2\n", "expected the columns time_s and some of forward_m_s"),
        ("time_s,forward_m_s\n0,1\n0,1\n", "line 3: time runs backwards, 0 s"),
        ("time_s,forward_m_s\n0,fast\n", "line 2: expected finite numbers, found 'fast'"),
        ("time_s,forward_m_s\n0\n", "line 2: expected finite numbers, found 'None'"),
    ],
)
def test_faults_of_an_odometry_file_are_named(text, why, tmp_path):
    (tmp_path / "odo.csv").write_text(text)
    with pytest.raises(InputError, match=why):
        load_odometry(tmp_path / "odo.csv", RigidTransform.identity())


def test_images_of_another_size_or_without_intrinsics_are_refused():
    with pytest.raises(
        InputError, match="intrinsics belong to 640x480 images, this one is 320x240"
    ):
        Location(Eyes([at(-2)]), MAP).locate(image(0, pixels=np.zeros((240, 320), np.uint8)))
    with pytest.raises(InputError, match=r"hall.mp4: the camera's intrinsics are needed"):
        Location(Eyes([at(-2)]), MAP).locate(image(0, camera=None))

"""The locate room: places are as sure as they say, residuals are those of the noise, bounds."""

import re
from itertools import islice
from pathlib import Path

import cv2
import numpy as np
import pytest
from live_server import eventually

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.files import save_camera
from tagmetry.files.maps import save_map
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.live.rooms.locate.looked import Looked
from tagmetry.live.rooms.locate.messages import LocateImages, LocateTrace, StartLocate, StopLocate
from tagmetry.live.rooms.locate.room import locate_room
from tagmetry.live.rooms.locate.told import told_marker, told_point, told_residuals
from tagmetry.live.rooms.locate.walk import Walk
from tagmetry.live.rooms.room import Room
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers import GridBoard
from tagmetry.twin import photograph
from tagmetry.twin.rendering import Shot
from tagmetry.twin.scenes import Scene, Still, board_thing

NOISE_PX = 0.1
WORLD = GridBoard(3, 2, 0.08, 0.02, "tag36h11", first_id=20)
CAMERA = Camera(640, 480, (520.0, 520.0), (319.5, 239.5))
FACING = Rotation.from_matrix(np.diag([1.0, -1.0, -1.0]))  # the board looks at the camera
Ts_CAMERA_WORLD = [
    RigidTransform.from_components(
        place_m, Rotation.from_euler("xy", turn_deg, degrees=True) * FACING
    )
    for place_m, turn_deg in (((0.02, 0.01, 0.6), (20, 15)), ((-0.03, 0.0, 0.7), (-15, 30)))
]
WAITS_S = 120.0  # on a busy computer


@pytest.fixture(scope="module")
def walk() -> Walk:
    return Walk(NOISE_PX, seed=5)


@pytest.fixture(scope="module")
def looked(walk: Walk) -> list[Looked]:
    return list(islice(walk.looks(), 16))


def test_places_are_as_sure_as_they_say(looked: list[Looked]) -> None:
    """Sixteen times six squared normal numbers: 6 on average, with a deviation of 0.87."""
    points = [told_point(one, one.pose.best) for one in looked]
    assert 3.0 < np.mean([one.mahalanobis2 for one in points]) < 9.5
    for one in points:
        off_m = np.array([one.x_m, one.y_m, one.z_m]) - one.true_m
        assert (np.abs(off_m) < 5 * np.array(one.sd_m)).all()
        assert max(one.sd_m) < 0.02


def test_the_camera_looks_where_the_markers_are(looked: list[Looked], walk: Walk) -> None:
    point = told_point(looked[0], looked[0].pose.best)
    seen = {one.id for one in looked[0].detections}
    middles = [
        np.add(one.left_m, one.right_m) / 2
        for one in map(told_marker, walk.marker_map.markers)
        if one.id in seen
    ]
    ahead = np.array([np.cos(point.heading_rad), np.sin(point.heading_rad)])
    assert all((middle - [point.x_m, point.y_m]) @ ahead > 0 for middle in middles)


def test_markers_are_as_wide_from_above_as_they_are(walk: Walk) -> None:
    told = [told_marker(one) for one in walk.marker_map.markers]
    assert len({one.id for one in told}) == len(told) == 12
    widths = [np.linalg.norm(np.subtract(one.left_m, one.right_m)) for one in told]
    np.testing.assert_allclose(
        widths, [one.size_m for one in walk.marker_map.markers], rtol=5e-3
    )  # hung a little askew


def test_residuals_are_those_of_the_noise(looked: list[Looked], walk: Walk) -> None:
    told = [told_residuals(one, one.pose.best, walk.marker_map) for one in looked]
    rms_px = np.array([one.rms_px for of_image in told for one in of_image if one.is_used])
    assert 0.4 * NOISE_PX < np.sqrt((rms_px**2).mean()) < 2**0.5 * NOISE_PX
    assert all(one.why for of_image in told for one in of_image if not one.is_used)


def asked(room: Room, message: object) -> None:
    room.takers[type(message)](message)


def test_is_carried_until_somebody_stops_it() -> None:
    told: list[LocateTrace] = []
    room = locate_room(told.append, Path("nowhere"))
    asked(room, StartLocate(NOISE_PX))
    with pytest.raises(InputError, match="being carried already"):
        asked(room, StartLocate(NOISE_PX))
    eventually(lambda: told and len(told[-1].path) >= 2, WAITS_S)
    asked(room, StopLocate())
    eventually(lambda: not told[-1].is_running, WAITS_S)
    assert told[-1].why == "stopped by hand"
    assert len(told[-1].markers) == 12
    room.close()


@pytest.mark.parametrize(
    ("message", "why"),
    [
        (StartLocate(0.0), "expected a noise of 0.01 to 2.0 px, got 0"),
        (StartLocate(3.0), "expected a noise of 0.01 to 2.0 px"),
        (StartLocate(float("nan")), "expected a noise"),
        (StopLocate(), "the camera is not being carried"),
    ],
)
def test_what_cannot_be_done_is_refused(message: object, why: str) -> None:
    room = locate_room(lambda _: None, Path("nowhere"))
    with pytest.raises(InputError, match=re.escape(why)):
        asked(room, message)


@pytest.fixture(scope="module")
def maps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a map, a camera, and pictures of a board that is the whole world."""
    folder = tmp_path_factory.mktemp("maps")
    marks = [
        MapMarker(one.family, one.id, one.size_m, one.T_body_marker) for one in WORLD.markers()
    ]
    save_map(MarkerMap(tuple(marks), "board"), folder / "room.yaml")
    save_camera(CAMERA, folder / "camera.yaml")
    (folder / "walk").mkdir()
    shot = Shot(CAMERA, Still(RigidTransform.identity()))
    for number, T_camera_world in enumerate(Ts_CAMERA_WORLD):
        scene = Scene((board_thing(WORLD, Still(T_camera_world), margin_m=0.02),))
        pixels = photograph(scene, shot, np.random.default_rng(number))
        cv2.imwrite(str(folder / "walk" / f"{number}.png"), pixels)
    return folder


def test_images_of_the_servers_folder_say_where_the_camera_was(maps: Path) -> None:
    told: list[LocateTrace] = []
    room = locate_room(told.append, maps)
    asked(room, LocateImages("room.yaml", "camera.yaml", "walk"))
    eventually(lambda: told and not told[-1].is_running, WAITS_S)
    room.close()
    assert told[-1].why == ""
    assert len(told[-1].markers) == 6
    assert len(told[-1].path) == 2
    for point, T_camera_world in zip(told[-1].path, Ts_CAMERA_WORLD, strict=True):
        off_m = np.subtract((point.x_m, point.y_m, point.z_m), T_camera_world.inv().translation)
        assert (np.abs(off_m) < 5 * np.array(point.sd_m) + 1e-3).all()
        assert np.linalg.norm(off_m) < 0.03
        assert point.true_m is None
        assert point.mahalanobis2 is None
    assert told[-1].residuals
    assert max(one.rms_px for one in told[-1].residuals if one.is_used) < 1.0


@pytest.mark.parametrize("name", ["", "..", ".", "../room.yaml", "a/b", "/etc/hosts", "a\x00", "~"])
def test_a_name_that_is_no_plain_one_is_refused(maps: Path, name: str) -> None:
    room = locate_room(lambda _: None, maps)
    for names in ((name, "camera.yaml", "walk"), ("room.yaml", name, "walk"),
                  ("room.yaml", "camera.yaml", name)):  # fmt: skip
        with pytest.raises(InputError, match="expected a name of 1 to 60"):
            asked(room, LocateImages(*names))


def test_what_is_not_in_the_folder_or_leads_out_of_it_is_refused(maps: Path) -> None:
    (maps / "away").symlink_to(maps.parent)
    room = locate_room(lambda _: None, maps)
    for images in ("nothing.mp4", "away"):
        with pytest.raises(InputError, match=f"there is no {images} in the server's folder"):
            asked(room, LocateImages("room.yaml", "camera.yaml", images))


def test_a_file_that_is_no_map_is_told_in_words(maps: Path) -> None:
    told: list[LocateTrace] = []
    (maps / "broken.yaml").write_text("[1, 2")
    room = locate_room(told.append, maps)
    asked(room, LocateImages("broken.yaml", "camera.yaml", "walk"))
    eventually(lambda: told and not told[-1].is_running)
    assert "broken.yaml" in told[-1].why
    room.close()

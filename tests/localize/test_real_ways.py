"""Ways through real worlds of markers, against motion capture and against maps made apart."""

import csv
import os
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from surveyed_world import surveyed_map

from tagmetry import Detector
from tagmetry.camera import BrownLens, Camera
from tagmetry.files.lengths import parse_sizes_m
from tagmetry.files.maps import MapDefaults, load_map
from tagmetry.geometry import RigidTransform, UncertainTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import Localizer, MarkerMap
from tagmetry.localize.trajectory import Spread, Trajectory, compare
from tagmetry.markers import AprilGrid

DATA = Path(os.environ.get("TAGMETRY_DATA", Path(__file__).parents[3] / "shared" / "data"))
BOARD = AprilGrid(6, 6, 0.088, 0.3).body()


def folder(name):
    if not (DATA / name).is_dir():
        pytest.skip(f"no pictures {name}: set TAGMETRY_DATA to the folder that has them")
    return DATA / name


def grey(path):
    return cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)


def way(times_s, views, marker_map, camera, method="joint"):
    """Return the located pictures as a trajectory, and the poses themselves."""
    localizer = Localizer(marker_map, camera, method)
    found = [(time_s, localizer.locate(seen)) for time_s, seen in zip(times_s, views, strict=True)]
    found = [(time_s, pose) for time_s, pose in found if pose.hypotheses]
    poses = RigidTransform.concatenate([pose.T_world_camera for _, pose in found])
    return Trajectory(np.array([time_s for time_s, _ in found]), poses), [p for _, p in found]


def told(name, found):
    """Print the usual measures, for the docs."""
    shift, turn = Spread.of(1000 * found.absolute_m), Spread.of(np.degrees(found.absolute_rad))
    step = Spread.of(1000 * found.relative_m)
    print(
        f"\n{name}: {len(found.absolute_m)} pictures, {found.both.true.length_m:.1f} m; "
        f"absolute {shift.rms:.2f} mm rms, {shift.median:.2f} median, {turn.rms:.3f} degrees rms; "
        f"relative {step.rms:.2f} mm rms, {np.degrees(Spread.of(found.relative_rad).rms):.3f} deg"
    )
    return shift, turn


@pytest.fixture(scope="module")
def captured():
    """Times, markers and camera of the pictures, and what motion capture says of the camera."""
    pictures = folder("mocap_aprilgrid")
    paths = sorted((pictures / "cam0/data").glob("*.jpg"))
    detector = Detector(["tag36h11_border2"])
    views = [detector.detect(grey(path)) for path in paths]
    many = [seen for seen in views if len(seen) > 5]
    points = [
        np.float32(np.concatenate([BOARD.corners_m[d.family, d.id] for d in s])) for s in many
    ]
    pixels = [np.float32(np.concatenate([d.corners_px for d in s])) for s in many]
    _, K, lens, _, _ = cv2.calibrateCamera(points, pixels, (640, 480), None, None)
    camera = Camera.from_matrix(640, 480, K, BrownLens(tuple(lens.ravel()[:5])))
    with (pictures / "body0/data.csv").open() as file:
        rows = list(csv.reader(file))[1:]
    first_ns = int(rows[0][0])
    values = np.array([[float(x) for x in row[1:]] for row in rows])
    turns = Rotation.from_quat(values[:, 3:])
    true = Trajectory(
        np.array([(int(row[0]) - first_ns) / 1e9 for row in rows]),
        RigidTransform.from_components(values[:, :3], turns),
    )
    times_s = np.array([(int(path.stem) - first_ns) / 1e9 for path in paths])
    return times_s, views, camera, true


def test_a_way_before_a_board_agrees_with_motion_capture(captured):
    times_s, views, camera, true = captured
    board = MarkerMap.of_body(BOARD, UncertainTransform.exact(RigidTransform.identity()))
    rms_mm, rms_deg = {}, {}
    for method in ("single", "mean", "weighted", "covariance", "joint"):
        own, _ = way(times_s, views, board, camera, method)
        shift, turn = told(method, compare(own, true, align="rig"))
        rms_mm[method], rms_deg[method] = shift.rms, turn.rms
    assert len(own.times_s) == 30
    assert rms_mm["joint"] < 8.0
    assert rms_deg["joint"] < 0.35
    assert rms_mm["joint"] < 0.5 * rms_mm["weighted"]
    assert rms_deg["joint"] < 0.5 * rms_deg["weighted"]
    assert rms_mm["covariance"] < 0.5 * rms_mm["weighted"]


def seen_once(pixels, detector, K, lens):
    """Return the markers of a picture with corners freed of distortion."""
    return tuple(
        replace(d, corners_px=cv2.undistortPoints(d.corners_px[:, None], K, lens, P=K)[:, 0])
        for d in detector.detect(pixels)
    )


def corners(views):
    return [{d.id: d.corners_px for d in seen} for seen in views]


@pytest.mark.slow
def test_two_maps_of_a_house_from_different_pictures_agree_along_the_way():
    """Each round closes a loop through the rooms; nothing says where the markers truly are."""
    pictures = folder("house_tour") / "mapping_feb_2014"
    K, lens = chessboard_camera(sorted((pictures / "calibration").glob("*.JPG")))
    camera = Camera.from_matrix(816, 612, K)
    detector = Detector(["tag36h11"])
    views = [seen_once(grey(p), detector, K, lens) for p in sorted(pictures.glob("*.JPG"))]
    maps = [
        surveyed_map(corners(part), camera, 0.165, "tag36h11") for part in (views[:41], views[41:])
    ]
    assert [len(one.markers) for one in maps] == [20, 20]
    times_s = np.arange(72.0)
    ways = [way(times_s, views, one, camera)[0] for one in maps]
    found = compare(*ways, align="path")
    shift, turn = told("house", found)
    assert len(found.absolute_m) >= 70
    assert shift.rms < 250
    assert turn.rms < 4.0


def chessboard_camera(paths):
    """Return K and distortion by OpenCV from chessboards of 7x5 corners, 30 mm apart."""
    grid = np.zeros((35, 3), np.float32)
    grid[:, :2] = np.mgrid[0:7, 0:5].T.reshape(-1, 2) * 0.03
    pixels = []
    for path in paths:
        image = grey(path)
        is_seen, found = cv2.findChessboardCorners(image, (7, 5))
        if is_seen:
            pixels.append(cv2.cornerSubPix(image, found, (5, 5), (-1, -1), (3, 100, 1e-3)))
    flags = cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST
    size_px = image.shape[::-1]
    _, K, lens, _, _ = cv2.calibrateCamera(
        [grid] * len(pixels), pixels, size_px, None, None, flags=flags
    )
    return K, lens


def test_a_map_of_a_sheet_is_flat_and_all_its_pictures_are_located_in_it():
    pictures = folder("planar_map")
    K = np.array([[1366.43, 0, 961.648], [0, 1365.85, 533.627], [0, 0, 1]])
    camera = Camera.from_matrix(1920, 1080, K)
    detector = Detector(["aruco_original"])
    views = [detector.detect(grey(pictures / f"image_{n}.png")) for n in range(15)]
    sheet = surveyed_map(corners(views), camera, 0.0307, "aruco_original")
    assert len(sheet.markers) == 11
    middles = np.array([one.T_world_marker.translation for one in sheet.markers])
    off_mm = 1000 * np.linalg.svd(middles - middles.mean(axis=0))[1][2] / np.sqrt(11)
    own, poses = way(np.arange(15.0), views, sheet, camera)
    apart = [
        np.linalg.norm(camera.project(T.inv().apply(marker.p_world)) - d.corners_px, axis=1)
        for T, seen in zip(own.poses, views, strict=True)
        for d in seen
        for marker in (sheet.by_key[d.family, d.id],)
    ]
    rms_px = float(np.sqrt(np.mean(np.square(apart))))
    print(f"\nsheet: {off_mm:.2f} mm out of its plane, {rms_px:.2f} px from the corners")
    assert len(poses) == 15
    assert off_mm < 2.0
    assert rms_px < 3.0  # nothing is known of the lens's distortion


def images(path, every, count):
    """Give some grey images of a video."""
    av = pytest.importorskip("av")
    with av.open(str(path)) as container:
        for n, frame in enumerate(container.decode(video=0)):
            if n >= every * count:
                return
            if n % every == 0:
                yield frame.to_ndarray(format="gray")


def charuco_camera(path):
    """Return the camera of a video of a ChArUco board with 12x8 squares, by OpenCV."""
    family = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_5X5_1000)
    board = cv2.aruco.CharucoBoard((12, 8), 0.03, 0.022, family)
    detector, points, pixels = cv2.aruco.CharucoDetector(board), [], []
    for image in images(path, 12, 13):
        corners, ids, _, _ = detector.detectBoard(image)
        if ids is not None and len(ids) > 20:
            matched = board.matchImagePoints(corners, ids)
            points.append(matched[0])
            pixels.append(matched[1])
    _, K, lens, _, _ = cv2.calibrateCamera(points, pixels, (1920, 1080), None, None)
    return Camera.from_matrix(1920, 1080, K, BrownLens(tuple(lens.ravel()[:5])))


@pytest.mark.slow
def test_two_tags_of_a_field_place_the_camera_alike():
    """The map is the nominal one: along y it is some centimetres off, the same in all images."""
    pytest.importorskip("av")
    pictures = folder("field_video")
    camera = charuco_camera(pictures / "testcalibration.mp4")
    sizes = MapDefaults("tag36h11", parse_sizes_m("165.1mm"))
    field = load_map(pictures / "2024-crescendo.json", sizes)
    detector = Detector(["tag36h11"])
    video = pictures / "fieldvideo/long.mp4"
    views = [detector.detect(one, camera) for one in images(video, 16, 10)]
    assert all({d.id for d in seen} == {3, 4} for seen in views)
    ways = [
        way(np.arange(10.0), [[d for d in seen if d.id == k] for seen in views], field, camera)[0]
        for k in (3, 4)
    ]
    apart_mm = 1000 * np.abs(ways[0].positions_m - ways[1].positions_m)
    found = compare(*ways)
    shift, turn = told("field, by tag 3 against tag 4", found)
    print(f"x, y, z apart {apart_mm.mean(axis=0).round(1)} mm")
    assert shift.rms < 60
    assert turn.largest < 2.0
    assert apart_mm[:, [0, 2]].max() < 15
    assert Spread.of(1000 * found.relative_m).rms < 10

"""Compiles every kernel once, by doing each kind of work on a small picture.

Numba keeps what is compiled for later runs; several processes or threads may do so at a time.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from tagmetry.arena import Arena, Mount, Neighbourhood, OverheadView, Robot, Roster
from tagmetry.calibrate.targets import find_board
from tagmetry.camera import Camera
from tagmetry.camera.brown_lens import BrownLens
from tagmetry.camera.fisheye_lens import FisheyeLens
from tagmetry.detect import Detector, Tracker
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import METHODS, Localizer, MapMarker, MarkerMap
from tagmetry.markers import Chessboard, CircleGrid, MountedMarker
from tagmetry.pose import estimate_poses
from tagmetry.twin import Look, Scene, Shot, photograph, render
from tagmetry.twin.scenes import Still, board_thing

_SIZE_M = 0.1
_LENS = BrownLens((0.05, -0.02, 0.001, 0.001, 0.0))
_CAMERA = Camera(240, 180, (200.0, 200.0), (119.5, 89.5), _LENS)
_FAMILIES = ("tag36h11", "tagStandard41h12")
_FACING = Rotation.from_euler("x", 170, degrees=True)


@dataclass(frozen=True)
class Step:
    """One kind of work.

    Attributes:
        name: What it is, for people.
        run: Does it.
    """

    name: str
    run: Callable[[], object]


def steps() -> tuple[Step, ...]:
    """Return all kinds of work whose loops are compiled."""
    return (
        Step("simulation", _simulate),
        Step("detection", _detect),
        Step("poses", _measure),
        Step("localization", _locate),
        Step("tracking", _track),
        Step("arena", _follow),
        Step("calibration", _find_board),
    )


def warmed() -> Iterator[str]:
    """Do one step after another; give the name of each when it is done."""
    for step in steps():
        step.run()
        yield step.name


def _simulate() -> None:
    """Render through each kind of lens, with round things too."""
    dots = board_thing(CircleGrid(4, 3, 0.02, 0.012), _before(0.3))
    for lens in (_LENS, FisheyeLens((0.01, 0.0, 0.0, 0.0))):
        camera = Camera(64, 48, (60.0, 60.0), (31.5, 23.5), lens)
        shot = Shot(camera, Still(RigidTransform.identity()))
        photograph(Scene((dots,)), shot, np.random.default_rng(0))
    _picture()


def _detect() -> None:
    """Find dark, bright, large, small and blurred markers, with and without a lens."""
    detector = Detector(_FAMILIES, inverted=True, min_side_px=8)
    for picture in (_picture(), _picture(side_px=13.0)):
        detector.detect(picture)
        detector.detect(picture, _CAMERA)


def _measure() -> None:
    found = Detector().detect(_picture(), _CAMERA)
    estimate_poses(found, _CAMERA, [_SIZE_M] * len(found))


def _locate() -> None:
    """Find a camera from two markers of a map, one of which has a doubtful place."""
    known = [
        MapMarker(one.family, one.id, one.size_m, one.T_body_marker, doubt_m2 * np.eye(6))
        for one, doubt_m2 in zip(_mounted(40.0), (0.0, 1e-6), strict=True)
    ]
    found = Detector(_FAMILIES).detect(_picture(), _CAMERA)
    for method in METHODS.values():
        Localizer(MarkerMap(tuple(known)), _CAMERA, method).locate(found)


def _track() -> None:
    tracker, picture = Tracker(), _picture()
    for k in range(2):
        tracker.track(picture, k / 30, _CAMERA)


def _follow() -> None:
    """Follow a robot that is seen twice, and tell it whom it senses."""
    robot = Robot(1, "robot", _SIZE_M, _FAMILIES[0], 3, _SIZE_M, Mount(_SIZE_M))
    above = RigidTransform.from_components([0.0, 0.0, 1.0], _FACING)
    arena = Arena(Roster((robot,)), OverheadView(_CAMERA, above, np.zeros((6, 6))))
    found = Detector(_FAMILIES).detect(_picture(), _CAMERA)
    for k in range(2):
        Neighbourhood().tell(arena.take(found, k / 30).world)


def _find_board() -> None:
    board = Chessboard(7, 5, 0.03)
    shot = Shot(_CAMERA, Still(RigidTransform.identity()))
    scene = Scene((board_thing(board, _before(0.3)),))
    find_board(photograph(scene, shot, np.random.default_rng(0)), board)


def _picture(side_px: float = 40.0) -> GreyPixels:
    """Return a picture of two markers."""
    rng = np.random.default_rng(0)
    return render(_mounted(side_px), RigidTransform.identity(), _CAMERA, rng, Look())


def _mounted(side_px: float) -> list[MountedMarker]:
    """Return two markers before the camera, of about that size in its picture."""
    depth_m = _CAMERA.focal_px[0] * _SIZE_M / side_px
    return [
        MountedMarker(name, 3, _SIZE_M, _before(depth_m, x_m).T_world_thing)
        for name, x_m in zip(_FAMILIES, (-0.08, 0.1), strict=True)
    ]


def _before(depth_m: float, x_m: float = 0.0) -> Still:
    """Return the place of something that faces the camera."""
    return Still(RigidTransform.from_components([x_m, 0.0, depth_m], _FACING))

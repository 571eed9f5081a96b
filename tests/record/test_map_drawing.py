"""The drawing of a map shows where the camera was and where it looked."""

import cv2
import numpy as np
import pytest

from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.record.map_drawing import map_picture

pytest.importorskip("matplotlib", reason="drawings need the part report")

FACING = RigidTransform.from_rotation(Rotation.from_euler("x", 90, degrees=True))
MAP = MarkerMap((MapMarker("tag36h11", 7, 0.2, FACING),))


def camera_at(turn_deg: float) -> RigidTransform:
    """Return a level camera that looks along the world's y, turned to its left."""
    turn = Rotation.from_euler("z", turn_deg, degrees=True) * Rotation.from_euler("x", -np.pi / 2)
    return RigidTransform.from_components([0.0, -1.0, 0.0], turn)


def redness(*Ts_world_camera: RigidTransform) -> np.ndarray:
    """Return where the picture is of the camera's colour."""
    drawn = cv2.imdecode(np.frombuffer(map_picture(MAP, Ts_world_camera), np.uint8), 1).astype(int)
    return (drawn[..., 2] > 150) & (drawn[..., 1] < 130) & (drawn[..., 0] < 90)


def test_a_line_shows_where_the_camera_looks() -> None:
    ahead, left = redness(camera_at(0)), redness(camera_at(90))
    half = ahead.shape[1] // 2
    ahead_high, ahead_wide = (np.ptp(axis) for axis in np.nonzero(ahead[:, :half]))
    left_high, left_wide = (np.ptp(axis) for axis in np.nonzero(left[:, :half]))
    assert ahead_high > left_high
    assert left_wide > ahead_wide


def test_a_map_alone_shows_no_camera() -> None:
    assert not redness().any()


def test_a_long_way_has_a_line_here_and_there_only() -> None:
    way = [camera_at(turn_deg) for turn_deg in np.linspace(0, 90, 300)]
    assert redness(*way).any()

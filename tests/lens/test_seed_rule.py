"""Equations 1 to 8 of the paper, by its own numbers."""

import numpy as np
import pytest
from lens_example import FOCUS, ZOOM, camera_at

from tagmetry.camera import zoomed
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.lens import SeedRule, real_depth_m


@pytest.mark.parametrize(
    ("depth_m", "zoom", "focus"),
    [(0.05, 100, 130), (0.1, 150, 101), (0.45, 500, 38), (1.0, 500, 4), (1.05, 500, 2)],
)
def test_equations_1_and_3(depth_m: float, zoom: float, focus: float) -> None:
    setting = SeedRule().setting(depth_m, ZOOM, FOCUS)
    assert (setting.zoom_percent, setting.focus) == (zoom, focus)
    assert setting.magnification == zoom / 100


def pose(depth_m: float = 0.5, turn_deg: float = 20.0) -> RigidTransform:
    facing = Rotation.from_euler("yx", [turn_deg, 180], degrees=True)
    return RigidTransform.from_components([0, 0, depth_m], facing)


def test_position_and_posture_settle_by_their_own_thresholds() -> None:
    rule = SeedRule()
    assert rule.has_settled(pose(), pose(0.5009, 20.009))
    assert not rule.has_settled(pose(), pose(0.5011))
    assert not rule.has_settled(pose(), pose(0.5, 20.02))  # equation 7 means t_q
    assert rule.has_settled(pose(), pose(0.5, 20.02), by_posture=False)
    assert rule.has_settled(pose(), pose(0.6), by_position=False)


def test_a_turn_past_half_a_circle_is_small() -> None:
    rule = SeedRule(posture_rad=0.1)
    around = [
        pose() * RigidTransform.from_rotation(Rotation.from_euler("z", a, degrees=True))
        for a in (179, -179)
    ]
    assert rule.has_settled(*around, by_position=False)


def test_equation_8_is_what_zoomed_intrinsics_do() -> None:
    p_camera = np.array([[-0.005, 0.0, 0.5], [0.005, 0.0, 0.5]])
    plain = camera_at(35.0)
    at_300 = zoomed(plain, 3.0).project(p_camera)
    width_px = np.ptp(at_300[:, 0])
    apparent_m = plain.focal_px[0] * 0.01 / width_px
    assert real_depth_m(apparent_m, 300.0) == pytest.approx(0.5, rel=1e-4)


def test_a_depth_that_is_none_is_refused() -> None:
    with pytest.raises(InputError, match="depth must be positive"):
        SeedRule().setting(-0.1, ZOOM, FOCUS)

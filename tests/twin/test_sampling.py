"""A picture computed four times finer shows the same corners, to 0.002 px.

The corners are measured from the light (`edge_measuring`); the true sides only choose windows.
"""

import numpy as np
import pytest
from edge_measuring import outline_corners
from tilted_squares import LENSES, camera, degree_of, sides_px, tilted

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin import Optics, Scene, Shot, Shutter, Thing, exposed
from tagmetry.twin.optics.thin_lens import ThinLens
from tagmetry.twin.scenes import Path, Sheet, Steady, Still

AT_CAMERA = Still(RigidTransform.identity())
PLAIN = camera(LENSES["none"])


def square(path: Path, width_m: float = 0.12, height_m: float = 0.12) -> tuple[Scene, Sheet]:
    sheet = Sheet(width_m, height_m, paper=0.06)
    return Scene((Thing("square", (sheet,), path=path),), background=0.85), sheet


def moved_px(
    scene: Scene, shot: dict, nominal: list[Array], degree: int = 1, extra_px: float = 0.0
) -> float:
    """How far the corners are apart in pictures of sampling 1 and 4."""
    blur_px = shot.get("optics", Optics()).blur_px
    seer = shot.pop("camera", PLAIN)
    once, finer = (
        outline_corners(
            exposed(scene, Shot(seer, AT_CAMERA, sampling=sampling, **shot)),
            nominal,
            degree,
            blur_px,
            extra_px,
        )
        for sampling in (1, 4)
    )
    return float(np.abs(finer - once).max())


@pytest.mark.parametrize("blur_px", [0.0, 0.6])
@pytest.mark.parametrize("tilt_deg", [0, 50, 75, 80])
def test_at_steep_angles(tilt_deg: float, blur_px: float) -> None:
    T_camera_sheet = tilted(tilt_deg, 0.4)
    scene, sheet = square(Still(T_camera_sheet), 0.1, 0.06 / np.cos(np.deg2rad(tilt_deg)))
    nominal = sides_px(sheet.corners_m, T_camera_sheet, PLAIN)
    assert moved_px(scene, {"optics": Optics(blur_px=blur_px)}, nominal) < 0.002


@pytest.mark.parametrize("blur_px", [0.0, pytest.param(0.6, marks=pytest.mark.slow)])
def test_on_a_floor_near_the_horizon(blur_px: float) -> None:
    """A strip of 4 m x 30 m from 2 m above, whose far edge is 3 degrees below the horizon."""
    lying = Rotation.from_euler("x", 90, degrees=True)
    T_camera_sheet = RigidTransform.from_components([0.3, 2.0, 24.0], lying)
    assert (T_camera_sheet.rotation.as_matrix()[:, 2] @ [0, -1, 0]) > 0.99  # it faces up
    scene, sheet = square(Still(T_camera_sheet), 4.0, 30.0)
    nominal = sides_px(sheet.corners_m, T_camera_sheet, PLAIN)
    assert moved_px(scene, {"optics": Optics(blur_px=blur_px)}, nominal) < 0.002


@pytest.mark.parametrize("name", [name for name in LENSES if name != "none"])
def test_with_distortion(name: str) -> None:
    seer, T_camera_sheet = camera(LENSES[name]), tilted(40, 0.2)
    scene, sheet = square(Still(T_camera_sheet), 0.3, 0.4)
    nominal = sides_px(sheet.corners_m, T_camera_sheet, seer)
    assert moved_px(scene, {"camera": seer}, nominal, degree_of(LENSES[name], 200)) < 0.002


@pytest.mark.parametrize("turn_rad_s", [0.0, 0.6])
def test_in_motion(turn_rad_s: float) -> None:
    """Some 6 px during the exposure."""
    T_camera_sheet = tilted(50, 0.2)
    path = Steady(T_camera_sheet, np.array([0.6, 0.3, 0.2]), np.array([0.0, 0.0, turn_rad_s]))
    scene, sheet = square(path, 0.14, 0.2)
    nominal = sides_px(sheet.corners_m, T_camera_sheet, PLAIN)
    shot = {"shutter": Shutter(exposure_s=0.015)}
    assert moved_px(scene, shot, nominal, degree=2, extra_px=5.0) < 0.002


def test_with_a_rolling_shutter() -> None:
    T_camera_sheet = tilted(50, 0.2)
    path = Steady(T_camera_sheet, np.array([0.5, 0.2, 0.0]), np.array([0.0, 0.0, 0.5]))
    scene, sheet = square(path, 0.14, 0.2)
    nominal = sides_px(sheet.corners_m, T_camera_sheet, PLAIN)
    shot = {"shutter": Shutter(line_s=30e-6)}
    assert moved_px(scene, shot, nominal, degree=3, extra_px=3.0) < 0.002


@pytest.mark.parametrize("tilt_deg", [0, 45])
def test_out_of_focus(tilt_deg: float) -> None:
    """Discs of some 3 px."""
    lens = ThinLens(0.006, 0.003, 1e-5)
    T_camera_sheet = tilted(tilt_deg, 0.2)
    scene, sheet = square(Still(T_camera_sheet), 0.14, 0.14)
    nominal = sides_px(sheet.corners_m, T_camera_sheet, PLAIN)
    optics = Optics(lens=lens, focus_m=0.25)
    assert 2 < lens.blur_radius_px(1.0, 0.25) < 4
    assert moved_px(scene, {"optics": optics}, nominal, extra_px=5.0) < 0.002


def test_finer_is_not_the_same_picture() -> None:
    """Else the comparison would say nothing."""
    camera_ = Camera(80, 60, (60.0, 60.0), (39.5, 29.5))
    scene, _ = square(Still(tilted(60, 0.0)), 0.5, 0.5)
    once, finer = (exposed(scene, Shot(camera_, AT_CAMERA, sampling=k)) for k in (1, 4))
    assert np.abs(once - finer).max() > 1e-5

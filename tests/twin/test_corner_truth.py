"""Corners stand where the formulas say to 0.001 px, as the picture alone shows.

`edge_measuring` reads the edges from the light, `lens_formulas` writes the projection again; no
code of the renderer's or of tagmetry's camera takes part. A square is stretched by what its tilt
foreshortens, so that it appears about as wide as high.

What remains, and why: a footprint's mean is taken over the sheet (at most 0.00025 px, `lean`), its
sides are straight on the sheet (1e-5 px at these lenses), and a polynomial is not quite a bent
side. A sum of light says nothing about an edge's profile: `test_spread` and `test_render` do.
"""

import cv2
import numpy as np
import pytest
from edge_measuring import outline_corners
from lens_formulas import project_px
from tilted_squares import LENSES, camera, degree_of, sides_px, tilted

from tagmetry.camera import Lens
from tagmetry.geometry import Array, RigidTransform
from tagmetry.markers import MountedMarker
from tagmetry.twin import Optics, Scene, Shot, Thing, exposed
from tagmetry.twin.scenes import Sheet, Still, marker_thing

SHIFTS_PX = (0.0, 0.31, 0.77)
INK, BRIGHT = 0.06, 0.85
AT_CAMERA = Still(RigidTransform.identity())


def errors_px(size_px: float, tilt_deg: float, blur_px: float, lens: Lens) -> Array:
    """The distances of the measured corners from the true ones, over the shifts."""
    seer = camera(lens)
    width_m = size_px / 600.0
    sheet = Sheet(width_m, width_m / np.cos(np.deg2rad(tilt_deg)), paper=INK)
    missed = []
    for shift_px in SHIFTS_PX:
        T_camera_sheet = tilted(tilt_deg, shift_px)
        scene = Scene((Thing("square", (sheet,), path=Still(T_camera_sheet)),), background=BRIGHT)
        picture = exposed(scene, Shot(seer, AT_CAMERA, optics=Optics(blur_px=blur_px)))
        sides = sides_px(sheet.corners_m, T_camera_sheet, seer)
        found = outline_corners(picture, sides, degree_of(lens, size_px), blur_px)
        missed.append(np.abs(found - project_px(T_camera_sheet.apply(sheet.corners_m), seer)))
    return np.concatenate(missed)


@pytest.mark.parametrize("lens", LENSES.values(), ids=LENSES.keys())
@pytest.mark.parametrize("tilt_deg", [0, 30, 60, 75])
@pytest.mark.parametrize(
    ("size_px", "blur_px"),
    [
        (20, 0.0),
        (40, 0.6),
        pytest.param(60, 0.0, marks=pytest.mark.slow),
        pytest.param(60, 0.6, marks=pytest.mark.slow),
        pytest.param(60, 1.2, marks=pytest.mark.slow),
        pytest.param(120, 0.0, marks=pytest.mark.slow),
        pytest.param(120, 0.6, marks=pytest.mark.slow),
    ],
)
def test_corners_are_true(size_px: float, tilt_deg: float, blur_px: float, lens: Lens) -> None:
    missed = errors_px(size_px, tilt_deg, blur_px, lens)
    assert missed.max() < 0.001
    assert np.sqrt(np.mean(missed**2)) < 0.0005


@pytest.mark.slow
@pytest.mark.parametrize("lens", LENSES.values(), ids=LENSES.keys())
@pytest.mark.parametrize("blur_px", [0.0, 0.6, 1.2])
def test_large_squares_are_true(blur_px: float, lens: Lens) -> None:
    for tilt_deg in (0, 30, 60):
        assert errors_px(200, tilt_deg, blur_px, lens).max() < 0.001


@pytest.mark.parametrize("tilt_deg", [0, 30, 60])
@pytest.mark.parametrize("lens", LENSES.values(), ids=LENSES.keys())
def test_a_markers_black_border_is_true(lens: Lens, tilt_deg: float) -> None:
    """The print on a sheet, not the sheet's own outline."""
    seer, T_camera_marker = camera(lens), tilted(tilt_deg, 0.4)
    marker = MountedMarker("tag36h11", 3, 0.28, RigidTransform.identity())
    scene = Scene((marker_thing([marker], Still(T_camera_marker)),))
    picture = exposed(scene, Shot(seer, AT_CAMERA))
    corners_m = Sheet(0.28, 0.28).corners_m
    sides = sides_px(corners_m, T_camera_marker, seer)
    found = outline_corners(picture, sides, 1 if lens is LENSES["none"] else 4)
    true = project_px(T_camera_marker.apply(corners_m), seer)
    np.testing.assert_allclose(found, true, atol=0.001)


@pytest.mark.parametrize("focal_px", [150.0, 300.0, 3000.0])
def test_wide_and_long_lenses_are_true_at_a_steep_angle(focal_px: float) -> None:
    seer, T_camera_sheet = camera(LENSES["none"], focal_px), tilted(70, 0.3, focal_px)
    sheet = Sheet(50 / focal_px, 100 / focal_px, paper=INK)
    scene = Scene((Thing("square", (sheet,), path=Still(T_camera_sheet)),), background=BRIGHT)
    picture = exposed(scene, Shot(seer, AT_CAMERA))
    found = outline_corners(picture, sides_px(sheet.corners_m, T_camera_sheet, seer))
    true = project_px(T_camera_sheet.apply(sheet.corners_m), seer)
    np.testing.assert_allclose(found, true, atol=0.001)


@pytest.mark.parametrize("lens", LENSES.values(), ids=LENSES.keys())
def test_the_formulas_are_opencvs(lens: Lens) -> None:
    rng = np.random.default_rng(0)
    p_camera = np.column_stack([rng.uniform(-0.4, 0.4, (50, 2)), rng.uniform(1, 2, 50)])
    seer = camera(lens)
    K = np.array([[600.0, 0, 282.3], [0, 606.0, 217.6], [0, 0, 1]])
    project = cv2.fisheye.projectPoints if lens.kind == "fisheye" else cv2.projectPoints
    points, still = p_camera[:, None], np.zeros(3)
    seen, _ = project(points, still, still, K, np.array(lens.coefficients))
    np.testing.assert_allclose(project_px(p_camera, seer), seen[:, 0], atol=1e-9)

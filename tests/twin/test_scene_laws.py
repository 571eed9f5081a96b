"""Laws of light, order, motion and tiles, against closed forms or another way to the picture."""

import numpy as np
import pytest

from tagmetry.camera import Camera, FisheyeLens
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin import Optics, Scene, Shot, Shutter, Thing, exposed
from tagmetry.twin.rendering import expose
from tagmetry.twin.scenes import Dot, Lamp, Light, Sheet, Steady, Still

CAMERA = Camera(240, 200, (300.0, 300.0), (119.5, 99.5))
AT_ORIGIN = Still(RigidTransform.identity())
FACING = Rotation.from_euler("x", 180, degrees=True)


def placed(x_m: float, y_m: float, z_m: float, turn: Rotation = FACING) -> Still:
    return Still(RigidTransform.from_components([x_m, y_m, z_m], turn))


def sheet(path: Still | Steady, width_m: float, height_m: float, **how: float) -> Thing:
    return Thing("sheet", (Sheet(width_m, height_m, **how),), path=path)


def picture(*things: Thing, light: Light | None = None, **how: object) -> Array:
    scene = Scene(things, light or Light(), background=0.0)
    return exposed(scene, Shot(how.pop("camera", CAMERA), AT_ORIGIN, **how)).astype(np.float64)


def test_light_adds() -> None:
    wall = sheet(placed(0, 0, 1), 3, 3)
    one, two = Lamp(np.array([0.3, 0.1, 0.2]), 0.4), Lamp(np.array([-0.5, 0.2, 0.1]), 0.7)
    both = picture(wall, light=Light(0.2, (one, two)))
    parts = (Light(0.2), Light(0.0, (one,)), Light(0.0, (two,)))
    np.testing.assert_allclose(both, sum(picture(wall, light=part) for part in parts), atol=1e-6)


@pytest.mark.parametrize("d_m", [0.5, 1.0, 2.0])
def test_a_lamp_fades_with_the_square_of_the_distance_and_the_cosine(d_m: float) -> None:
    """Straight before the lamp E = s / d^2; at the angle a aside it is s cos^3(a) / d^2."""
    lamp = Light(0.0, (Lamp(np.array([0.0, 0.0, 2.0 - d_m]), 0.3),))
    seen = picture(sheet(placed(0, 0, 2), 8, 8, paper=1.0), light=lamp)
    v, u = np.mgrid[:200, :240]
    aside_m = np.hypot((u - 119.5) / 300 * 2, (v - 99.5) / 300 * 2)
    expected = 0.3 / d_m**2 * np.cos(np.arctan(aside_m / d_m)) ** 3
    np.testing.assert_allclose(seen, expected, rtol=4e-4)  # the middle of a pixel, not its mean


def test_what_glows_needs_no_light_and_reflects_besides() -> None:
    window = sheet(placed(0, 0, 1), 3, 3, paper=0.5, glow=2.0)
    assert picture(window, light=Light(0.0)) == pytest.approx(2.0)
    assert picture(window, light=Light(0.6)) == pytest.approx(2.3)


def test_the_order_of_listing_does_not_matter_for_sheets_apart() -> None:
    rng = np.random.default_rng(1)
    things = [
        sheet(
            placed(*rng.uniform(-0.2, 0.2, 2), 0.6 + 0.12 * k, Rotation.from_rotvec(
                rng.uniform(-0.15, 0.15, 3)) * FACING),
            0.2, 0.15, paper=rng.uniform(0.1, 1.0),
        )
        for k in range(8)
    ]  # fmt: skip
    first = picture(*things)
    for _ in range(4):
        order = rng.permutation(len(things))
        np.testing.assert_array_equal(picture(*[things[i] for i in order]), first)


def test_a_floor_that_reaches_behind_the_camera_fills_all_below_the_horizon() -> None:
    floor = sheet(
        placed(0, 0.5, 0, Rotation.from_euler("x", 90, degrees=True)), 1e4, 1e4, paper=0.7
    )
    seen = picture(floor)
    np.testing.assert_allclose(seen[101:], 0.7, atol=1e-6)
    np.testing.assert_array_equal(seen[:99], 0.0)


@pytest.mark.parametrize("lens", [None, FisheyeLens((0.0, 0.0, 0.0, 0.0))])
def test_in_a_room_no_ray_gets_out(lens: FisheyeLens | None) -> None:
    """Walls inside a cube of 2 m around the camera; the fisheye sees past 90 degrees."""
    turns = [("x", 0), ("x", 90), ("x", 180), ("x", 270), ("y", 90), ("y", 270)]
    walls = []
    for axis, turn_deg in turns:
        turn = Rotation.from_euler(axis, turn_deg, degrees=True)
        inward = turn.as_matrix()[:, 2]
        walls.append(sheet(placed(*(-inward), turn), 2.0, 2.0, paper=0.6))
    seer = CAMERA if lens is None else Camera(240, 200, (70.0, 70.0), (119.5, 99.5), lens)
    seen = picture(*walls, camera=seer)
    through = 1 - seen / 0.6
    assert np.median(through) == pytest.approx(0.0, abs=1e-6)
    assert through.max() < 0.002  # nothing shows where walls meet


def test_nothing_shows_between_abutting_sheets() -> None:
    left, right = (sheet(placed(x, 0, 1), 0.2, 0.5, paper=0.6) for x in (-0.1, 0.1))
    through = 1 - picture(left, right)[60:140, 100:140] / 0.6
    assert through.max() < 1e-5


def test_a_sheet_almost_from_the_side_is_as_wide_as_its_projection() -> None:
    """A strip 0.18 px wide; the finest grid leaves 0.01 px of it uncertain."""
    tilt = FACING * Rotation.from_euler("y", 89.9, degrees=True)
    strip = sheet(placed(0.0, 0.0, 3.0, tilt), 1.0, 0.4, paper=1.0)
    near, far = 3.0 - 0.5 * np.sin(np.deg2rad(89.9)), 3.0 + 0.5 * np.sin(np.deg2rad(89.9))
    half = 0.5 * np.cos(np.deg2rad(89.9))
    corners = 300 * np.array([[half / near, 0.2 / near], [-half / far, 0.2 / far]])
    area_px2 = (corners[0, 0] - corners[1, 0]) * (corners[0, 1] + corners[1, 1])
    assert picture(strip).sum() == pytest.approx(area_px2, rel=0.06)


def test_the_ink_of_a_dot_is_its_area() -> None:
    dotted = Thing("dot", (Sheet(0.5, 0.5, (Dot(0.1, (0.02, -0.01)),), paper=1.0, ink=0.0),),
                   path=placed(0, 0, 1))  # fmt: skip
    missing = 0.5**2 * 300**2 - picture(dotted).sum()
    assert missing == pytest.approx(np.pi * 30**2, rel=1e-5)


@pytest.mark.parametrize("length_px", [0.7, 3.0, 8.0])
def test_a_moving_edge_is_a_ramp_of_its_motion(length_px: float) -> None:
    """A box of the motion's length over a box of a pixel."""
    path = Steady(placed(0, 0, 1).T_world_thing, np.array([length_px / 300, 0, 0]), np.zeros(3))
    seen = picture(sheet(path, 0.4, 0.4, paper=1.0), shutter=Shutter(exposure_s=1.0))[100, :119]
    steps = (np.arange(2000) + 0.5) / 2000 - 0.5
    edge = 119.5 - 60 + length_px * steps
    expected = np.clip(np.arange(119)[:, None] + 0.5 - edge, 0, 1).mean(axis=1)
    np.testing.assert_allclose(seen, expected, atol=0.25**2 / 8 / min(length_px, 1.0) + 0.01)


def test_a_rolling_shutter_shears() -> None:
    """Row v sees the edge moved by velocity (v - 99.5) line."""
    path = Steady(placed(0, 0, 1).T_world_thing, np.array([0.5, 0.0, 0.0]), np.zeros(3))
    seen = picture(sheet(path, 0.3, 0.5, paper=1.0), shutter=Shutter(line_s=1e-4))
    rows = np.arange(60, 140)
    edge_px = 119.5 - seen[rows, :120].sum(axis=1)
    expected = 119.5 - 45 + 300 * 0.5 * 1e-4 * (rows - 99.5)
    np.testing.assert_allclose(edge_px, expected, atol=1e-4)


@pytest.mark.parametrize("blur_px", [0.0, 0.8])
def test_what_is_of_one_tone_stays_so(blur_px: float) -> None:
    even = sheet(placed(0, 0, 1, FACING * Rotation.from_rotvec([0.3, 0.2, 0])), 5, 5, paper=0.4)
    np.testing.assert_allclose(picture(even, optics=Optics(blur_px=blur_px)), 0.4, atol=1e-6)


@pytest.mark.parametrize("seed", range(6))
def test_tiles_leave_no_seam_and_lose_nothing(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(seed)
    things = [
        sheet(
            placed(*rng.uniform(-0.5, 0.5, 2), rng.uniform(0.4, 2.0),
                   Rotation.from_rotvec(rng.uniform(-1, 1, 3)) * FACING),
            *rng.uniform(0.1, 0.6, 2), paper=rng.uniform(0.1, 1.0),
        )
        for _ in range(6)
    ]  # fmt: skip
    how = {"optics": Optics(blur_px=float(rng.choice([0.4, 0.9])))}
    monkeypatch.setattr(expose, "_TILE_PX", 1000)
    whole = picture(*things, **how)
    monkeypatch.setattr(expose, "_TILE_PX", 47)
    np.testing.assert_allclose(picture(*things, **how), whole, atol=0.01)

"""Offsets, turns and heights of markers are found again from robots that moved."""

import numpy as np
import pytest
from overhead import VIEW, marker_pose, moved, robot, seen

from tagmetry.arena import (
    Mount,
    OverheadView,
    fit_squares,
    height_at_places,
    height_by_size,
    offset_from_spin,
    turn_from_drive,
)
from tagmetry.errors import InputError
from tagmetry.geometry import Array, mahalanobis_squared

MOUNT = Mount(0.12, 0.021, -0.013, 0.4)
ONE = robot(3, 0.12, forward_m=0.021, left_m=-0.013, turn_rad=0.4)


def marker_places(places: Array, rng: np.random.Generator, height_m: float) -> Array:
    """Return the marker's places as they are measured with a height that may be wrong."""
    detections = [seen(ONE, place, VIEW, rng) for place in places]
    count = len(detections)
    return fit_squares(
        VIEW,
        np.array([d.corners_px for d in detections]),
        np.array([d.corners_cov_px2 for d in detections]),
        np.full(count, ONE.marker_size_m),
        np.full(count, height_m),
    ).places


def spin(count: int = 24, x_m: float = 0.5) -> Array:
    return np.array([(x_m, 0.3, f) for f in np.linspace(0, 2 * np.pi, count, endpoint=False)])


def drive(count: int = 20) -> Array:
    return np.array([(-0.4 + 0.04 * k, 0.1 + 0.03 * k, np.arctan2(3, 4)) for k in range(count)])


@pytest.mark.parametrize("height_m", [0.12, 0.0], ids=["right height", "height not known"])
def test_a_spin_and_a_drive_tell_where_the_marker_is(height_m: float) -> None:
    rng = np.random.default_rng(0)
    turned = offset_from_spin(marker_places(spin(), rng, height_m))
    driven = turn_from_drive(marker_places(drive(), rng, height_m), turned)
    assert driven.value == pytest.approx(MOUNT.turn_rad, abs=3e-3 if height_m else 2e-2)
    found = turned.forward_left_m(driven.value)
    scale = 1.0 if height_m else 2.5 / (2.5 - 0.12)  # a lower plane is farther, and so larger
    np.testing.assert_allclose(found, [scale * MOUNT.forward_m, scale * MOUNT.left_m], atol=1e-3)


def test_the_center_of_a_spin_is_the_robots() -> None:
    found = offset_from_spin(marker_places(spin(), np.random.default_rng(1), MOUNT.height_m))
    np.testing.assert_allclose(found.center_m, [0.5, 0.3], atol=2e-4)
    assert found.rms_m < 5e-4


def test_the_offsets_covariance_is_right() -> None:
    rng = np.random.default_rng(2)
    c, s = np.cos(MOUNT.turn_rad), np.sin(MOUNT.turn_rad)
    true = np.array([[c, s], [-s, c]]) @ [MOUNT.forward_m, MOUNT.left_m]
    found = [offset_from_spin(marker_places(spin(40), rng, MOUNT.height_m)) for _ in range(80)]
    distances = [mahalanobis_squared(one.offset_m - true, one.covariance) for one in found]
    assert np.mean(distances) == pytest.approx(2.0, abs=0.8)


def test_the_drives_deviation_is_right() -> None:
    rng = np.random.default_rng(3)
    turned = offset_from_spin(marker_places(spin(), rng, MOUNT.height_m))
    found = [
        turn_from_drive(marker_places(drive(), rng, MOUNT.height_m), turned) for _ in range(60)
    ]
    errors = np.array([(one.value - MOUNT.turn_rad) / one.sd for one in found])
    assert np.sqrt((errors**2).mean()) == pytest.approx(1.0, abs=0.35)


def test_a_drive_that_is_not_quite_straight_has_a_larger_deviation() -> None:
    rng, errors = np.random.default_rng(8), []
    still = offset_from_spin(spin())
    for _ in range(200):
        places = drive()
        places[:, :2] += 3e-3 * rng.standard_normal((len(places), 2))
        found = turn_from_drive(places, still)
        errors.append(found.value / found.sd)
    assert np.sqrt(np.mean(np.square(errors))) == pytest.approx(1.0, abs=0.15)


def test_a_robot_that_slips_while_it_turns_is_told_by_the_rms() -> None:
    places = spin()
    places[:, 0] += np.linspace(0, 0.03, len(places))
    found = offset_from_spin(marker_places(places, np.random.default_rng(4), MOUNT.height_m))
    assert found.rms_m > 4e-3


def test_the_markers_size_tells_its_height_with_its_deviation() -> None:
    rng = np.random.default_rng(5)
    sds = np.array([0, 0, 1e-3, 0, 0, 0])
    stated = OverheadView(VIEW.camera, VIEW.T_world_camera, np.diag(sds**2))
    places = np.random.default_rng(6).uniform([-0.8, -0.5, -3], [0.8, 0.5, 3], (15, 3))
    errors = []
    for _ in range(60):
        view = moved(stated, sds * rng.standard_normal(6))
        grown = robot(3, MOUNT.height_m)
        size_m = 0.08 * (1 + 1e-3 * rng.standard_normal())
        detections = [seen(grown, place, view, rng) for place in places]
        found = height_by_size(stated, detections, size_m, 8e-5)
        errors.append((found.value - MOUNT.height_m) / found.sd)
    assert np.sqrt(np.mean(np.square(errors))) == pytest.approx(1.0, abs=0.3)


def test_known_places_tell_the_height() -> None:
    places = np.array([(0.8, 0.5), (-0.8, 0.5), (0.8, -0.5), (-0.8, -0.5)])
    high = Mount(0.15)
    pixels = VIEW.camera.project(
        VIEW.T_world_camera.inv().apply([marker_pose([*p, 0.0], high).translation for p in places])
    )
    found = height_at_places(VIEW, pixels, places)
    assert found.value == pytest.approx(0.15, abs=1e-9)
    rng, heights = np.random.default_rng(7), []
    for _ in range(300):
        said = places + 1e-3 * rng.standard_normal(places.shape)
        heights.append(height_at_places(VIEW, pixels, said, 1e-3).value)
    assert np.std(heights) == pytest.approx(found.sd, rel=0.15)


def test_refuses_what_tells_nothing() -> None:
    with pytest.raises(InputError, match="three images or more over a quarter turn, got 2"):
        offset_from_spin(np.zeros((2, 3)))
    with pytest.raises(InputError, match="got 9 over 0 degrees"):
        offset_from_spin(np.zeros((9, 3)))
    turned = offset_from_spin(spin())
    with pytest.raises(InputError, match=r"0\.1 m or more, got 0\.000 m"):
        turn_from_drive(np.zeros((5, 3)), turned)
    with pytest.raises(InputError, match="at least one image"):
        height_by_size(VIEW, [], 0.1, 1e-3)
    foot = VIEW.T_world_camera.translation[:2]
    below = VIEW.camera.project(VIEW.T_world_camera.inv().apply([[*foot, 0.0]]))
    with pytest.raises(InputError, match="below the camera do not tell a height"):
        height_at_places(VIEW, below, foot[None])

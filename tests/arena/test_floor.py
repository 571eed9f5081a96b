"""The world from floor markers, and whether the camera is still where it was."""

from dataclasses import replace

import numpy as np
import pytest
from overhead import CAMERA, NOISE_PX, VIEW, detected, moved

from tagmetry.arena import (
    BumpRules,
    OverheadView,
    check_bump,
    floor_corners,
    lay_floor,
    view_from_floor,
)
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform, mahalanobis_squared, pose_difference
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import MapMarker, MarkerMap
from tagmetry.markers.bodies import MarkerKey

SIZE_M = 0.15
PLACES = ((0.0, 0.0, 0.0), (1.0, 0.0, 1.0), (0.9, 0.55, -2.0), (-0.8, 0.5, 0.3), (-0.7, -0.55, 3.0))
FLOOR = MarkerMap(
    tuple(
        MapMarker(
            "tag36h11",
            100 + n,
            SIZE_M,
            RigidTransform.from_components([x, y, 0.0], Rotation.from_euler("z", turn)),
        )
        for n, (x, y, turn) in enumerate(PLACES)
    )
)
ORIGIN, TOWARD = MarkerKey("tag36h11", 100), MarkerKey("tag36h11", 101)


def picture(rng: np.random.Generator | None = None, view: OverheadView = VIEW) -> list[Detection]:
    return [
        detected(one.family, one.id, one.size_m, one.T_world_marker, view, rng)
        for one in FLOOR.markers
    ]


def test_the_camera_is_where_known_floor_markers_have_it() -> None:
    found = view_from_floor(picture(), FLOOR, CAMERA)
    np.testing.assert_allclose(
        found.T_world_camera.as_matrix(), VIEW.T_world_camera.as_matrix(), atol=1e-6
    )


def test_refuses_an_image_without_floor_markers() -> None:
    with pytest.raises(InputError, match="camera's place over the floor is not told"):
        view_from_floor([replace(picture()[0], id=5)], FLOOR, CAMERA)


@pytest.mark.parametrize("toward", [TOWARD, None], ids=["to a marker", "to the right"])
def test_markers_that_lie_anywhere_are_found_where_they_are(toward: MarkerKey | None) -> None:
    laid = lay_floor(picture(), [SIZE_M] * 5, CAMERA, ORIGIN, toward)
    for found, true in zip(laid.floor.markers, FLOOR.markers, strict=True):
        np.testing.assert_allclose(
            found.T_world_marker.as_matrix(), true.T_world_marker.as_matrix(), atol=1e-5
        )
    np.testing.assert_allclose(
        laid.view.T_world_camera.as_matrix(), VIEW.T_world_camera.as_matrix(), atol=1e-5
    )


def test_the_world_is_the_origins_whatever_the_order() -> None:
    laid = lay_floor(picture()[::-1], [SIZE_M] * 5, CAMERA, TOWARD, MarkerKey("tag36h11", 102))
    by_key = laid.floor.by_key
    at = [by_key[MarkerKey("tag36h11", n)].T_world_marker.translation for n in (101, 102)]
    assert at[0] == pytest.approx([0, 0, 0], abs=1e-9)
    assert at[1] == pytest.approx([np.hypot(0.1, 0.55), 0, 0], abs=1e-5)


def test_covariances_of_camera_and_markers_are_right() -> None:
    rng = np.random.default_rng(0)
    of_camera, of_marker, chi2 = [], [], []
    rows = [0, 1, 5]
    for _ in range(60):
        laid = lay_floor(picture(rng), [SIZE_M] * 5, CAMERA, ORIGIN, TOWARD)
        off = pose_difference(laid.view.T_world_camera, VIEW.T_world_camera)
        of_camera.append(mahalanobis_squared(off, laid.view.covariance))
        marker = laid.floor.markers[2]
        off = pose_difference(marker.T_world_marker, FLOOR.markers[2].T_world_marker)[rows]
        of_marker.append(mahalanobis_squared(off, marker.covariance[np.ix_(rows, rows)]))
        chi2.append(laid.chi2 / laid.freedom)
    assert np.mean(of_camera) == pytest.approx(6.0, abs=1.2)
    assert np.mean(of_marker) == pytest.approx(3.0, abs=0.9)
    assert np.mean(chi2) == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize(
    ("origin", "toward", "match"),
    [
        (MarkerKey("tag36h11", 7), None, "origin's floor marker tag36h11 id 7 is not seen; .*100"),
        (ORIGIN, MarkerKey("tag36h11", 8), "x axis's floor marker tag36h11 id 8 is not seen"),
        (ORIGIN, ORIGIN, "another marker than the origin"),
    ],
)
def test_refuses_a_world_without_its_markers(
    origin: MarkerKey, toward: MarkerKey | None, match: str
) -> None:
    with pytest.raises(InputError, match=match):
        lay_floor(picture(), [SIZE_M] * 5, CAMERA, origin, toward)


def test_refuses_a_floor_marker_seen_twice() -> None:
    seen = picture()
    with pytest.raises(InputError, match="seen twice"):
        lay_floor([*seen, seen[0]], [SIZE_M] * 6, CAMERA, ORIGIN)


REFERENCE = floor_corners(picture(), FLOOR)
STRICT = BumpRules(tolerated_px=0.0)


def test_no_alarm_while_the_camera_stays() -> None:
    rng = np.random.default_rng(1)
    reference = floor_corners(picture(rng), FLOOR)
    found = [check_bump(picture(rng), reference, FLOOR, VIEW, STRICT) for _ in range(200)]
    assert not any(one.is_moved or one.moved_markers for one in found)
    assert np.mean([one.chi2 for one in found]) == pytest.approx(6.0, abs=4.0)  # one reference
    assert found[0].shift_px == pytest.approx(2 * NOISE_PX, rel=0.5)


@pytest.mark.parametrize(
    "change",
    [
        np.array([0.005, 0.0, 0.0, 0.0, 0.0, 0.0]),
        np.array([0.0, 0.0, 0.01, 0.0, 0.0, 0.0]),
        np.array([0.0, 0.0, 0.0, 2e-3, 0.0, 0.0]),
        np.array([0.0, 0.0, 0.0, 0.0, 0.0, 3e-3]),
    ],
    ids=["shifted", "lowered", "tilted", "turned"],
)
def test_a_bump_is_an_alarm_that_says_by_how_much(change: np.ndarray) -> None:
    rng = np.random.default_rng(2)
    bumped = picture(rng, moved(VIEW, change))
    found = check_bump(bumped, REFERENCE, FLOOR, VIEW)
    assert found.is_moved
    assert "calibrate anew" in found.told
    np.testing.assert_allclose(found.moved, change, atol=3e-3)


def test_a_marker_that_was_kicked_is_no_bump() -> None:
    seen = picture(np.random.default_rng(3))
    seen[2] = replace(seen[2], corners_px=seen[2].corners_px + np.array([15.0, 4.0]))
    found = check_bump(seen, REFERENCE, FLOOR, VIEW)
    assert not found.is_moved
    assert found.moved_markers == (MarkerKey("tag36h11", 102),)
    assert "102 were moved" in found.told


def test_a_small_drift_is_tolerated() -> None:
    warm = [replace(one, corners_px=one.corners_px + 0.15) for one in picture()]
    assert not check_bump(warm, REFERENCE, FLOOR, VIEW).is_moved
    assert check_bump(warm, REFERENCE, FLOOR, VIEW, BumpRules(tolerated_px=0.01)).is_moved


def test_without_floor_markers_nothing_is_known() -> None:
    found = check_bump([], REFERENCE, FLOOR, VIEW)
    assert not found.is_moved
    assert "not known" in found.told


def test_one_floor_marker_is_enough_to_notice() -> None:
    bumped = picture(view=moved(VIEW, np.array([0.02, 0, 0, 0, 0, 0])))[:1]
    assert check_bump(bumped, REFERENCE, FLOOR, VIEW).is_moved


def test_refuses_rules_that_cannot_be() -> None:
    with pytest.raises(InputError, match="false_alarms"):
        BumpRules(false_alarms=0.0)

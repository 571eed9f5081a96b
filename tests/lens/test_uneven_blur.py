"""A blur that is not the same at all corners is a doubt of the turn, hardly of the depth."""

from dataclasses import replace

import numpy as np
import pytest
from lens_example import MARKER, lens

from tagmetry.detect import Detection
from tagmetry.geometry import Array, RigidTransform, pose_difference
from tagmetry.geometry.transforms import Rotation
from tagmetry.lens import LensSetting, Measured, measured
from tagmetry.markers import marker_corners_m

SETTING = LensSetting(100.0, 145.0)  # sharp at exp(-141 / 42.11) = 0.0351 m
SHARP_M = np.exp((4.0 - 145.0) / 42.11)
PINHOLE = replace(lens(), aperture_m=1e-9)


def stood(turn_deg: float, depth_m: float = 0.034) -> RigidTransform:
    facing = Rotation.from_euler("yx", [turn_deg, 180], degrees=True)
    return RigidTransform.from_components([0.0, 0.0, depth_m], facing)


def corners_of(T_camera_marker: RigidTransform) -> Array:
    return lens().camera_at(SETTING).project(T_camera_marker.apply(marker_corners_m(0.01)))


def read(corners_px: Array, *, pinhole: bool = False) -> Measured:
    seen = Detection("tag36h11", 7, corners_px, 1e-6 * np.eye(8), 0, 1.0)
    found = measured(seen, PINHOLE if pinhole else lens(), MARKER, SETTING)
    assert found is not None
    return found


@pytest.mark.parametrize("turn_deg", [20.0, 45.0])
def test_it_is_the_way_that_corners_moved_so_take_the_pose(turn_deg: float) -> None:
    """The discs by the thin lens's formula, the pose by the whole estimate."""
    T_camera_marker = stood(turn_deg)
    depths_m = T_camera_marker.apply(marker_corners_m(0.01))[:, 2]
    focal_px = lens().camera_at(SETTING).focal_px[0]
    discs_px = 0.0016 * focal_px * np.abs(1 / depths_m - 1 / SHARP_M)
    corners_px = corners_of(T_camera_marker)
    inward = corners_px.mean(axis=0) - corners_px
    inward /= np.linalg.norm(inward, axis=1, keepdims=True)
    moved_px = corners_px + 0.13 * (discs_px - discs_px.mean())[:, None] * inward
    way = pose_difference(
        read(moved_px, pinhole=True).T_camera_marker,
        read(corners_px, pinhole=True).T_camera_marker,
    )
    added = read(corners_px).covariance - read(corners_px, pinhole=True).covariance
    ends = np.sqrt(np.diag(np.outer(way, way)).reshape(2, 3).sum(axis=1))
    stated = np.sqrt(np.diag(added).reshape(2, 3).sum(axis=1))
    assert stated[1] == pytest.approx(ends[1], rel=0.15)
    assert np.degrees(stated[1]) > 0.02
    assert np.sqrt(added[2, 2]) / 0.034 < 5e-4


def test_a_facing_marker_has_none() -> None:
    corners_px = corners_of(stood(0.0))
    np.testing.assert_allclose(
        read(corners_px).turn_sd_rad, read(corners_px, pinhole=True).turn_sd_rad, rtol=0.05
    )

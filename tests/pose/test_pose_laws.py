"""What must hold of every pose, whatever the marker, the camera and the view."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from seen_markers import (
    DISTORTED,
    FISHEYE,
    PINHOLE,
    corners_seen,
    correlated_px2,
    detection,
    facing,
    posed,
)

from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.geometry import pose_difference
from tagmetry.geometry.transforms import RigidTransform, Rotation
from tagmetry.markers import marker_corners_m
from tagmetry.pose import estimate_pose, estimate_poses
from tagmetry.pose.ippe import ippe
from tagmetry.pose.refine import refine
from tagmetry.pose.stacks import Poses, Sightings
from tagmetry.pose.whitening import whitening

SIZE_M = 0.1
ALL_14 = (-0.2, 0.1, 0.001, -0.002, 0.01, 0.02, -0.01, 0.005, 1e-3, -5e-4, 8e-4, 3e-4, 0.01, -0.02)
CAMERAS = {
    **{f"brown{n}": BrownLens(ALL_14[:n]) for n in (0, 4, 5, 8, 12, 14)},
    "fisheye": FisheyeLens((0.03, -0.01, 0.002, -4e-4)),
}


def camera(kind: str) -> Camera:
    return Camera(1280, 960, (900.0, 910.0), (630.0, 490.0), CAMERAS[kind])


def noisy_view(seed: int, sd_px: float = 0.3):
    """Return a random view of a marker through the distorted lens: pose and noisy corners."""
    rng = np.random.default_rng(seed)
    rotation = facing(rng.uniform(0, 60), rng.uniform(0, 360), rng.uniform(0, 360))
    T = posed(rotation, *rng.uniform(-0.3, 0.3, 2), rng.uniform(0.8, 3))
    noise = rng.multivariate_normal(np.zeros(8), correlated_px2(sd_px)).reshape(4, 2)
    return T, corners_seen(DISTORTED, T, SIZE_M) + noise


@pytest.mark.parametrize("kind", CAMERAS)
@settings(max_examples=25)
@given(
    tilt_deg=st.floats(5, 70),
    across_deg=st.floats(0, 360),
    roll_deg=st.floats(0, 360),
    aside=st.tuples(st.floats(-0.35, 0.35), st.floats(-0.3, 0.3)),
    z_m=st.floats(0.4, 1.5),
)
def test_exact_corners_give_the_exact_pose(kind, tilt_deg, across_deg, roll_deg, aside, z_m):
    T = posed(facing(tilt_deg, across_deg, roll_deg), aside[0] * z_m, aside[1] * z_m, z_m)
    corners = corners_seen(camera(kind), T, SIZE_M)
    if (T.rotation.as_matrix()[:, 2] @ T.translation) > -0.1 * z_m:
        return  # almost from the side
    pose = estimate_pose(detection(corners, 1e-4), camera(kind), SIZE_M)
    np.testing.assert_allclose(pose_difference(pose.best.T_camera_marker, T), 0, atol=1e-7)
    assert pose.best.reprojection_rms_px < 1e-5


@pytest.mark.parametrize("angle_deg", [61, 75, 89, 100])
@pytest.mark.parametrize("around_deg", [0, 77, 200])
def test_fisheye_sees_markers_far_off_the_axis(angle_deg, around_deg):
    R_camera_ray = Rotation.from_euler("xz", [-angle_deg, around_deg], degrees=True)
    T = RigidTransform.from_rotation(R_camera_ray) * posed(facing(25, 30, 40), 0.02, 0.01, 0.8)
    pose = estimate_pose(detection(corners_seen(FISHEYE, T, SIZE_M), 1e-4), FISHEYE, SIZE_M)
    np.testing.assert_allclose(pose_difference(pose.best.T_camera_marker, T), 0, atol=1e-7)


@pytest.mark.parametrize("scale", [1e-3, 0.5, 40.0])
def test_a_larger_marker_is_farther_by_the_same_factor(scale):
    _, corners = noisy_view(1)
    one = estimate_pose(detection(corners), DISTORTED, SIZE_M)
    other = estimate_pose(detection(corners), DISTORTED, SIZE_M * scale)
    for a, b in zip(one.hypotheses, other.hypotheses, strict=True):
        turn = (a.T_camera_marker.rotation * b.T_camera_marker.rotation.inv()).magnitude()
        assert turn < 1e-7
        t, scaled_t = a.T_camera_marker.translation, b.T_camera_marker.translation
        np.testing.assert_allclose(scaled_t, scale * t, rtol=1e-7)
        units = np.repeat([scale, 1.0], 3)
        expected = units[:, None] * a.covariance * units
        deviations = np.sqrt(np.diag(expected))
        np.testing.assert_allclose(
            b.covariance / deviations / deviations[:, None],
            expected / deviations / deviations[:, None],
            atol=1e-6,
        )


def test_turning_the_camera_turns_the_pose():
    T, _ = noisy_view(2)
    T = posed(T.rotation, 0, 0, 1.0)
    p_camera = T.apply(marker_corners_m(SIZE_M))
    R_other_camera = Rotation.from_rotvec([0.1, -0.2, 0.7])
    poses = [
        estimate_pose(detection(PINHOLE.project(p), 0.01), PINHOLE, SIZE_M).best.T_camera_marker
        for p in (p_camera, R_other_camera.apply(p_camera))
    ]
    turned = RigidTransform.from_rotation(R_other_camera) * poses[0]
    np.testing.assert_allclose(pose_difference(poses[1], turned), 0, atol=1e-8)


def test_starting_with_another_corner_turns_the_marker_about_its_normal():
    _, corners = noisy_view(3)
    quarter = Rotation.from_euler("z", 90, degrees=True)
    one = estimate_pose(detection(corners), DISTORTED, SIZE_M)
    other = estimate_pose(detection(np.roll(corners, -1, axis=0)), DISTORTED, SIZE_M)
    for a, b in zip(one.hypotheses, other.hypotheses, strict=True):
        expected = a.T_camera_marker.rotation * quarter.inv()
        assert (expected * b.T_camera_marker.rotation.inv()).magnitude() < 1e-6


@pytest.mark.parametrize("seed", range(20))
def test_both_hypotheses_are_minima_of_chi2(seed):
    _, corners = noisy_view(seed)
    noise = correlated_px2(0.3)
    pose = estimate_pose(detection(corners, noise), DISTORTED, SIZE_M)
    seen = Sightings(marker_corners_m([SIZE_M]), corners[None], whitening(noise[None]))
    for hypothesis in pose.hypotheses:
        at = Poses.of(RigidTransform.concatenate([hypothesis.T_camera_marker]))
        deviations = np.sqrt(np.diag(hypothesis.covariance))
        chi2 = chi2_near(at, seen, deviations)
        assert chi2(np.zeros(6)) == pytest.approx(hypothesis.chi2, abs=1e-9)
        for axis in np.eye(6):
            ahead, back = chi2(1e-3 * axis), chi2(-1e-3 * axis)
            assert abs(ahead - back) / 2e-3 < 2e-3, "gradient per deviation"
            assert ahead + back - 2 * chi2(np.zeros(6)) > -1e-12


def chi2_near(at: Poses, seen: Sightings, deviations):
    def chi2(change):
        moved = at.moved((deviations * change)[None])
        error = DISTORTED.project(moved.points(seen.p_body)) - seen.pixels
        return float(((seen.whitening @ error.reshape(1, 8, 1)) ** 2).sum())

    return chi2


def test_polish_never_raises_chi2_and_improves_on_ippe():
    views = [noisy_view(seed) for seed in range(200)]
    corners = np.stack([c for _, c in views])
    p_marker = marker_corners_m(np.full(len(views), SIZE_M))
    noise = whitening(np.tile(correlated_px2(0.3), (len(views), 1, 1)))
    seen = Sightings(p_marker, corners, noise)
    R, t = ippe(DISTORTED.unproject(corners), p_marker)
    for branch in (0, 1):
        poses = Poses(R[:, branch], t[:, branch])
        before = refine(poses, seen, DISTORTED, max_iterations=0).chi2
        for count in (1, 2, 5, 50):
            after = refine(poses, seen, DISTORTED, max_iterations=count).chi2
            assert (after <= before).all()
            before = after
        assert np.median(refine(poses, seen, DISTORTED, 0).chi2 - before) > 0.1


def opencv_points():
    """Return OpenCV's order for a square: the same corners, x right, y up, z out of the face."""
    return marker_corners_m(SIZE_M)


def opencv_poses(corners, flag):
    K = PINHOLE.matrix
    normalised = (corners - K[:2, 2]) / [K[0, 0], K[1, 1]]
    _, turns, shifts, _ = cv2.solvePnPGeneric(
        opencv_points(), normalised.reshape(-1, 1, 2), np.eye(3), np.zeros(4), flags=flag
    )
    return [
        posed(Rotation.from_rotvec(r.ravel()), *t.ravel())
        for r, t in zip(turns, shifts, strict=True)
    ]


@pytest.mark.parametrize("seed", range(30))
def test_ippe_gives_opencvs_two_poses(seed):
    T, _ = noisy_view(seed)
    noise = np.random.default_rng(seed).normal(size=(4, 2)) * 0.02
    corners = corners_seen(PINHOLE, T, SIZE_M) + noise
    p_marker = marker_corners_m([SIZE_M])
    R, t = ippe(PINHOLE.unproject(corners)[None], p_marker)
    expected = opencv_poses(corners, cv2.SOLVEPNP_IPPE)
    found = [posed(Rotation.from_matrix(R[0, n]), *t[0, n]) for n in (0, 1)]
    for pose in found:
        nearest = min(np.abs(pose_difference(pose, e)).max() for e in expected)
        # OpenCV builds the homography of more than four points' algebra: equal up to the noise
        assert nearest < 2e-3


@pytest.mark.parametrize("seed", range(30))
def test_the_best_pose_is_opencvs_iterative_one(seed):
    T, _ = noisy_view(seed)
    noise = np.random.default_rng(seed).normal(size=(4, 2)) * 0.1
    corners = corners_seen(DISTORTED, T, SIZE_M) + noise
    pose = estimate_pose(detection(corners), DISTORTED, SIZE_M)
    best = pose.best.T_camera_marker
    _, turn, shift = cv2.solvePnP(
        opencv_points(),
        corners.reshape(-1, 1, 2),
        DISTORTED.matrix,
        np.array(DISTORTED.lens.coefficients),
        best.rotation.as_rotvec().reshape(3, 1).copy(),
        np.asarray(best.translation).reshape(3, 1).copy(),
        useExtrinsicGuess=True,
        flags=cv2.SOLVEPNP_ITERATIVE,
    )
    difference = pose_difference(posed(Rotation.from_rotvec(turn.ravel()), *shift.ravel()), best)
    assert difference @ np.linalg.solve(pose.covariance, difference) < 1e-4


def test_several_markers_are_solved_as_each_alone():
    corners = [noisy_view(seed)[1] for seed in range(12)]
    detections = [detection(c, correlated_px2(0.2), marker_id=n) for n, c in enumerate(corners)]
    sizes_m = np.linspace(0.02, 0.2, 12)
    together = estimate_poses(detections, DISTORTED, sizes_m)
    for one, size_m, pose in zip(detections, sizes_m, together, strict=True):
        alone = estimate_pose(one, DISTORTED, size_m)
        assert (pose.id, pose.size_m) == (one.id, size_m)
        for a, b in zip(pose.hypotheses, alone.hypotheses, strict=True):
            difference = pose_difference(a.T_camera_marker, b.T_camera_marker)
            assert np.abs(difference).max() < 1e-7
            assert a.probability == pytest.approx(b.probability, abs=1e-9)

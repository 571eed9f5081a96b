"""The joint solution: right covariance, deaf to wrong markers, heedful of what is known."""

from dataclasses import replace

import numpy as np
import pytest
from marked_world import (
    DISTORTED,
    FISHEYE,
    VGA,
    camera_at,
    room,
    seen_by,
    surveyed,
    wall,
    wall_marker,
)
from scipy.stats import chi2

from tagmetry.geometry import RigidTransform, UncertainTransform, pose_difference
from tagmetry.geometry import mahalanobis_squared as distance2
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import Height, Knowledge, Localizer, MarkerMap
from tagmetry.localize.joint.proposals import proposals
from tagmetry.localize.joint.scene import scene_of
from tagmetry.localize.seen import known_markers
from tagmetry.markers import MarkerBody, MountedMarker
from tagmetry.pose import estimate_body_pose
from tagmetry.pose.ippe import ippe

HERE = camera_at(-2.2, 0.2, 1.1, (5, 3, 4))

SURVEY = np.diag([2e-3, 2e-3, 2e-3, 4e-3, 4e-3, 4e-3]) ** 2


def trials(T, marker_map, count, *, camera=VGA, noise_px=0.3, survey=None, seed=0, spoil=list):
    """Return the poses of many noisy images and their errors, shape (n, 6)."""
    rng = np.random.default_rng(seed)
    poses = []
    for _ in range(count):
        known = marker_map if survey is None else surveyed(marker_map, survey, rng)
        detections = spoil(seen_by(camera, T, marker_map, noise_px, rng))
        poses.append(Localizer(known, camera).locate(detections))
    return poses, np.stack([pose_difference(one.T_world_camera, T) for one in poses])


def coverage(poses, errors):
    """Return the share of errors within the 95 % ellipsoid."""
    d2 = distance2(errors, np.stack([one.covariance for one in poses]))
    return float((d2 < chi2.ppf(0.95, 6)).mean())


def rms_m(errors):
    return float(np.sqrt((errors[:, :3] ** 2).sum(axis=1).mean()))


def moved(marker_map, keys, shift_m=(0.0, 0.12, 0.05)):
    """Return the map with some markers where they are not."""
    shift = RigidTransform.from_translation(shift_m)
    return MarkerMap(
        tuple(
            replace(one, T_world_marker=shift * one.T_world_marker) if one.id in keys else one
            for one in marker_map.markers
        )
    )


@pytest.mark.parametrize("camera", [VGA, DISTORTED, FISHEYE])
def test_proposals_are_those_of_the_readable_version(camera):
    seen = known_markers(seen_by(camera, HERE, room(), 0.3), room()).seen
    scene, placed, _ = scene_of(seen, camera, Knowledge())
    Rs, ts = proposals(placed)
    p_marker = np.stack([one.marker.T_world_marker.inv().apply(one.marker.p_world) for one in seen])
    expected_R, expected_t = ippe(placed.rays, p_marker)
    for n, (R, t) in enumerate(
        zip(np.concatenate(expected_R), np.concatenate(expected_t), strict=True)
    ):
        T = RigidTransform.from_components(t, Rotation.from_matrix(R))
        T_world_camera = seen[n // 2].marker.T_world_marker * T.inv()
        np.testing.assert_allclose(Rs[n], T_world_camera.rotation.as_matrix(), atol=1e-9)
        np.testing.assert_allclose(ts[n], T_world_camera.translation, atol=1e-9)
    assert scene.roots.shape == (len(seen), 6, 0)


@pytest.mark.parametrize("camera", [VGA, DISTORTED])
def test_it_is_the_body_s_pose_seen_from_the_other_side(camera):
    body = MarkerBody(
        "room",
        tuple(MountedMarker(m.family, m.id, m.size_m, m.T_world_marker) for m in room().markers),
    )
    detections = seen_by(camera, HERE, room(), 0.05, np.random.default_rng(5))
    pose = Localizer(room(), camera).locate(detections)
    other = estimate_body_pose(detections, body, camera).best.uncertain.inverse()
    deviations = np.sqrt(np.diag(other.covariance))
    apart = pose_difference(pose.T_world_camera, other.T_a_b)
    assert (np.abs(apart) < 0.02 * deviations).all()
    np.testing.assert_allclose(np.sqrt(np.diag(pose.covariance)), deviations, rtol=0.02)


@pytest.mark.parametrize(
    ("survey", "camera"), [(None, VGA), (SURVEY, VGA), (None, DISTORTED), (SURVEY, FISHEYE)]
)
def test_its_ellipsoid_covers_what_it_says(survey, camera):
    count = 200
    poses, errors = trials(HERE, room(), count, survey=survey, camera=camera, noise_px=0.2)
    assert abs(coverage(poses, errors) - 0.95) < 4 * np.sqrt(0.95 * 0.05 / count)


@pytest.mark.slow
@pytest.mark.parametrize("survey", [None, SURVEY])
@pytest.mark.parametrize("marker_map", [room(), wall()])
def test_its_ellipsoid_covers_95_percent_of_many(survey, marker_map):
    assert 0.93 < coverage(*trials(HERE, marker_map, 4000, survey=survey)) < 0.97


def test_markers_of_one_body_share_their_error():
    body = MarkerBody(
        "board",
        tuple(MountedMarker(m.family, m.id, m.size_m, m.T_world_marker) for m in wall().markers),
    )
    rng = np.random.default_rng(3)
    exact = MarkerMap.of_body(body, UncertainTransform.exact(RigidTransform.identity()))
    assert all(one.is_exact for one in exact.markers)
    poses, errors = [], []
    for _ in range(120):
        error = rng.multivariate_normal(np.zeros(6), SURVEY)
        shift = RigidTransform.from_components(error[:3], Rotation.from_rotvec(error[3:]))
        known = MarkerMap.of_body(body, UncertainTransform(shift, SURVEY))
        poses.append(Localizer(known, VGA).locate(seen_by(VGA, HERE, wall(), 0.1, rng)))
        errors.append(pose_difference(poses[-1].T_world_camera, HERE))
    assert abs(coverage(poses, np.stack(errors)) - 0.95) < 0.08
    alone = MarkerMap(tuple(replace(one, body=None) for one in known.markers))
    one = Localizer(alone, VGA).locate(seen_by(VGA, HERE, wall(), 0.1, rng))
    assert np.trace(one.covariance) < 0.8 * np.trace(poses[-1].covariance)  # falsely sure


def test_a_worse_map_makes_a_less_certain_pose_and_an_exact_one_the_same():
    detections = seen_by(VGA, HERE, room(), 0.2, np.random.default_rng(1))
    with_errors = [surveyed(room(), f * SURVEY + 1e-18 * np.eye(6), ZERO) for f in (0, 1, 4)]
    sizes = [np.trace(Localizer(m, VGA).locate(detections).covariance) for m in with_errors]
    assert sizes[0] < sizes[1] < sizes[2]
    exact = Localizer(room(), VGA).locate(detections).covariance
    assert np.trace(exact) == pytest.approx(sizes[0], rel=1e-6)


class _NoError:
    def multivariate_normal(self, *_):
        return np.zeros(6)


ZERO = _NoError()


def test_its_error_is_less_than_half_of_the_weighted_average_s():
    rng = np.random.default_rng(0)
    apart = {"joint": [], "weighted": []}
    for x_m in (-1.5, -3.0, -5.0):
        for _ in range(6):
            T = camera_at(x_m, 0.1, 1.2, rng.uniform(-8, 8, 3))
            detections = seen_by(VGA, T, wall(2, 2), 0.3, rng)
            for name, errors in apart.items():
                pose = Localizer(wall(2, 2), VGA, name).locate(detections)
                errors.append(pose_difference(pose.T_world_camera, T))
    assert rms_m(np.stack(apart["joint"])) < 0.5 * rms_m(np.stack(apart["weighted"]))


def test_one_marker_of_five_that_was_moved_is_named_and_does_no_harm():
    five = MarkerMap(room().markers[3:8])
    clean, errors = trials(HERE, five, 60)
    assert all(len(one.used) == 5 for one in clean)
    rng = np.random.default_rng(0)
    spoiled = []
    for _ in range(60):
        pose = Localizer(moved(five, {5}), VGA).locate(seen_by(VGA, HERE, five, 0.3, rng))
        assert [one.key.id for one in pose.rejected] == [5]
        assert pose.rejected[0].why.startswith("it disagrees with the other markers by ")
        spoiled.append(pose_difference(pose.T_world_camera, HERE))
    assert rms_m(np.stack(spoiled)) < 1.5 * rms_m(errors)


def test_two_markers_of_ten_under_each_other_s_id_do_no_harm():
    def spoil(detections):
        first, second, *rest = detections
        return [replace(first, id=second.id), replace(second, id=first.id), *rest]

    _, errors = trials(HERE, room(), 60)
    poses, spoiled = trials(HERE, room(), 60, spoil=spoil)
    assert all(len(one.rejected) == 2 for one in poses)
    assert rms_m(spoiled) < 1.5 * rms_m(errors)


def test_a_covered_corner_costs_that_corner_alone():
    def spoil(detections):
        corners = detections[1].corners_px.copy()
        corners[2] += (6.0, -5.0)
        return [detections[0], replace(detections[1], corners_px=corners), *detections[2:]]

    _, errors = trials(HERE, room(), 40)
    poses, spoiled = trials(HERE, room(), 40, spoil=spoil)
    assert all(not one.rejected for one in poses)
    assert rms_m(spoiled) < 1.2 * rms_m(errors)


def test_two_that_disagree_leave_two_hypotheses():
    pair = MarkerMap(tuple(wall_marker(n, 0.4 * n, 1.2, lean=(30, 20, 0)) for n in range(2)))
    T = camera_at(-1.2, 0.2, 1.2)
    pose = Localizer(moved(pair, {1}), VGA).locate(seen_by(VGA, T, pair, 0.2))
    assert len(pose.hypotheses) >= 2
    assert {one.used for one in pose.hypotheses[:2]} == {(k,) for k in pair.by_key}
    assert 0.2 < pose.ambiguity < 0.8


def test_noise_beyond_what_is_stated_widens_the_covariance():
    rng = np.random.default_rng(2)
    detections = [
        replace(one, corners_cov_px2=one.corners_cov_px2 / 9)
        for one in seen_by(VGA, HERE, room(), 0.3, rng)
    ]
    pose = Localizer(room(), VGA).locate(detections)
    honest = Localizer(room(), VGA).locate(
        [replace(one, corners_cov_px2=9 * one.corners_cov_px2) for one in detections]
    )
    assert len(pose.used) == len(honest.used)
    ratio = np.sqrt(np.diag(pose.covariance) / np.diag(honest.covariance))
    np.testing.assert_allclose(ratio, 1, rtol=0.3)


def test_a_known_height_is_heeded_as_its_deviation_says():
    detections = seen_by(VGA, HERE, room(), 0.3, np.random.default_rng(3))
    localizer = Localizer(room(), VGA)
    for deviation_m in (1e-4, 0.0):
        known = Knowledge(heights=(Height(np.zeros(3), 1.1, deviation_m),))
        pose = localizer.locate(detections, known)
        assert abs(pose.T_world_camera.translation[2] - 1.1) < 4e-4
        assert np.sqrt(pose.covariance[2, 2]) <= max(deviation_m, 2e-6)
    vague = localizer.locate(detections, Knowledge(heights=(Height(np.zeros(3), 7.0, 1e3),)))
    free = localizer.locate(detections)
    np.testing.assert_allclose(
        vague.T_world_camera.translation, free.T_world_camera.translation, atol=1e-5
    )

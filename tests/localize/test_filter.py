"""The filter: calibrated, deaf to wild images, true to both poses of a marker, and late ones."""

from dataclasses import replace

import numpy as np
import pytest
from marked_world import VGA, camera_at, seen_by, wall_marker

from tagmetry.errors import InputError
from tagmetry.geometry import mahalanobis_squared, perturb_pose, pose_difference
from tagmetry.localize import CameraHypothesis, CameraPose, Localizer, MarkerMap
from tagmetry.localize.filter import Motion, PoseFilter, Speeds
from tagmetry.localize.filter.branch import Branch

NOISE = np.diag([0.01, 0.01, 0.01, 0.005, 0.005, 0.005]) ** 2
MOTION = Motion(0.8, 0.6)


def measured(T, covariance=NOISE, probability=1.0):
    return CameraPose("joint", (CameraHypothesis(T, covariance, probability, ()),))


def two_sided(T, mirrored, probability=0.5):
    """Return an image that cannot tell two poses apart."""
    both = [(T, 1 - probability), (mirrored, probability)]
    ranked = sorted(both, key=lambda one: -one[1])
    return CameraPose("joint", tuple(CameraHypothesis(T, NOISE, p, ()) for T, p in ranked))


def wandering(steps, step_s, rng):
    """Give times, poses, velocities and angular velocities of a camera by the model itself."""
    T, v, w = camera_at(0, 0, 1), np.zeros(3), np.zeros(3)
    for n in range(steps):
        yield n * step_s, T, v, w
        fine = 10
        for _ in range(fine):
            h = step_s / fine
            T = perturb_pose(T, h * np.concatenate([v, w]))
            v = v + MOTION.acceleration_m_s2 * np.sqrt(h) * rng.normal(size=3)
            w = w + MOTION.turning_rad_s2 * np.sqrt(h) * rng.normal(size=3)


def noisy(T, rng):
    return perturb_pose(T, rng.multivariate_normal(np.zeros(6), NOISE))


def test_its_surprise_and_its_error_are_what_it_says():
    rng = np.random.default_rng(0)
    filter_, surprises, errors2 = PoseFilter(MOTION), [], []
    for time_s, T, _, _ in wandering(200, 0.05, rng):
        pose = filter_.take(time_s, measured(noisy(T, rng)))
        if time_s > 1:
            surprises.append(pose.surprise2)
            apart = pose_difference(pose.T_world_camera, T)
            errors2.append(mahalanobis_squared(apart, pose.covariance))
    band = 4 * np.sqrt(12 / len(surprises))
    assert abs(np.mean(surprises) - 6) < band
    assert abs(np.mean(errors2) - 6) < 2 * band  # errors of neighbouring images go together


def test_it_knows_better_than_single_images():
    rng = np.random.default_rng(1)
    filter_, filtered, single = PoseFilter(MOTION), [], []
    for time_s, T, _, _ in wandering(120, 0.02, rng):
        one = noisy(T, rng)
        pose = filter_.take(time_s, measured(one))
        single.append(pose_difference(one, T)[:3])
        filtered.append(pose_difference(pose.T_world_camera, T)[:3])
    assert np.std(filtered[50:]) < 0.8 * np.std(single[50:])


def test_two_seconds_without_markers_are_recovered_in_one_image():
    rng = np.random.default_rng(2)
    filter_, before = PoseFilter(MOTION), None
    for time_s, T, _, _ in wandering(120, 0.05, rng):
        if not 2.0 < time_s < 4.0:
            pose = filter_.take(time_s, measured(noisy(T, rng)))
            if before is not None and before > 1.9:
                assert pose.age_s == 0
                apart = pose_difference(pose.T_world_camera, T)
                assert mahalanobis_squared(apart, NOISE) < 25
            before = 0.0
        else:
            pose = filter_.take(time_s, CameraPose("joint", (), why="no marker"))
            before = pose.age_s
            assert pose.age_s == pytest.approx(time_s - 2.0)
            apart = pose_difference(pose.T_world_camera, T)
            assert mahalanobis_squared(apart, pose.covariance) < 35


def test_one_wild_image_is_left_out_and_two_begin_anew():
    filter_ = PoseFilter(MOTION)
    here, there = camera_at(0, 0, 1), camera_at(3, 1, 1)
    for n in range(30):
        filter_.take(0.05 * n, measured(here))
    once = filter_.take(1.5, measured(there))
    assert np.linalg.norm(once.T_world_camera.translation - here.translation) < 0.05
    assert once.age_s == pytest.approx(0.05)
    assert np.isnan(once.surprise2)
    again = filter_.take(1.55, measured(there))
    np.testing.assert_allclose(again.T_world_camera.translation, there.translation, atol=1e-6)


def test_both_poses_live_on_until_one_wins():
    filter_ = PoseFilter(MOTION)
    right, mirrored = camera_at(0, 0, 1), camera_at(0.4, 0.3, 1, (20, 0, 0))
    for n in range(3):
        pose = filter_.take(0.05 * n, two_sided(right, mirrored, 0.6))
    assert 0.6 < pose.probability < 0.9
    np.testing.assert_allclose(pose.T_world_camera.translation, mirrored.translation, atol=0.01)
    won = filter_.take(0.15, measured(right))
    assert won.probability > 0.999
    np.testing.assert_allclose(won.T_world_camera.translation, right.translation, atol=0.01)


def test_odometry_tells_two_poses_apart_in_two_images():
    """The mirrored camera would have moved the other way."""
    step_s, speed = 0.2, np.array([0.0, 0.0, 0.5])  # forward
    first, second = camera_at(0, 0, 1), camera_at(0.1, 0, 1)
    wrong = [camera_at(0.4, 0.4, 1, (40, 0, 0)), camera_at(0.5, 0.4, 1, (40, 0, 0))]
    told, untold = PoseFilter(Motion(0.1, 0.3)), PoseFilter(Motion(0.1, 0.3))
    for filter_ in (told, untold):
        filter_.take(0.0, two_sided(first, wrong[0], 0.6))
    told.take(0.0, Speeds(speed))
    found = [one.take(step_s, two_sided(second, wrong[1], 0.6)) for one in (told, untold)]
    assert np.linalg.norm(found[0].T_world_camera.translation - second.translation) < 0.02
    assert found[0].probability > 0.9
    assert found[1].probability < 0.8


def test_a_gyroscope_steadies_the_turn():
    rng = np.random.default_rng(5)
    errors = {True: [], False: []}
    for with_gyro, found in errors.items():
        rng = np.random.default_rng(5)
        filter_ = PoseFilter(MOTION)
        for time_s, T, _, w in wandering(110, 0.05, rng):
            if with_gyro:
                rate = T.rotation.inv().apply(w)
                filter_.take(time_s, Speeds(rate_rad_s=rate, rate_deviation_rad_s=0.002))
            pose = filter_.take(time_s, measured(noisy(T, rng)))
            found.append(pose_difference(pose.T_world_camera, T)[3:])
    assert np.std(errors[True][40:]) < 0.8 * np.std(errors[False][40:])


def test_a_late_image_counts_as_if_it_had_come_in_time():
    rng = np.random.default_rng(3)
    images = [(t, measured(noisy(T, rng))) for t, T, _, _ in wandering(30, 0.05, rng)]
    in_time, late = PoseFilter(MOTION), PoseFilter(MOTION)
    for time_s, image in images:
        expected = in_time.take(time_s, image)
    for time_s, image in [*images[:20], *images[21:], images[20]]:
        found = late.take(time_s, image)
    apart = pose_difference(found.T_world_camera, expected.T_world_camera)
    np.testing.assert_allclose(apart, 0, atol=1e-12)
    np.testing.assert_allclose(found.covariance, expected.covariance, rtol=1e-9)


def test_time_that_runs_backwards_is_one_clear_line():
    filter_ = PoseFilter()
    for n in range(10):
        filter_.take(float(n), measured(camera_at(0, 0, 1)))
    with pytest.raises(InputError, match=r"time runs backwards: 3 s comes after 9 s"):
        filter_.take(3.0, measured(camera_at(0, 0, 1)))
    with pytest.raises(InputError, match="expected a finite time, got nan"):
        filter_.take(np.nan, measured(camera_at(0, 0, 1)))
    with pytest.raises(InputError, match="expected a time from 9 s on"):
        filter_.at(4.0)


def test_before_any_pose_there_is_none():
    filter_ = PoseFilter()
    assert filter_.at(0.0) is None
    assert filter_.take(0.0, CameraPose("joint", (), why="nothing")) is None
    assert filter_.take(0.1, Speeds(np.zeros(3))) is None
    assert filter_.take(0.2, measured(camera_at(0, 0, 1))) is not None


def test_a_camera_that_drives_past_ambiguous_markers():
    """Two images tell what one cannot: the flip's branch does not go on as cameras do."""
    rng = np.random.default_rng(7)
    alone = MarkerMap((wall_marker(0, 0.0, 1.2),))
    localizer, wrong, wrong_alone = Localizer(alone, VGA), 0, 0
    filter_ = PoseFilter(Motion(0.3, 0.3))
    for n in range(80):
        y_m = -0.8 + 0.02 * n
        T = camera_at(-2.5, y_m, 1.2, (np.rad2deg(np.arctan2(-y_m, 2.5)), 0, 0))
        seen = localizer.locate(seen_by(VGA, T, alone, 0.3, rng))
        pose = filter_.take(n / 15, seen)
        if n > 10:
            wrong += np.linalg.norm(pose.T_world_camera.translation - T.translation) > 0.35
            wrong_alone += np.linalg.norm(seen.T_world_camera.translation - T.translation) > 0.35
    assert wrong_alone >= 5
    assert wrong < 0.3 * wrong_alone


@pytest.mark.parametrize(
    ("make", "why"),
    [
        (lambda: Motion(0.0), "acceleration_m_s2 must be positive and finite"),
        (lambda: Motion(1.0, np.inf), "turning_rad_s2 must be positive and finite"),
        (lambda: Speeds(np.zeros(2)), "speed_m_s must be three finite numbers"),
        (lambda: Speeds(rate_rad_s=np.full(3, np.nan)), "rate_rad_s must be three finite numbers"),
        (lambda: Speeds(speed_deviation_m_s=0.0), "speed_deviation_m_s must be positive"),
    ],
)
def test_refuses_what_is_no_motion(make, why):
    with pytest.raises(InputError, match=why):
        make()


def test_a_known_way_and_a_measured_speed_tell_the_heading():
    """A camera that drives along x as it sees itself drive ahead looks along x."""
    truth = camera_at(0, 0, 1)
    off = perturb_pose(truth, np.array([0, 0, 0, 0, 0, 0.05]))
    covariance = np.diag([1e-4] * 3 + [1e-8, 1e-8, 0.1**2])
    branch = Branch.at_rest(off, covariance, 1.0)
    known = branch.covariance.copy()
    known[6:9, 6:9] = 1e-8 * np.eye(3)
    branch = replace(branch, speed_m_s=np.array([1.0, 0, 0]), covariance=known)
    found = Speeds(np.array([0, 0, 1.0]), 0.001).corrected(branch)
    turned = pose_difference(found.T_world_camera, truth)[3:]
    np.testing.assert_allclose(turned, 0, atol=2e-3)
    assert np.sqrt(found.covariance[5, 5]) < 0.002

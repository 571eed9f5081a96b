"""Trajectories against each other: laws, a case by hand, and what is refused."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize.trajectory import Spread, Trajectory, alignment, compare, matched

RNG = np.random.default_rng(0)
TIMES_S = np.arange(40) * 0.1
ELSEWHERE = RigidTransform.from_components([3.0, -2.0, 0.7], Rotation.from_rotvec([0.4, -1.9, 0.8]))


def winding(times_s=TIMES_S):
    """Return a way that winds through space and turns as it goes."""
    places = np.stack([np.sin(times_s), 0.4 * times_s, np.cos(2 * times_s)], axis=1)
    turns = np.stack([0.3 * times_s, 0.4 * np.sin(2 * times_s), -0.5 * times_s], axis=1)
    return Trajectory(times_s, RigidTransform.from_components(places, Rotation.from_rotvec(turns)))


def errors_of(found):
    return [found.absolute_m, found.absolute_rad, found.relative_m, found.relative_rad]


def test_a_trajectory_is_not_apart_from_itself():
    for errors in errors_of(compare(winding(), winding())):
        np.testing.assert_allclose(errors, 0, atol=1e-7)


def test_another_world_is_aligned_away_and_found():
    found = compare(winding().moved(ELSEWHERE), winding(), align="path")
    for errors in errors_of(found):
        np.testing.assert_allclose(errors, 0, atol=1e-7)
    np.testing.assert_allclose(
        found.by.T_true_estimated.as_matrix(), ELSEWHERE.inv().as_matrix(), atol=1e-9
    )


def test_the_alignment_is_the_best_there_is():
    noisy = winding().moved(ELSEWHERE)
    shaken = noisy.poses.translation + RNG.normal(0, 0.05, (len(TIMES_S), 3))
    noisy = Trajectory(TIMES_S, RigidTransform.from_components(shaken, noisy.poses.rotation))
    best = alignment(matched(noisy, winding()), "path").T_true_estimated
    cost = np.sum((best.apply(shaken) - winding().positions_m) ** 2)
    for change in RNG.normal(0, 1e-3, (30, 6)):
        nudge = RigidTransform.from_components(change[:3], Rotation.from_rotvec(change[3:]))
        other = np.sum(((nudge * best).apply(shaken) - winding().positions_m) ** 2)
        assert other > cost


def test_scipy_turns_the_worlds_alike():
    noisy = winding().moved(ELSEWHERE).positions_m + RNG.normal(0, 0.05, (len(TIMES_S), 3))
    true = winding().positions_m
    expected, _ = Rotation.align_vectors(true - true.mean(axis=0), noisy - noisy.mean(axis=0))
    poses = RigidTransform.from_components(noisy, winding().poses.rotation)
    found = alignment(matched(Trajectory(TIMES_S, poses), winding()), "path").T_true_estimated
    assert (found.rotation * expected.inv()).magnitude() < 1e-7


def test_a_flat_way_is_aligned_without_a_mirror_image():
    flat = winding().positions_m * [1.0, 1.0, 0.0]
    way = Trajectory(TIMES_S, RigidTransform.from_components(flat, winding().poses.rotation))
    found = compare(way.moved(ELSEWHERE), way, align="path")
    assert np.linalg.det(found.by.T_true_estimated.rotation.as_matrix()) == pytest.approx(1)
    np.testing.assert_allclose(found.absolute_m, 0, atol=1e-7)


def test_by_hand():
    """Four poses a metre apart; the third is 0.3 m aside and turned by 10 degrees."""
    times_s = np.arange(4.0)
    places = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]])
    level = Rotation.from_rotvec(np.zeros((4, 3)))
    true = Trajectory(times_s, RigidTransform.from_components(places, level))
    off = np.add(places, [[0, 0, 0], [0, 0, 0], [0, 0.3, 0], [0, 0, 0]])
    turned = Rotation.from_rotvec([[0, 0, 0], [0, 0, 0], [0, 0, 10], [0, 0, 0]], degrees=True)
    found = compare(Trajectory(times_s, RigidTransform.from_components(off, turned)), true)
    np.testing.assert_allclose(found.absolute_m, [0, 0, 0.3, 0], atol=1e-9)
    np.testing.assert_allclose(np.degrees(found.absolute_rad), [0, 0, 10, 0], atol=1e-9)
    angle = np.radians(10)  # the last step, (1, -0.3), as one who is turned sees it
    seen = [np.cos(angle) - 0.3 * np.sin(angle), -np.sin(angle) - 0.3 * np.cos(angle)]
    last = np.hypot(seen[0] - 1, seen[1])
    np.testing.assert_allclose(found.relative_m, [0, 0.3, last], atol=1e-9)
    np.testing.assert_allclose(np.degrees(found.relative_rad), [0, 10, 10], atol=1e-9)
    over_two = compare(found.both.estimated, true, step_s=2.0)
    np.testing.assert_allclose(over_two.relative_m, [0.3, 0.0], atol=1e-9)
    spread = Spread.of(found.absolute_m)
    assert (spread.rms, spread.mean) == (pytest.approx(0.15), pytest.approx(0.075))
    assert (spread.median, spread.largest) == (pytest.approx(0), pytest.approx(0.3))


def test_an_even_drift_shows_in_the_relative_error_alike_at_every_step():
    drift = winding().positions_m + 0.02 * TIMES_S[:, None] * [1.0, 0, 0]
    poses = RigidTransform.from_components(drift, winding().poses.rotation)
    found = compare(Trajectory(TIMES_S, poses), winding(), step_s=1.0)
    np.testing.assert_allclose(found.relative_m, 0.02, atol=1e-9)
    assert len(found.relative_m) == 30


def test_the_true_one_is_interpolated_where_its_gaps_are_narrow():
    straight = Trajectory(
        np.array([0.0, 1.0, 5.0]),
        RigidTransform.from_components(
            [[0, 0, 0], [2, 0, 0], [3, 0, 0]],
            Rotation.from_rotvec([[0, 0, 0], [0, 0, 40], [0, 0, 0]], degrees=True),
        ),
    )
    asked = Trajectory(np.array([-0.5, 0.25, 1.0, 3.0, 5.0]), RigidTransform.identity(5))
    both = matched(asked, straight, gap_s=1.0)
    assert both.unmatched == 2
    np.testing.assert_allclose(both.true.times_s, [0.25, 1.0, 5.0])
    np.testing.assert_allclose(both.true.positions_m[:, 0], [0.5, 2, 3])
    assert both.true.poses.rotation.as_rotvec(degrees=True)[0, 2] == pytest.approx(10)


def test_single_poses_at_one_time_can_be_compared():
    one = Trajectory(np.array([7.0]), RigidTransform.identity(1))
    found = compare(one.of_part(RigidTransform.from_translation([0, 0, 0.2])), one)
    np.testing.assert_allclose(found.absolute_m, [0.2])
    assert len(found.relative_m) == 0
    assert np.isnan(Spread.of(found.relative_m).rms)


OFFSET = RigidTransform.from_components([0.1, 0.04, -0.2], Rotation.from_rotvec([1.1, 0.2, -0.7]))


def test_what_sits_on_a_rig_is_compared_with_the_rig():
    found = compare(winding().moved(ELSEWHERE).of_part(OFFSET), winding(), align="rig")
    for errors in errors_of(found):
        np.testing.assert_allclose(errors, 0, atol=1e-6)
    np.testing.assert_allclose(
        found.by.T_thing_part.as_matrix(), OFFSET.inv().as_matrix(), atol=1e-9
    )
    path = compare(winding().moved(ELSEWHERE).of_part(OFFSET), winding(), align="path")
    assert path.absolute_m.max() > 0.01  # the lever of the offset
    assert np.median(path.absolute_rad) > 0.5


def test_a_rig_s_alignment_stands_noise():
    noise = RNG.normal(0, [0.002] * 3 + [0.003] * 3, (len(TIMES_S), 6))
    shaken = RigidTransform.from_components(noise[:, :3], Rotation.from_rotvec(noise[:, 3:]))
    poses = winding().moved(ELSEWHERE).of_part(OFFSET).poses * shaken
    found = compare(Trajectory(TIMES_S, poses), winding(), align="rig")
    assert Spread.of(found.absolute_rad).rms == pytest.approx(0.003 * np.sqrt(3), rel=0.15)
    assert Spread.of(found.absolute_m).rms < 0.006


def level_way():
    """Return a way that turns about one axis only."""
    turns = Rotation.from_rotvec(np.outer(TIMES_S, [0, 0, 0.4]))
    return Trajectory(TIMES_S, RigidTransform.from_components(winding().positions_m, turns))


def straight_way():
    places = np.outer(TIMES_S, [1.0, 2.0, 3.0])
    return Trajectory(TIMES_S, RigidTransform.from_components(places, winding().poses.rotation))


@pytest.mark.parametrize(
    ("make", "why"),
    [
        (lambda: Trajectory(TIMES_S, RigidTransform.identity(3)), "3 for 40 times"),
        (lambda: Trajectory(np.zeros(1), RigidTransform.identity()), "as many poses as times"),
        (lambda: Trajectory(np.zeros(2), RigidTransform.identity(2)), "rise from pose to pose"),
        (lambda: Trajectory(np.array([0, np.nan]), RigidTransform.identity(2)), "finite"),
        (lambda: compare(winding(), winding(TIMES_S + 99)), "the second from 99.000 to 102.900 s"),
        (lambda: compare(straight_way(), straight_way(), align="path"), "too straight"),
        (lambda: compare(level_way(), level_way(), align="rig"), "about one axis only"),
        (lambda: compare(winding(), winding(), align="scale"), "align must be none, path or rig"),
        (lambda: compare(winding(), winding(), step_s=-1), "step_s must be finite"),
        (lambda: compare(winding(), winding(), gap_s=np.nan), "gap_s must be finite"),
    ],
)
def test_refuses(make, why):
    with pytest.raises(InputError, match=why):
        make()

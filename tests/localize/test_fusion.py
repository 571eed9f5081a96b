"""The compiled fusion against the plain sum that it stands for."""

import numpy as np
import pytest
from marked_world import VGA, camera_at, room, seen_by

from tagmetry.geometry import perturb_pose, pose_difference
from tagmetry.geometry.transforms import RigidTransform, Rotation
from tagmetry.localize import Localizer
from tagmetry.localize.joint.fusion import Opinions, agreement
from tagmetry.localize.joint.small import rotation_vector
from tagmetry.localize.result import excess


@pytest.mark.parametrize("angle_deg", [0.0, 1e-9, 1e-3, 60.0, 119.0, 121.0, 179.9])
def test_rotation_vectors_are_scipy_s(angle_deg):
    rng = np.random.default_rng(0)
    for _ in range(20):
        axis = rng.normal(size=3)
        turn = Rotation.from_rotvec(np.deg2rad(angle_deg) * axis / np.linalg.norm(axis))
        base = Rotation.random(rng=rng)
        found = rotation_vector((turn * base).as_matrix(), base.as_matrix())
        np.testing.assert_allclose(found, turn.as_rotvec(), atol=1e-9)


def opinions(Ts, informations, owner):
    T = np.stack([one.as_matrix() for one in Ts])
    return Opinions(
        np.ascontiguousarray(T[:, :3, :3]),
        np.ascontiguousarray(T[:, :3, 3]),
        np.stack(informations),
        np.zeros(len(Ts)),
        np.array(owner),
        np.array([max(owner) + 1]),
    )


def test_poses_near_one_another_are_averaged_by_their_informations():
    rng, here = np.random.default_rng(1), camera_at(1.0, 2.0, 0.5, (30, 5, -10))
    changes = rng.normal(0, 1e-3, (3, 6))
    roots = rng.normal(0, 1, (3, 6, 6))
    informations = roots @ np.swapaxes(roots, 1, 2) + np.eye(6)
    Ts = [perturb_pose(here, change) for change in changes]
    found = agreement(opinions(Ts, informations, [0, 1, 2]), *start_of(Ts[0]))
    pull = np.einsum("nij,nj->i", informations, changes)
    expected = np.linalg.solve(informations.sum(axis=0), pull)
    T = RigidTransform.from_components(found.t, Rotation.from_matrix(found.R))
    np.testing.assert_allclose(pose_difference(T, here), expected, atol=1e-5)
    np.testing.assert_allclose(found.information, informations.sum(axis=0))
    assert found.agrees.all()


def start_of(T):
    matrix = T.as_matrix()
    return np.ascontiguousarray(matrix[:3, :3]), np.ascontiguousarray(matrix[:3, 3])


def test_the_hypothesis_that_agrees_is_taken_and_a_marker_apart_is_left_out():
    here = camera_at(0.0, 0.0, 1.0)
    aside = perturb_pose(here, np.array([0.4, 0, 0, 0, 0.3, 0]))
    elsewhere = perturb_pose(here, np.array([0.0, 5.0, 0, 0, 0, 0]))
    sure = [np.eye(6) * 1e6] * 5
    found = agreement(
        opinions([here, aside, here, here, elsewhere], sure, [0, 1, 1, 2, 3]), *start_of(here)
    )
    np.testing.assert_array_equal(found.agrees, [True, True, True, False])
    np.testing.assert_allclose(found.t, here.translation, atol=1e-12)


def test_disagreement_beyond_chance_widens_the_covariance():
    assert excess(0.0, 0) == excess(1e9, 0) == 1.0
    assert excess(16.0, 6) == 1.0  # chance gives 16.81 once in a hundred
    assert excess(18.0, 6) == 3.0
    rng = np.random.default_rng(2)
    T = camera_at(-2.0, 0.0, 1.2)
    seen = seen_by(VGA, T, room(), 0.3, rng)
    honest = Localizer(room(), VGA, "covariance").locate(seen)
    assert np.isfinite(honest.covariance).all()

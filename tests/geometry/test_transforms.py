"""Small changes of poses: `perturb_pose` and `pose_difference` undo each other."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from tagmetry.geometry import RigidTransform, cross_matrix, perturb_pose, pose_difference
from tagmetry.geometry.arrays import Array
from tagmetry.geometry.transforms import Rotation

TRIPLES = arrays(np.float64, 3, elements=st.floats(-5.0, 5.0))
ANGLES_RAD = st.one_of(
    st.floats(0.0, np.pi - 1e-9),
    st.floats(0.0, 1e-7),
    st.floats(np.pi - 1e-6, np.pi - 1e-9),
)


@st.composite
def rotation_vectors(draw: st.DrawFn) -> Array:
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    axis = rng.standard_normal(3)
    return draw(ANGLES_RAD) * axis / np.linalg.norm(axis)


@st.composite
def poses(draw: st.DrawFn) -> RigidTransform:
    turned = Rotation.from_rotvec(draw(rotation_vectors()))
    return RigidTransform.from_components(draw(TRIPLES), turned)


@given(poses(), TRIPLES, rotation_vectors())
def test_difference_undoes_perturb(T_a_b: RigidTransform, moved: Array, turned: Array) -> None:
    change = np.concatenate([moved, turned])
    found = pose_difference(perturb_pose(T_a_b, change), T_a_b)
    np.testing.assert_allclose(found, change, atol=1e-7)


@given(poses(), poses())
def test_perturb_undoes_difference(T_a_b: RigidTransform, T_a_c: RigidTransform) -> None:
    found = perturb_pose(T_a_b, pose_difference(T_a_c, T_a_b))
    np.testing.assert_allclose(found.as_matrix(), T_a_c.as_matrix(), atol=1e-9)


def test_the_change_is_on_the_left_in_frame_a() -> None:
    T_a_b = RigidTransform.from_components([1.0, 2.0, 3.0], Rotation.from_rotvec([0.0, 0.0, 1.0]))
    turn = Rotation.from_rotvec([0.3, 0.0, 0.0])
    found = perturb_pose(T_a_b, np.array([0.1, 0.0, 0.0, 0.3, 0.0, 0.0]))
    np.testing.assert_allclose(found.translation, [1.1, 2.0, 3.0])
    np.testing.assert_allclose(found.rotation.as_matrix(), (turn * T_a_b.rotation).as_matrix())


def test_many_changes_of_one_pose() -> None:
    T_a_b = RigidTransform.from_translation([1.0, 0.0, 0.0])
    changes = np.random.default_rng(1).normal(scale=0.3, size=(7, 6))
    found = pose_difference(perturb_pose(T_a_b, changes), T_a_b)
    np.testing.assert_allclose(found, changes, atol=1e-12)


@pytest.mark.parametrize("shape", [(3,), (4, 3), (2, 4, 3)])
def test_cross_matrix_is_the_cross_product(shape: tuple[int, ...]) -> None:
    rng = np.random.default_rng(2)
    v, w = rng.normal(size=shape), rng.normal(size=shape)
    np.testing.assert_allclose((cross_matrix(v) @ w[..., None])[..., 0], np.cross(v, w))

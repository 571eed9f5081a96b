"""Chained covariances: against finite differences, and against samples."""

from collections.abc import Callable

import numpy as np
import pytest

from tagmetry.geometry import (
    RigidTransform,
    UncertainTransform,
    mahalanobis_squared,
    perturb_pose,
    pose_difference,
)
from tagmetry.geometry.arrays import Array
from tagmetry.geometry.transforms import Rotation

SAMPLES = 20_000
SEEDS = range(4)


def a_pose(rng: np.random.Generator) -> RigidTransform:
    return RigidTransform.from_components(rng.normal(size=3), Rotation.random(rng=rng))


def a_covariance(rng: np.random.Generator, scale: float = 1.0, n: int = 6) -> Array:
    root = scale * rng.normal(size=(n, n))
    return root @ root.T


def slope(function: Callable[[Array], Array], n: int, step: float = 1e-6) -> Array:
    """Return the Jacobian at zero by central differences."""
    columns = [(function(step * e) - function(-step * e)) / (2 * step) for e in np.eye(n)]
    return np.stack(columns, axis=-1)


def assert_same_covariance(samples: Array, expected: Array) -> None:
    """Compare within five standard errors of a sample covariance (Wishart)."""
    found = np.cov(samples.T)
    variances = np.diag(expected)
    error = np.sqrt((np.outer(variances, variances) + expected**2) / len(samples))
    assert (np.abs(found - expected) < 5 * error).all()


@pytest.mark.parametrize("seed", SEEDS)
def test_composition_by_finite_differences(seed: int) -> None:
    rng = np.random.default_rng(seed)
    T_a_b, T_b_c = a_pose(rng), a_pose(rng)
    cov_ab, cov_bc = a_covariance(rng), a_covariance(rng)

    def composed(change: Array) -> Array:
        T_a_c = perturb_pose(T_a_b, change[:6]) * perturb_pose(T_b_c, change[6:])
        return pose_difference(T_a_c, T_a_b * T_b_c)

    J = slope(composed, 12)
    both = np.block([[cov_ab, np.zeros((6, 6))], [np.zeros((6, 6)), cov_bc]])
    found = UncertainTransform(T_a_b, cov_ab) @ UncertainTransform(T_b_c, cov_bc)
    np.testing.assert_allclose(found.T_a_b.as_matrix(), (T_a_b * T_b_c).as_matrix())
    np.testing.assert_allclose(found.covariance, J @ both @ J.T, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_inverse_by_finite_differences(seed: int) -> None:
    rng = np.random.default_rng(seed)
    T_a_b, cov = a_pose(rng), a_covariance(rng)
    J = slope(lambda change: pose_difference(perturb_pose(T_a_b, change).inv(), T_a_b.inv()), 6)
    found = UncertainTransform(T_a_b, cov).inverse()
    np.testing.assert_allclose(found.T_a_b.as_matrix(), T_a_b.inv().as_matrix())
    np.testing.assert_allclose(found.covariance, J @ cov @ J.T, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_apply_by_finite_differences(seed: int) -> None:
    rng = np.random.default_rng(seed)
    T_a_b, cov, p_b, cov_b = a_pose(rng), a_covariance(rng), rng.normal(size=3), a_covariance(rng)
    J = slope(lambda c: perturb_pose(T_a_b, c[:6]).apply(p_b + c[6:]), 9)
    both = np.block([[cov, np.zeros((6, 3))], [np.zeros((3, 6)), cov_b[:3, :3]]])
    p_a, cov_a = UncertainTransform(T_a_b, cov).apply(p_b, cov_b[:3, :3])
    np.testing.assert_allclose(p_a, T_a_b.apply(p_b))
    np.testing.assert_allclose(cov_a, J @ both @ J.T, rtol=1e-6, atol=1e-6)


def test_apply_to_an_exact_point_adds_nothing_of_its_own() -> None:
    rng = np.random.default_rng(0)
    pose, p_b = UncertainTransform(a_pose(rng), a_covariance(rng)), rng.normal(size=3)
    _, without = pose.apply(p_b)
    _, with_zero = pose.apply(p_b, np.zeros((3, 3)))
    np.testing.assert_allclose(without, with_zero)


def test_composition_by_samples() -> None:
    rng = np.random.default_rng(10)
    T_a_b, T_b_c = a_pose(rng), a_pose(rng)
    cov_ab, cov_bc = a_covariance(rng, 1e-3), a_covariance(rng, 1e-3)
    changes_ab = rng.multivariate_normal(np.zeros(6), cov_ab, SAMPLES)
    changes_bc = rng.multivariate_normal(np.zeros(6), cov_bc, SAMPLES)
    Ts_a_c = perturb_pose(T_a_b, changes_ab) * perturb_pose(T_b_c, changes_bc)
    expected = UncertainTransform(T_a_b, cov_ab) @ UncertainTransform(T_b_c, cov_bc)
    assert_same_covariance(pose_difference(Ts_a_c, expected.T_a_b), expected.covariance)


def test_inverse_by_samples() -> None:
    rng = np.random.default_rng(11)
    pose = UncertainTransform(a_pose(rng), a_covariance(rng, 1e-3))
    changes = rng.multivariate_normal(np.zeros(6), pose.covariance, SAMPLES)
    Ts_b_a = perturb_pose(pose.T_a_b, changes).inv()
    expected = pose.inverse()
    assert_same_covariance(pose_difference(Ts_b_a, expected.T_a_b), expected.covariance)


def test_apply_by_samples() -> None:
    rng = np.random.default_rng(12)
    pose = UncertainTransform(a_pose(rng), a_covariance(rng, 1e-3))
    p_b, cov_b = rng.normal(size=3), a_covariance(rng, 1e-3, n=3)
    changes = rng.multivariate_normal(np.zeros(6), pose.covariance, SAMPLES)
    points_b = rng.multivariate_normal(p_b, cov_b, SAMPLES)
    points_a = perturb_pose(pose.T_a_b, changes).apply(points_b)
    _, expected = pose.apply(p_b, cov_b)
    assert_same_covariance(points_a, expected)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_inverse_of_the_inverse_is_the_pose(seed: int) -> None:
    rng = np.random.default_rng(seed)
    pose = UncertainTransform(a_pose(rng), a_covariance(rng))
    again = pose.inverse().inverse()
    np.testing.assert_allclose(again.T_a_b.as_matrix(), pose.T_a_b.as_matrix(), atol=1e-12)
    np.testing.assert_allclose(again.covariance, pose.covariance, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_inverse_of_a_chain_is_the_chain_of_inverses(seed: int) -> None:
    rng = np.random.default_rng(seed)
    T_a_b = UncertainTransform(a_pose(rng), a_covariance(rng))
    T_b_c = UncertainTransform(a_pose(rng), a_covariance(rng))
    one, other = (T_a_b @ T_b_c).inverse(), T_b_c.inverse() @ T_a_b.inverse()
    np.testing.assert_allclose(one.T_a_b.as_matrix(), other.T_a_b.as_matrix(), atol=1e-12)
    np.testing.assert_allclose(one.covariance, other.covariance, rtol=1e-9, atol=1e-9)


def test_an_exact_transform_has_no_covariance_of_its_own() -> None:
    rng = np.random.default_rng(3)
    exact = UncertainTransform.exact(a_pose(rng))
    pose = UncertainTransform(RigidTransform.identity(), a_covariance(rng))
    assert not exact.covariance.any()
    np.testing.assert_allclose((pose @ exact).covariance[3:, 3:], pose.covariance[3:, 3:])


def test_mahalanobis_of_one_standard_deviation_is_one() -> None:
    variances = np.array([4.0, 9.0])
    found = mahalanobis_squared(np.array([[2.0, 0.0], [0.0, 3.0], [2.0, 3.0]]), np.diag(variances))
    np.testing.assert_allclose(found, [1.0, 1.0, 2.0])


def test_mean_mahalanobis_is_the_number_of_dimensions() -> None:
    rng = np.random.default_rng(4)
    covariance = a_covariance(rng)
    errors = rng.multivariate_normal(np.zeros(6), covariance, SAMPLES)
    assert mahalanobis_squared(errors, covariance).mean() == pytest.approx(6.0, abs=0.15)

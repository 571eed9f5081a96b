"""Planes and the rays that meet them."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.geometry import Plane, RigidTransform
from tagmetry.geometry.transforms import Rotation

T_WORLD_TABLE = RigidTransform.from_components(
    [0.3, -1.0, 0.8], Rotation.from_euler("xyz", [25, -40, 70], degrees=True)
)
TABLE = Plane.of_frame(T_WORLD_TABLE)


def points_on_the_table(count: int = 20) -> np.ndarray:
    p_table = np.random.default_rng(0).uniform(-1, 1, (count, 3)) * [1, 1, 0]
    return T_WORLD_TABLE.apply(p_table)


def test_of_frame_holds_the_frame_s_points_and_faces_its_z() -> None:
    np.testing.assert_allclose(TABLE.distance_m(points_on_the_table()), 0, atol=1e-12)
    above = T_WORLD_TABLE.apply([[0.2, 0.1, 0.5], [0.0, 0.0, -0.25]])
    np.testing.assert_allclose(TABLE.distance_m(above), [0.5, -0.25])


def test_through_exact_points_is_their_plane() -> None:
    found = Plane.through(points_on_the_table())
    sign = np.sign(found.normal @ TABLE.normal)
    np.testing.assert_allclose(found.normal, sign * TABLE.normal, atol=1e-12)
    assert found.offset_m == pytest.approx(sign * TABLE.offset_m)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_the_largest_component_of_a_fitted_normal_is_positive(axis: int) -> None:
    rng = np.random.default_rng(axis)
    for _ in range(10):
        points = rng.uniform(-1, 1, (5, 3))
        points[:, axis] = 0.1 * points[:, axis - 1] - 2.0
        assert Plane.through(points).normal[axis] > 0


def test_through_noisy_points_has_the_least_squares() -> None:
    rng = np.random.default_rng(5)
    points = points_on_the_table(40) + rng.normal(scale=0.02, size=(40, 3))
    best = Plane.through(points)
    least = (best.distance_m(points) ** 2).sum()
    for turn in rng.normal(scale=0.01, size=(50, 3)):
        normal = Rotation.from_rotvec(turn).apply(best.normal)
        other = Plane(normal, best.offset_m + rng.normal(scale=0.001))
        assert (other.distance_m(points) ** 2).sum() > least


def test_through_very_many_points_needs_no_square_matrix_of_them() -> None:
    points = np.random.default_rng(6).uniform(-1, 1, (50_000, 3)) * [1, 1, 0]
    np.testing.assert_allclose(Plane.through(points).normal, [0, 0, 1])


def test_rays_meet_the_plane_on_it_and_ahead() -> None:
    rng = np.random.default_rng(1)
    origins = rng.normal(size=(50, 3))
    targets = points_on_the_table(50)
    found = TABLE.meet(origins, 0.1 * (targets - origins))
    np.testing.assert_allclose(found, targets, atol=1e-9)


def test_one_origin_serves_many_directions() -> None:
    found = Plane(np.array([0.0, 0.0, 1.0]), 1.0).meet(
        np.zeros(3), np.array([[0.0, 0.0, 2.0], [1.0, 0.0, 1.0]])
    )
    np.testing.assert_allclose(found, [[0, 0, 1], [1, 0, 1]])


@pytest.mark.parametrize(
    "direction",
    [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 0.0, 0.0], [np.nan, 0.0, 1.0]],
    ids=["level", "away", "none", "nan"],
)
def test_a_ray_that_misses_gives_nan(direction: list[float]) -> None:
    floor = Plane(np.array([0.0, 0.0, 1.0]), 1.0)
    assert np.isnan(floor.meet(np.zeros(3), np.array(direction))).all()


def test_a_transformed_plane_holds_the_transformed_points() -> None:
    T_a_world = RigidTransform.from_components([1.0, 2.0, -3.0], Rotation.from_rotvec([1, 2, 0.5]))
    p_world = np.random.default_rng(2).normal(size=(30, 3))
    found = TABLE.transformed(T_a_world).distance_m(T_a_world.apply(p_world))
    np.testing.assert_allclose(found, TABLE.distance_m(p_world), atol=1e-12)


def test_transforming_there_and_back_changes_nothing() -> None:
    there = T_WORLD_TABLE
    back = TABLE.transformed(there).transformed(there.inv())
    np.testing.assert_allclose(back.normal, TABLE.normal)
    assert back.offset_m == pytest.approx(TABLE.offset_m)


@pytest.mark.parametrize(
    "points",
    [
        np.outer([0.0, 1.0, 2.0, 5.0], [1.0, -2.0, 0.3]) + 7.0,
        np.ones((4, 3)),
        [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]],
    ],
    ids=["line", "one point", "two points"],
)
def test_refuses_points_that_define_no_plane(points: np.ndarray) -> None:
    with pytest.raises(InputError, match="on one line"):
        Plane.through(points)


@pytest.mark.parametrize("shape", [(2, 3), (3, 2), (3,), (0, 3)])
def test_refuses_points_of_another_shape(shape: tuple[int, ...]) -> None:
    with pytest.raises(InputError, match=r"shape \(n >= 3, 3\), got"):
        Plane.through(np.zeros(shape))


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_refuses_points_that_are_not_finite(bad: float) -> None:
    with pytest.raises(InputError, match="finite points"):
        Plane.through([[0, 0, 0], [1, 0, 0], [0, 1, bad]])

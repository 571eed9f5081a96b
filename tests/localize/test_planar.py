"""Robots on a floor: seed 004's equations against the full chain, and the constrained solution."""

import numpy as np
import pytest
from marked_world import VGA, camera_at, seen_by, wall_marker

from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform, mahalanobis_squared, perturb_pose, pose_difference
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import (
    Gravity,
    Height,
    Knowledge,
    Localizer,
    MarkerMap,
    PlanarRobot,
    camera_on_floor,
    robot_on_floor,
)
from tagmetry.localize.planar import beside_marker_m, turn_to_marker_rad

ON_ROBOT = RigidTransform.from_components(  # looks forward and 25 degrees up, 40 cm above the floor
    [0.12, 0.03, 0.40],
    Rotation.from_euler("y", -25, degrees=True)
    * Rotation.from_matrix([[0, 0, 1], [-1, 0, 0], [0, -1, 0]]),
)
ALONE = MarkerMap((wall_marker(0, 0.1, 1.4, lean=(8, 0, 0)),))


def robot_at(x_m, y_m, heading_rad):
    return RigidTransform.from_components([x_m, y_m, 0.0], Rotation.from_euler("z", heading_rad))


def errors_of(poses, truths):
    apart = [
        [p.x_m - x, p.y_m - y, np.angle(np.exp(1j * (p.heading_rad - heading)))]
        for p, (x, y, heading) in zip(poses, truths, strict=True)
    ]
    return np.array(apart)


@pytest.mark.parametrize("yaw_deg", [-170, -60, 0, 25, 90, 140])
def test_equation_3_is_the_full_chain(yaw_deg):
    turn = Rotation.from_euler("z", yaw_deg, degrees=True)
    rng = np.random.default_rng(0)
    for _ in range(20):
        marker = wall_marker(
            0, *rng.uniform(-1, 1, 2), x_m=rng.uniform(-1, 1), lean=(yaw_deg, 0, 0)
        )
        before = marker.T_world_marker.translation + turn.apply([-2.0, rng.uniform(-1, 1), 0.3])
        heading_deg = yaw_deg + rng.uniform(-30, 30)
        T = camera_at(*before, (heading_deg, 0, 0))
        pose = camera_on_floor(T.inv() * marker.T_world_marker, marker.T_world_marker)
        np.testing.assert_allclose([pose.x_m, pose.y_m], T.translation[:2], atol=1e-9)
        off = np.angle(np.exp(1j * (pose.heading_rad - np.deg2rad(heading_deg))))
        assert abs(off) < 1e-9


def test_equation_1_in_the_elements_of_a_quaternion():
    for turned_deg in (-70, -10, 0, 40):
        T = (
            camera_at(-2, 0.3, 1.0, (turned_deg, 0, 0)).inv()
            * wall_marker(0, 0, 1.2).T_world_marker
        )
        X, Y, Z, W = T.rotation.as_quat()
        theta = np.arctan2(2 * (W * Y - X * Z), W**2 + X**2 - Y**2 - Z**2)
        assert theta == pytest.approx(np.deg2rad(turned_deg))
        assert turn_to_marker_rad(T) == pytest.approx(theta)


def test_the_printed_equation_2_is_no_rotation_and_ours_is():
    """The paper's second line has - x sin(theta): its determinant is cos(2 theta)."""
    for theta in np.deg2rad([10, 30, 45]):
        c, s = np.cos(theta), np.sin(theta)
        assert np.linalg.det([[c, -s], [-s, c]]) == pytest.approx(np.cos(2 * theta))
        assert np.linalg.det([[c, -s], [s, c]]) == pytest.approx(1)
        marker = wall_marker(0, 0.0, 1.2)
        T = camera_at(-2.0, 0.7, 1.2, (np.rad2deg(theta), 0, 0))
        x, _, z = (T.inv() * marker.T_world_marker).translation
        right_m, before_m = beside_marker_m(T.inv() * marker.T_world_marker)
        assert (right_m, before_m) == pytest.approx((-0.7, 2.0))  # the wall's right is -y
        assert (-(x * c - z * s), z * c + x * s) == pytest.approx((-0.7, 2.0))
        printed = z * c - x * s
        assert abs(printed - 2.0) > 0.3


def test_refuses_a_marker_that_does_not_stand_upright():
    lying = wall_marker(0, 0.0, 1.2, lean=(0, 90, 0))
    with pytest.raises(InputError, match="seed 004's equations are for upright markers"):
        camera_on_floor(RigidTransform.identity(), lying.T_world_marker)


def driven(count, *, noise_px=0.3, seed=0, tilt_rad=0.0, height_m=0.0):
    """Return the found places of a robot that sees one marker, and the true ones."""
    rng = np.random.default_rng(seed)
    robot = PlanarRobot(ON_ROBOT, 0.0, tilt_rad, height_m)
    localizer = Localizer(ALONE, VGA, known=robot.knowledge)
    found, truths = [], []
    for _ in range(count):
        x_m, y_m = -rng.uniform(1.5, 2.5), rng.uniform(-0.4, 0.4)
        truth = (x_m, y_m, np.arctan2(0.1 - y_m, -x_m) + rng.uniform(-0.1, 0.1))
        bump = [0, 0, *rng.normal(0, [height_m, tilt_rad, tilt_rad]), 0]
        T_world_robot = perturb_pose(robot_at(*truth), np.array(bump))
        seen = seen_by(VGA, T_world_robot * ON_ROBOT, ALONE, noise_px, rng)
        pose = localizer.locate(seen)
        found.append((pose, robot_on_floor(pose.best, ON_ROBOT)))
        truths.append(truth)
    return found, truths


def test_a_robot_on_the_floor_needs_one_marker_and_has_one_pose():
    found, truths = driven(100)
    errors = errors_of([planar for _, planar in found], truths)
    assert np.abs(errors[:, 2]).max() < np.deg2rad(4)
    assert max(pose.ambiguity for pose, _ in found) < 1e-3
    covariances = np.stack([planar.covariance for _, planar in found])
    assert abs(mahalanobis_squared(errors, covariances).mean() - 3) < 4 * np.sqrt(6 / 100)


def test_without_the_floor_the_same_views_are_ambiguous_and_worse():
    found, truths = driven(60)
    free = Localizer(ALONE, VGA)
    rng = np.random.default_rng(0)
    ambiguous, freely = [], []
    for x_m, y_m, heading in truths:
        T = robot_at(x_m, y_m, heading) * ON_ROBOT
        pose = free.locate(seen_by(VGA, T, ALONE, 0.3, rng))
        ambiguous.append(pose.ambiguity)
        freely.append(np.linalg.norm(pose_difference(pose.T_world_camera, T)[:2]))
    constrained = np.linalg.norm(errors_of([p for _, p in found], truths)[:, :2], axis=1)
    assert np.mean(ambiguous) > 0.02
    assert np.sqrt(np.mean(constrained**2)) < 0.8 * np.sqrt(np.mean(np.square(freely)))


def test_an_uneven_floor_is_told_and_stays_calibrated():
    found, truths = driven(150, tilt_rad=np.deg2rad(1), height_m=0.003)
    errors = errors_of([planar for _, planar in found], truths)
    covariances = np.stack([planar.covariance for _, planar in found])
    assert abs(mahalanobis_squared(errors, covariances).mean() - 3) < 4 * np.sqrt(6 / 150)


@pytest.mark.slow
def test_no_robot_of_ten_thousand_is_turned_the_wrong_way():
    found, truths = driven(10_000)
    errors = errors_of([planar for _, planar in found], truths)
    deviations = np.sqrt(np.stack([planar.covariance[2, 2] for _, planar in found]))
    assert (np.abs(errors[:, 2]) / deviations).max() < 6


@pytest.mark.parametrize("method", ["single", "mean", "weighted", "covariance"])
def test_methods_that_cannot_heed_the_floor_say_so(method):
    with pytest.raises(InputError, match=f"the method {method} cannot make use of gravity"):
        Localizer(ALONE, VGA, method, PlanarRobot(ON_ROBOT).knowledge)
    with pytest.raises(InputError, match="joint can"):
        Localizer(ALONE, VGA, method).locate([], PlanarRobot(ON_ROBOT).knowledge)


@pytest.mark.parametrize(
    ("make", "why"),
    [
        (lambda: Gravity(np.zeros(3), 0.01), "up_camera must be three numbers, not all 0"),
        (lambda: Gravity(np.ones(2), 0.01), "up_camera must be three numbers"),
        (lambda: Gravity(np.ones(3), -1.0), "deviation_rad must be finite and not negative"),
        (lambda: Height(np.zeros(3), np.nan, 0.1), "z_m must be finite"),
        (lambda: Height(np.array([0, np.inf, 0]), 0.0, 0.1), "p_camera must be three finite"),
        (lambda: PlanarRobot(ON_ROBOT, height_deviation_m=np.inf), "deviation_m must be finite"),
    ],
)
def test_refuses_knowledge_that_is_none(make, why):
    with pytest.raises(InputError, match=why):
        make()


def test_what_is_known_adds_up():
    both = Knowledge(ups=(Gravity(np.ones(3), 0.1),)) + Knowledge(
        heights=(Height(np.zeros(3), 1, 0),)
    )
    assert (len(both.ups), len(both.heights), both.is_empty) == (1, 1, False)
    assert Knowledge().is_empty

"""Methods that start from each marker's own pose: the chain, its averages, and their fusion."""

from dataclasses import replace

import numpy as np
import pytest
from marked_world import DISTORTED, FISHEYE, VGA, camera_at, room, seen_by, wall, wall_marker

from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform, mahalanobis_squared, mean_angle_rad, pose_difference
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize import METHODS, Localizer, MarkerMap, WeightedByDistance
from tagmetry.localize.chain import marker_views
from tagmetry.localize.seen import known_markers

OF_MARKERS = ["single", "mean", "weighted", "covariance"]


def located(method, marker_map, camera, detections):
    return Localizer(marker_map, camera, method).locate(detections)


def errors(method, T_world_camera, marker_map, count, *, camera=VGA, noise_px=0.1, seed=0):
    """Return the poses' errors (n, 6) and covariances (n, 6, 6) over many noisy images."""
    rng = np.random.default_rng(seed)
    localizer = Localizer(marker_map, camera, method)
    found = [
        localizer.locate(seen_by(camera, T_world_camera, marker_map, noise_px, rng))
        for _ in range(count)
    ]
    apart = [pose_difference(one.T_world_camera, T_world_camera) for one in found]
    return np.stack(apart), np.stack([one.covariance for one in found])


def rms_m(errors):
    return np.sqrt((errors[:, :3] ** 2).sum(axis=1).mean())


@pytest.mark.parametrize("camera", [VGA, DISTORTED, FISHEYE])
@pytest.mark.parametrize("method", METHODS)
def test_exact_corners_give_the_exact_pose(method, camera):
    T = camera_at(-2.2, 0.2, 1.1, (5, 3, 4))
    pose = located(method, room(), camera, seen_by(camera, T, room(), 0.1))
    np.testing.assert_allclose(pose_difference(pose.T_world_camera, T), 0, atol=1e-6)
    assert pose.method == method
    assert pose.used


@pytest.mark.parametrize("method", METHODS)
def test_turning_the_world_turns_the_pose(method):
    T_new_world = RigidTransform.from_components([3, -2, 5], Rotation.from_rotvec([0.3, 1.0, -2.0]))
    T = camera_at(-2.2, 0.2, 1.1, (5, 3, 4))
    detections = seen_by(VGA, T, room(), 0.1, np.random.default_rng(4))
    options = {"weighted": WeightedByDistance(angles="group")}  # Euler's angles do not turn along
    one = located(options.get(method, method), room(), VGA, detections)
    other = located(options.get(method, method), room().transformed(T_new_world), VGA, detections)
    np.testing.assert_allclose(
        pose_difference(other.T_world_camera, T_new_world * one.T_world_camera), 0, atol=1e-5
    )
    turn = np.kron(np.eye(2), T_new_world.rotation.as_matrix())
    np.testing.assert_allclose(
        other.covariance, turn @ one.covariance @ turn.T, rtol=1e-3, atol=1e-8
    )


@pytest.mark.parametrize("method", ["single", "mean"])
def test_the_covariance_of_near_and_leaning_markers_is_right(method):
    markers = tuple(wall_marker(n, 0.3 * n, 1.2, lean=(40 - 80 * n, 20, 0)) for n in range(2))
    found, covariances = errors(method, camera_at(-0.9, 0.15, 1.1), MarkerMap(markers), 150)
    assert abs(mahalanobis_squared(found, covariances).mean() - 6) < 4 * np.sqrt(12 / 150)


def test_more_care_gives_less_error():
    T = camera_at(-2.5, 0.2, 1.1, (5, 3, 4))
    by_method = {name: rms_m(errors(name, T, room(), 30)[0]) for name in OF_MARKERS}
    assert by_method["covariance"] < 0.5 * by_method["weighted"]
    assert by_method["covariance"] < by_method["mean"]


def test_single_takes_the_marker_that_is_surer_than_the_nearest():
    frontal = wall_marker(0, 0.0, 1.2)
    leaning = wall_marker(1, 0.4, 1.2, x_m=0.1, lean=(45, 0, 0))
    pose = located(
        "single",
        MarkerMap((frontal, leaning)),
        VGA,
        seen_by(VGA, camera_at(-3, 0, 1.2), MarkerMap((frontal, leaning))),
    )
    assert [key.id for key in pose.used] == [1]
    assert [(one.key.id, one.why) for one in pose.rejected] == [
        (0, "another marker is expected to be more exact")
    ]


def test_a_frontal_marker_alone_leaves_two_hypotheses():
    alone = MarkerMap((wall_marker(0, 0.0, 1.2, lean=(12, 0, 0)),))
    pose = located("single", alone, VGA, seen_by(VGA, camera_at(-3, 0.3, 1.2), alone))
    assert len(pose.hypotheses) == 2
    assert 0.05 < pose.ambiguity < 0.5
    assert sum(one.probability for one in pose.hypotheses) == pytest.approx(1)


@pytest.mark.parametrize("power", [0.0, 1.0, 2.0])
def test_weighted_is_the_sum_that_the_paper_prints(power):
    T = camera_at(-2.2, 0.2, 1.1, (5, 3, 4))
    detections = seen_by(VGA, T, room(), 0.3, np.random.default_rng(1))
    pose = located(WeightedByDistance(power), room(), VGA, detections)
    views = marker_views(known_markers(detections, room()).seen, VGA)
    weights = np.array([1 / view.distance_m**power for view in views])
    ratios = weights / weights.sum()
    poses = [view.best.T_world_camera for view in views]
    x = sum(ratio * one.translation for ratio, one in zip(ratios, poses, strict=True))
    np.testing.assert_allclose(pose.T_world_camera.translation, x, atol=1e-12)
    yaw, pitch, roll = np.transpose([one.rotation.as_euler("ZYX") for one in poses])
    expected = [mean_angle_rad(angle, ratios) for angle in (yaw, pitch, roll)]
    np.testing.assert_allclose(pose.T_world_camera.rotation.as_euler("ZYX"), expected, atol=1e-12)


def test_angles_are_averaged_through_the_half_turn():
    half_turn = RigidTransform.from_rotation(Rotation.from_euler("z", 180, degrees=True))
    turned = wall().transformed(half_turn)
    T = half_turn * camera_at(-2.0, 0.0, 1.2)
    pose = located("weighted", turned, VGA, seen_by(VGA, T, turned, 0.1, np.random.default_rng(2)))
    assert np.abs(pose_difference(pose.T_world_camera, T)[3:]).max() < np.deg2rad(5)


def test_fusion_leaves_out_a_marker_that_stands_elsewhere():
    T = camera_at(-1.5, 0.2, 1.1, (5, 3, 4))
    detections = seen_by(VGA, T, room(), 0.1, np.random.default_rng(3))
    wrong = detections[1].id
    moved = RigidTransform.from_translation([0.0, 0.3, 0.1])
    markers = (
        replace(one, T_world_marker=moved * one.T_world_marker) if one.id == wrong else one
        for one in room().markers
    )
    pose = located("covariance", MarkerMap(tuple(markers)), VGA, detections)
    assert wrong in [one.key.id for one in pose.rejected]
    assert np.linalg.norm(pose_difference(pose.T_world_camera, T)[:3]) < 0.02


def test_unknown_and_repeated_markers_are_passed_over_and_named():
    T = camera_at(-2.2, 0.2, 1.1)
    detections = seen_by(VGA, T, wall())
    detections = [*detections, replace(detections[0], id=77), detections[1]]
    pose = located("mean", wall(), VGA, detections)
    assert {(one.key.id, one.why) for one in pose.rejected} == {
        (77, "it is not in the map"),
        (detections[1].id, "it was seen 2 times in one image"),
    }
    np.testing.assert_allclose(pose_difference(pose.T_world_camera, T), 0, atol=1e-6)


@pytest.mark.parametrize("method", METHODS)
def test_no_pose_says_why(method):
    empty = located(method, wall(), VGA, [])
    assert (empty.hypotheses, empty.used) == ((), ())
    with pytest.raises(InputError, match="no camera pose: the image shows no marker"):
        _ = empty.best
    stranger = replace(seen_by(VGA, camera_at(-2, 0, 1.2), wall())[0], id=99)
    nothing = located(method, wall(), VGA, [stranger])
    assert nothing.why == (
        "the image shows no usable marker of the map (tag36h11 id 99: it is not in the map)"
    )


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("spoil", [np.nan, np.inf, 1e9, 0.0])
def test_corners_that_are_no_marker_s_do_no_harm(method, spoil):
    T = camera_at(-1.8, 0.0, 1.2, (0, 8, 0))
    good, bad, *rest = seen_by(VGA, T, wall(), 0.1)
    bad = replace(bad, corners_px=np.full((4, 2), spoil))
    pose = located(method, wall(), VGA, [good, bad, *rest])
    np.testing.assert_allclose(pose_difference(pose.T_world_camera, T), 0, atol=1e-5)
    assert not located(method, wall(), VGA, [bad]).hypotheses


def test_refuses_a_method_that_there_is_not():
    with pytest.raises(InputError, match="there is no method 'best'; there are single, mean"):
        Localizer(wall(), VGA, "best").locate(seen_by(VGA, camera_at(-2, 0, 1.2), wall()))


@pytest.mark.parametrize("options", [{"power": -1.0}, {"power": np.nan}, {"angles": "degrees"}])
def test_refuses_weights_that_are_none(options):
    with pytest.raises(InputError, match=r"must be (from 0 to 10|euler or group)"):
        WeightedByDistance(**options)

"""The bound's derivatives against the twin's pictures, and what motion, light and size do to it."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.camera import Camera
from tagmetry.detect.photometric.bound import (
    Print,
    corner_bound_px,
    corner_bound_px2,
    detector,
    detector_covariance_px2,
    light,
)
from tagmetry.detect.photometric.bound.edges import by_edges, edge_px
from tagmetry.detect.photometric.bound.seen import Window
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, family
from tagmetry.twin import Optics, Scene, Shot, Shutter, exposed
from tagmetry.twin.scenes import Steady, Still, marker_thing

SEEN = Print(family("tag36h11").picture(0), 0, 40.0, 200.0, 0.6)
SHAPE = np.array([[-0.5, -0.4], [0.5, -0.5], [0.45, 0.5], [-0.5, 0.45]])
CAMERA = Camera(110, 108, (500.0, 500.0), (54.3, 52.6))


def square(side_px: float) -> Array:
    return side_px * SHAPE + np.array([300.2, 200.7])


def moving_light(shift_px: float, motion_px: tuple[float, float]) -> tuple[Array, Array]:
    """Return how white the twin's pixels are of a marker moved to the right, and its corners."""
    depth_m = 1.0
    turn = Rotation.from_euler("xyz", [200.0, 12.0, 25.0], degrees=True)
    T = RigidTransform.from_components([shift_px / 500 * depth_m, 0.0, depth_m], turn)
    marker = MountedMarker("tag36h11", 0, 0.09, RigidTransform.identity())
    velocity = np.array([*motion_px, 0.0]) / 500 * depth_m
    thing = marker_thing([marker], Steady(T, velocity, np.zeros(3)), paper=1.0, ink=0.0)
    shot = Shot(
        CAMERA,
        Still(RigidTransform.identity()),
        optics=Optics(blur_px=SEEN.blur_px),
        shutter=Shutter(1.0),
    )
    corners_px = CAMERA.project(T.apply(marker.corners_m))
    return exposed(Scene((thing,), background=1.0), shot), corners_px


@pytest.mark.parametrize("motion_px", [(0.0, 0.0), (2.5, -1.0)])
def test_the_picture_changes_as_the_twins_does(motion_px: tuple[float, float]) -> None:
    here, corners_px = moving_light(0.0, motion_px)
    ahead, behind = (moving_light(step, motion_px)[0] for step in (0.05, -0.05))
    seen = replace(SEEN, motion_px=motion_px)
    window = Window.around(corners_px, seen)
    columns, rows = window.size_px
    left, top = np.rint(corners_px - _corners_of(window))[0].astype(int)
    shown = np.s_[top : top + rows, left : left + columns]
    white = light.whiteness(light.sharp_samples(window, seen), seen).reshape(rows, columns)
    np.testing.assert_allclose(white, here[shown], atol=0.03)
    change = by_edges(window, seen)[0][:, ::2].sum(axis=1).reshape(rows, columns)
    np.testing.assert_allclose(change, (ahead - behind)[shown] / 0.1, atol=0.02)


def _corners_of(window: Window) -> Array:
    unit = np.array([[0.0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]) @ window.H.T
    return unit[:, :2] / unit[:, 2:]


def test_edges_are_as_long_as_they_are() -> None:
    one_cell = Print(np.zeros((1, 1), dtype=bool), 0, 40.0, 200.0, 0.6)
    corners = np.array([[10.0, 10.0], [50.0, 10.0], [50.0, 30.0], [10.0, 30.0]])
    assert edge_px(Window.around(corners, one_cell), one_cell) == pytest.approx(120, rel=1e-4)


def test_motion_makes_corners_less_known_across_it() -> None:
    still = corner_bound_px2(square(40), SEEN, 5.0)
    moving = corner_bound_px2(square(40), replace(SEEN, motion_px=(4.0, 0.0)), 5.0)
    grown = np.sqrt(np.diag(moving) / np.diag(still)).reshape(4, 2).mean(axis=0)
    assert grown[0] > 1.25
    assert grown[0] > 1.15 * grown[1]


def test_lights_own_noise_is_between_that_of_black_and_that_of_white() -> None:
    own = corner_bound_px(square(40), replace(SEEN, grey_per_electron=0.5), 0.0)
    black, white = (corner_bound_px(square(40), SEEN, np.sqrt(0.5 * g)) for g in (40, 200))
    assert black < own < white
    both = corner_bound_px(square(40), replace(SEEN, grey_per_electron=0.5), 3.0)
    assert own < both < np.hypot(own, corner_bound_px(square(40), SEEN, 3.0)) * 1.1


@pytest.mark.parametrize("side_px", [14, 40, 90])
def test_the_detector_knows_less_than_can_be_known(side_px: float) -> None:
    least = corner_bound_px2(square(side_px), SEEN, 5.0)
    reached = detector_covariance_px2(square(side_px), SEEN, 5.0)
    assert np.linalg.eigvalsh(reached - least).min() > 0
    assert np.trace(reached) < 1.7 * np.trace(least)


def test_large_markers_are_like_smaller_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    quickly = detector_covariance_px2(square(210), SEEN, 5.0)
    monkeypatch.setattr(detector, "_LARGE_PX", np.inf)
    exactly = detector_covariance_px2(square(210), SEEN, 5.0)
    assert np.trace(quickly) == pytest.approx(np.trace(exactly), rel=0.1)

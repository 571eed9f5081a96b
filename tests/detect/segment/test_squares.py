"""Dark squares where they truly are: in any light, size and crowd, and in bounded time."""

import time
from concurrent.futures import ThreadPoolExecutor

import cv2
import numpy as np
import pytest

from tagmetry.camera import Camera
from tagmetry.detect.segment import squares, squares_at_a_glance
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, marker_corners_m
from tagmetry.twin import Look, render


def scene(side_px: float, seed: int, look: Look | None = None) -> tuple[np.ndarray, np.ndarray]:
    """A marker tilted by 20 degrees, and its true corners (4, 2)."""
    rng = np.random.default_rng(seed)
    half_px = int(0.9 * side_px + 16)
    camera = Camera(2 * half_px + 1, 2 * half_px + 1, (1400.0, 1400.0), (half_px, half_px))
    turn = Rotation.from_euler("zxz", [rng.uniform(0, 360), 160, rng.uniform(0, 360)], degrees=True)
    place = np.array([0.0, 0.0, 1400.0 * 0.1 / side_px])
    T_camera_marker = RigidTransform.from_components(place, turn)
    marker = MountedMarker("tag36h11", seed, 0.1, RigidTransform.identity())
    grey = render([marker], T_camera_marker, camera, rng, look)
    return grey, camera.project(T_camera_marker.apply(marker_corners_m(0.1)))


def error_px(corners_px: np.ndarray, truth_px: np.ndarray) -> float:
    """How far the nearest square's corners are off, rms; infinity when there is none."""
    turned = np.stack([np.roll(truth_px, k, axis=0) for k in range(4)])
    apart = corners_px[:, None] - turned
    return float(np.sqrt((apart**2).mean(axis=(2, 3)).min(initial=np.inf)))


@pytest.mark.parametrize("side_px", [16.0, 20.0, 40.0, 100.0, 300.0])
@pytest.mark.parametrize(
    "look",
    [
        Look(),
        Look(noise=8.0),
        Look(black=100.0, white=116.0, noise=0.5, background=108.0),
        Look(blur_px=1.2, noise=2.0),
    ],
    ids=["plain", "noise", "faint", "blurred"],
)
def test_a_marker_s_outline_is_found_to_a_part_of_a_pixel(side_px: float, look: Look) -> None:
    errors = []
    for seed in range(4):
        grey, truth_px = scene(side_px, seed, look)
        errors.append(error_px(squares(grey, 8.0, bright=False).corners_px, truth_px))
    assert max(errors) < 0.5
    assert np.sqrt(np.mean(np.square(errors))) < 0.35


@pytest.mark.parametrize("side_px", [20.0, 40.0, 100.0, 300.0])
@pytest.mark.parametrize("noise", [1.0, 8.0])
def test_a_glance_finds_markers_that_stand_alone(side_px: float, noise: float) -> None:
    for seed in range(4):
        grey, truth_px = scene(side_px, seed, Look(noise=noise))
        assert error_px(squares_at_a_glance(grey, 16.0, bright=False).corners_px, truth_px) < 0.5
        negative = squares_at_a_glance(255 - grey, 16.0, bright=True)
        assert error_px(negative.corners_px[negative.is_bright], truth_px) < 0.5


def test_of_large_markers_only_a_glance_at_half_the_scale_is_taken() -> None:
    grey, truth_px = scene(40.0, 0)
    assert error_px(squares_at_a_glance(grey, 32.0, bright=False).corners_px, truth_px) < 0.5
    assert len(squares_at_a_glance(grey, 60.0, bright=False).corners_px) == 0


def test_squares_of_a_part_are_moved_to_where_they_are() -> None:
    grey, truth_px = scene(60.0, 1)
    part = squares(np.ascontiguousarray(grey[3:, 5:]), 8.0, bright=True).moved(5, 3)
    assert error_px(part.corners_px, truth_px) < 0.5


def test_corners_go_clockwise_as_seen() -> None:
    grey, _ = scene(60.0, 1)
    corners = squares(grey, 8.0, bright=False).corners_px
    sides = np.roll(corners, -1, axis=1) - corners
    turns = _turns(sides)
    assert len(corners) > 0
    assert (turns > 0).all()


def _turns(sides: np.ndarray) -> np.ndarray:
    following = np.roll(sides, -1, axis=1)
    return sides[..., 0] * following[..., 1] - sides[..., 1] * following[..., 0]


def test_bright_squares_are_dark_ones_of_the_negative() -> None:
    grey, truth_px = scene(60.0, 2)
    negative = squares(255 - grey, 8.0, bright=True)
    assert error_px(negative.corners_px[negative.is_bright], truth_px) < 0.3
    plain = squares(grey, 8.0, bright=False)
    np.testing.assert_array_equal(negative.corners_px[negative.is_bright], plain.corners_px)
    assert not plain.is_bright.any()


def test_squares_that_touch_at_corners_are_told_apart() -> None:
    checks = np.kron(np.indices((6, 6)).sum(axis=0) % 2, np.ones((24, 24))) * 170 + 40
    grey = cv2.GaussianBlur(np.pad(checks, 30, constant_values=210).astype(np.uint8), (0, 0), 1.0)
    corners = squares(grey, 16.0, bright=False).corners_px
    for row, column in np.argwhere(np.indices((6, 6)).sum(axis=0) % 2 == 0):
        left, top = 29.5 + 24 * column, 29.5 + 24 * row
        truth = np.array([[left, top], [left + 24, top], [left + 24, top + 24], [left, top + 24]])
        assert error_px(corners, truth) < 0.8


def test_light_that_falls_off() -> None:
    grey, truth_px = scene(60.0, 3)
    falling = (grey * np.linspace(0.15, 1.0, grey.shape[1])).astype(np.uint8)
    assert error_px(squares(falling, 8.0, bright=False).corners_px, truth_px) < 0.6


@pytest.mark.parametrize("size", [(0, 0), (1, 1), (1, 50), (4, 4), (7, 8), (8, 8), (9, 17)])
@pytest.mark.parametrize("kind", ["noise", "flat", "split"])
def test_the_smallest_images_hold_no_surprise(size: tuple[int, int], kind: str) -> None:
    rng = np.random.default_rng(4)
    pictures = {
        "noise": rng.integers(0, 256, size),
        "flat": np.full(size, 7),
        "split": (np.indices(size)[1] > 3) * 255,
    }
    found = squares(pictures[kind].astype(np.uint8), 4.0, bright=True)
    assert np.isfinite(found.corners_px).all()
    assert found.corners_px.shape == (len(found.is_bright), 4, 2)


def test_threads_at_once_see_the_same() -> None:
    pictures = [scene(40.0 + 20 * k, k)[0] for k in range(4)] * 4
    alone = [squares(picture, 8.0, bright=True).corners_px for picture in pictures]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda p: squares(p, 8.0, bright=True).corners_px, pictures))
    for a, b in zip(alone, together, strict=True):
        np.testing.assert_array_equal(a, b)


def hard_pictures() -> dict[str, np.ndarray]:
    rng = np.random.default_rng(5)
    y, x = np.indices((1080, 1920))
    return {
        "noise": rng.integers(0, 256, (1080, 1920)),
        "soft noise": 120 + rng.normal(0, 8, (1080, 1920)),
        **{f"checks of {n}": ((x // n + y // n) % 2) * 200 for n in (1, 2, 3, 5, 8, 24)},
        "lines": (x // 2 % 2) * 200,
        "blocks": np.kron(rng.integers(0, 2, (60, 107)), np.ones((18, 18)))[:1080, :1920] * 180,
        "specks": np.kron(rng.integers(0, 2, (360, 640)), np.ones((3, 3))) * 180,
    }


@pytest.mark.parametrize("kind", hard_pictures())
def test_no_picture_takes_long(kind: str) -> None:
    """On a free machine 10 to 80 ms; the processor time of a crowded one is up to thrice that."""
    grey = hard_pictures()[kind].astype(np.uint8)
    squares(grey[:64, :64], 8.0, bright=False)
    times_s = []
    for _ in range(3):
        start_s = time.thread_time()
        squares(grey, 16.0, bright=False)
        times_s.append(time.thread_time() - start_s)
    assert min(times_s) < 0.25

"""How often the wrong one of two poses fits better, and whether the pose says so beforehand."""

import numpy as np
import pytest
from scipy.stats import norm
from seen_markers import FACING, PINHOLE

from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import marker_corners_m
from tagmetry.pose.marker import solve

FOCAL_PX, SIZE_M = 1000.0, 0.1
CASES = [  # tilt in degrees, side and noise in pixels
    (5, 60, 0.1),
    (10, 60, 0.1),
    (10, 60, 0.3),
    (20, 30, 0.1),
    (20, 40, 0.3),
    (20, 60, 0.3),
    (45, 30, 0.3),
    (60, 20, 0.3),
]


def flips(tilt_deg, side_px, sd_px, count, seed=0):
    """Return for views with two hypotheses whether the best leans wrongly, and its ambiguity."""
    rng = np.random.default_rng(seed)
    around = rng.uniform(0, 2 * np.pi, count)
    axes = np.stack([np.cos(around), np.sin(around), np.zeros(count)], axis=1)
    rolls = Rotation.from_euler("z", rng.uniform(0, 360, (count, 1)), degrees=True)
    rotations = Rotation.from_rotvec(np.deg2rad(tilt_deg) * axes) * FACING * rolls
    p_marker = marker_corners_m(np.full(count, SIZE_M))
    t = np.array([0.0, 0.0, FOCAL_PX * SIZE_M / side_px])
    corners = PINHOLE.project(p_marker @ np.swapaxes(rotations.as_matrix(), 1, 2) + t)
    corners = corners + rng.normal(size=corners.shape) * sd_px
    noise = np.tile(np.eye(8) * sd_px**2, (count, 1, 1))
    found = solve(corners, noise, np.full(count, SIZE_M), PINHOLE)
    normals = rotations.as_matrix()[:, :2, 2]
    best_normals = np.stack([h[0].T_camera_marker.as_matrix()[:2, 2] for h in found])
    two = np.array([len(h) == 2 for h in found])
    ambiguity = np.array([1 - h[0].probability for h in found])
    return (best_normals * normals).sum(axis=1) < 0, ambiguity, two


def check_calibrated(case, count):
    wrong, ambiguity, two = flips(*case, count)
    wrong, ambiguity = wrong[two], ambiguity[two]
    deviation = np.sqrt((ambiguity * (1 - ambiguity)).sum() + 1) / len(wrong)
    assert abs(wrong.mean() - ambiguity.mean()) < 4 * deviation


@pytest.mark.parametrize("case", CASES)
def test_stated_ambiguity_is_the_observed_rate_of_flips(case):
    check_calibrated(case, 1000)


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_stated_ambiguity_is_the_observed_rate_of_many_flips(case):
    check_calibrated(case, 10_000)


def test_every_level_of_ambiguity_is_calibrated():
    results = [flips(*case, 1000, seed=3) for case in CASES]
    wrong = np.concatenate([w[two] for w, _, two in results])
    ambiguity = np.concatenate([a[two] for _, a, two in results])
    for low, high in [(0, 0.01), (0.01, 0.1), (0.1, 0.2), (0.2, 0.3), (0.3, 0.4), (0.4, 0.5)]:
        chosen = (ambiguity >= low) & (ambiguity < high)
        deviation = np.sqrt((ambiguity * (1 - ambiguity))[chosen].sum() + 1) / chosen.sum()
        assert chosen.sum() > 100
        assert abs(wrong[chosen].mean() - ambiguity[chosen].mean()) < 4 * deviation


@pytest.mark.parametrize("case", CASES)
def test_flips_follow_the_formula(case):
    tilt_deg, side_px, sd_px = case
    wrong, _, _ = flips(*case, 1000, seed=1)
    expected = norm.sf(np.sin(np.deg2rad(tilt_deg)) * side_px**2 / (2 * FOCAL_PX * sd_px))
    assert abs(wrong.mean() - expected) < 0.035 + 0.15 * expected


def test_better_corners_remove_flips():
    rates = [flips(10, 60, sd_px, 500)[0].mean() for sd_px in (1.0, 0.3, 0.1, 0.03)]
    assert rates == sorted(rates, reverse=True)
    assert rates[0] > 0.3
    assert rates[-1] == 0

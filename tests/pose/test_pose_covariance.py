"""The stated covariance is what noise really does: mean squared Mahalanobis distance 6."""

import numpy as np
import pytest
from seen_markers import (
    DISTORTED,
    FISHEYE,
    PINHOLE,
    corners_seen,
    correlated_px2,
    facing,
    posed,
)

from tagmetry.geometry import mahalanobis_squared, pose_difference
from tagmetry.pose.marker import solve

GEOMETRIES = {
    "near": (PINHOLE, posed(facing(30, 20, 10), 0.02, -0.03, 0.5), np.eye(8) * 0.1**2),
    "far": (PINHOLE, posed(facing(50, 100, 200), 0.3, 0.1, 1.5), np.eye(8) * 0.05**2),
    "distorted": (DISTORTED, posed(facing(40, 250, 70), -0.3, 0.25, 0.8), np.eye(8) * 0.1**2),
    "correlated": (DISTORTED, posed(facing(35, 130, 300), 0.25, 0.2, 0.7), correlated_px2(0.1)),
    "fisheye": (FISHEYE, posed(facing(35, 45, 30), 0.5, 0.2, 0.3), correlated_px2(0.05)),
}
SIZE_M = 0.1


def distances2(name: str, count: int):
    camera, T, noise_px2 = GEOMETRIES[name]
    rng = np.random.default_rng(sorted(GEOMETRIES).index(name))
    noise = rng.multivariate_normal(np.zeros(8), noise_px2, count).reshape(count, 4, 2)
    corners = corners_seen(camera, T, SIZE_M) + noise
    found = solve(corners, np.tile(noise_px2, (count, 1, 1)), np.full(count, SIZE_M), camera)
    assert max(1 - hypotheses[0].probability for hypotheses in found) < 1e-3
    errors = np.stack([pose_difference(h[0].T_camera_marker, T) for h in found])
    return mahalanobis_squared(errors, np.stack([h[0].covariance for h in found])), found


@pytest.mark.parametrize("name", GEOMETRIES)
def test_pose_covariance_is_calibrated(name):
    d2, found = distances2(name, 300)
    assert abs(d2.mean() - 6) < 4 * np.sqrt(12 / len(d2))  # chi2 with 6 has variance 12
    chi2 = np.array([h[0].chi2 for h in found])
    assert abs(chi2.mean() - 2) < 4 * np.sqrt(4 / len(d2))  # 8 coordinates, 6 unknowns


@pytest.mark.slow
@pytest.mark.parametrize("name", GEOMETRIES)
def test_pose_covariance_of_two_thousand_trials(name):
    d2, _ = distances2(name, 2000)
    assert abs(d2.mean() - 6) < 0.5
    assert 0.93 < (d2 < 12.592).mean() < 0.97  # the 95 % quantile

"""Corners of AprilTag 3's newer families: as fine as those of other families, on any ground."""

import numpy as np
import pytest
from photographed_markers import errors, seen

from tagmetry.detect import Detector

NAMES = (
    "tagStandard41h12",
    "tagStandard52h13",
    "tagCircle21h7",
    "tagCircle49h12",
    "tagCustom48h12",
)


@pytest.mark.parametrize("name", NAMES)
def test_corners_are_about_as_fine_as_a_black_square_s(name: str) -> None:
    """Of the same size; 30 dB, gamma 2.2. The circles' outermost cells are not looked at."""
    rng = np.random.default_rng(1)
    found, truth = [], []
    for _ in range(20):
        one = seen(rng, 60.0, noise=5.0, exponent=2.2, name=name, tilt_deg=rng.uniform(0, 40))
        found.append(Detector([name]).detect(one.grey, one.camera)[0])
        truth.append(one.corners_px)
    error = np.array([f.corners_px for f in found]) - truth
    distance2 = [
        e.ravel() @ np.linalg.solve(f.corners_cov_px2, e.ravel())
        for e, f in zip(error, found, strict=True)
    ]
    black_square = errors(20, 1, side_px=60.0, noise=5.0, exponent=2.2, camera_known=True)
    assert np.sqrt((error**2).mean()) < 1.6 * np.sqrt((black_square[:, :8] ** 2).mean())
    assert 5 < np.mean(distance2) < 11

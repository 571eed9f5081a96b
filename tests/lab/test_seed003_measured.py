"""Seed 003 from picture to conclusion, as `tagmetry lab run --quick` runs it."""

import numpy as np
import pytest

from tagmetry.lab.experiments import seed003_calibration, seed003_pose
from tagmetry.lab.rigs.webcam_calibration import solved_webcam

pytestmark = pytest.mark.slow


def test_every_position_is_as_exact_as_it_must_be() -> None:
    rows = [row for case in seed003_pose.cases(True) for row in seed003_pose.measure(case, 1)]
    checks = seed003_pose.conclude(rows).checks
    assert [check.told for check in checks if not check.holds] == []


def test_the_camera_is_found_again() -> None:
    rows = seed003_calibration.measure(seed003_calibration.Case("tagmetry", 0), 2)
    off = {row.name: (row.value - row.true) / row.sd for row in rows if np.isfinite(row.sd)}
    assert len(off) == 9
    assert max(map(abs, off.values())) < 4
    error_px = next(row.value for row in rows if row.name == "projection rms px")
    assert error_px < 0.02


def test_opencv_finds_it_too_but_less_exactly() -> None:
    """A check of the rig by a program that shares nothing with it."""
    camera = solved_webcam("paper", np.random.default_rng(0)).camera
    np.testing.assert_allclose(camera.focal_px, (698.5, 698.1), atol=3)
    np.testing.assert_allclose(camera.center_px, (322.7, 236.3), atol=3)

"""Is the stated covariance right? Fresh calibrations, poses and noise against the twin's truth."""

import numpy as np
import pytest
from webcam_rig import DETECTOR, MARKER

from tagmetry.geometry import RigidTransform, pose_difference
from tagmetry.geometry.transforms import Rotation
from tagmetry.lens import Whereabouts, ZoomLens, best_setting, measured
from tagmetry.pipeline.lens.twin import calibrated_lens
from tagmetry.twin.camera import BeforeCamera, TwinCamera, markers_before_camera, webcam
from tagmetry.twin.scenes import Still

BANKS, POSES = 5, 20


def placed(rng: np.random.Generator) -> RigidTransform:
    """Anywhere from 7 cm to 1.05 m, a little aside, turned by up to 65 degrees about any axis."""
    depth_m = float(np.exp(rng.uniform(np.log(0.07), np.log(1.05))))
    around, turn = rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(5, 65))
    turned = Rotation.from_rotvec(turn * np.array([np.cos(around), np.sin(around), 0.0]))
    facing = turned * Rotation.from_euler("xz", [180, rng.uniform(-180, 180)], degrees=True)
    return RigidTransform.from_components([*rng.uniform(-0.03, 0.03, 2) * depth_m, depth_m], facing)


def deviations(lens: ZoomLens, rng: np.random.Generator) -> np.ndarray:
    """Errors of x, y and depth by their stated deviations, and the squared distance of all three.

    One image at the setting that is best for the true place.
    """
    at = placed(rng)
    seen_from = Whereabouts(np.asarray(at.translation), np.radians(30.0))
    setting = best_setting(lens, MARKER, seen_from)
    scene = markers_before_camera(BeforeCamera(Still(at)))
    camera = TwinCamera(scene, webcam(), seed=int(rng.integers(2**31)), quick=True)
    for name in ("auto_focus", "auto_exposure"):
        camera.controls.write(name, 0.0)
    camera.controls.write("zoom", setting.zoom_percent)
    camera.controls.write("focus", setting.focus)
    camera.advance(0.5)
    (seen,) = DETECTOR.detect(camera.take().pixels, lens.camera_at(setting))
    found = measured(seen, lens, MARKER, setting)
    off = pose_difference(found.T_camera_marker, at)[:3]
    C = found.covariance[:3, :3]
    return np.array([*(off / np.sqrt(np.diag(C))), off @ np.linalg.solve(C, off)])


@pytest.mark.slow
def test_stated_deviations_cover_what_they_should() -> None:
    rng = np.random.default_rng(11)
    rows = []
    for seed in range(101, 101 + BANKS):
        lens = calibrated_lens(webcam(), step=10.0, seed=seed)
        rows += [deviations(lens, rng) for _ in range(POSES)]
    off = np.array(rows)
    print(np.mean(np.abs(off[:, :3]) < 1.96, axis=0), np.mean(off[:, 3] < 7.815), off.mean(axis=0))
    covered = np.mean(np.abs(off[:, :3]) < 1.96, axis=0)  # 95 %
    assert (covered >= 0.90).all()
    assert covered[2] <= 0.99
    assert np.mean(off[:, 3] < 7.815) >= 0.90  # 95 % of chi-squared with 3 degrees of freedom

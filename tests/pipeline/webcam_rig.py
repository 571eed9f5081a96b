"""The paper's webcam with one 10 mm marker before it, calibrated, on simulated time."""

import numpy as np

from tagmetry.detect import Detector
from tagmetry.geometry import RigidTransform
from tagmetry.lens import MarkerKind
from tagmetry.pipeline.lens import LensTask
from tagmetry.pipeline.lens.twin import webcam_lens
from tagmetry.twin.camera import (
    BeforeCamera,
    Faults,
    TwinCamera,
    facing_camera,
    markers_before_camera,
    webcam,
)
from tagmetry.twin.scenes import Path, Still, Waypoints

MARKER = MarkerKind(0.01, 8)
DETECTOR = Detector(["tag36h11"])


def task(**changes) -> LensTask:
    known = {"lens": webcam_lens(30.0), **changes}
    return LensTask(finder=DETECTOR, marker=MARKER, **known)


def camera(path: Path, faults: Faults | None = None, seed: int = 0) -> TwinCamera:
    scene = markers_before_camera(BeforeCamera(path))
    return TwinCamera(scene, webcam(), seed=seed, faults=faults, quick=True)


def still(
    depth_m: float, turn_deg: float = 30.0, faults: Faults | None = None, seed: int = 0
) -> TwinCamera:
    return camera(Still(facing_camera(depth_m, turn_deg, 0.002, -0.001)), faults, seed)


def moving(times_s: list[float], depths_m: list[float], x_m: list[float]) -> TwinCamera:
    """A marker that is at places at times, and on the straight way between them otherwise."""
    poses = [facing_camera(z_m, 30.0, x) for z_m, x in zip(depths_m, x_m, strict=True)]
    at = Waypoints(np.array(times_s), RigidTransform.concatenate(poses), smooth=False)
    return camera(at)

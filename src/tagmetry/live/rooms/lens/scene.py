"""The simulated webcam with a 10 mm marker before it that stands, or moves to and fro."""

from collections.abc import Generator
from math import pi, sin

from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.lens import MarkerKind
from tagmetry.live.rooms.lens.messages import StartLens
from tagmetry.pipeline.lens import LensStep, LensTask, measure_marker
from tagmetry.pipeline.lens.twin import webcam_lens
from tagmetry.twin.camera import (
    BeforeCamera,
    TwinCamera,
    facing_camera,
    markers_before_camera,
    webcam,
)
from tagmetry.twin.scenes import Along, Path, Still

SIZE_M = 0.01
_CELLS = 8
_LEAST_M, _MOST_M, _MOST_TURN_DEG = 0.05, 1.05, 65.0
_SWING_SHARE, _SWING_S = 0.15, 8.0  # of the depth; to and fro


def checked(asked: StartLens) -> StartLens:
    """Return what is asked for.

    Raises:
        InputError: The marker would stand where the experiments do not look.
    """
    if not (_LEAST_M <= asked.depth_m <= _MOST_M and abs(asked.turn_deg) <= _MOST_TURN_DEG):
        raise InputError(
            f"expected a depth of {_LEAST_M} to {_MOST_M} m and a turn of at most "
            f"{_MOST_TURN_DEG:g} degrees, got {asked.depth_m:g} m and {asked.turn_deg:g}"
        )
    return asked


def true_depth_m(asked: StartLens, time_s: float) -> float:
    """Return where the marker is at a time."""
    if not asked.tracks:
        return asked.depth_m
    swung = 1 + _SWING_SHARE * sin(2 * pi * time_s / _SWING_S)
    return min(max(asked.depth_m * swung, _LEAST_M), _MOST_M)


def lens_steps(asked: StartLens, seed: int = 0) -> Generator[LensStep]:
    """Give a step for each image, until the marker is measured; for ever where it is followed.

    Args:
        asked: Where the marker is.
        seed: Of the images' noise.
    """
    scene = markers_before_camera(BeforeCamera(_path(asked), size_m=SIZE_M))
    camera = TwinCamera(scene, webcam(), seed=seed, quick=True)
    task = LensTask(webcam_lens(), Detector(["tag36h11"]), MarkerKind(SIZE_M, _CELLS))
    return measure_marker(camera, task, tracks=asked.tracks)


def _path(asked: StartLens) -> Path:
    def at(time_s: float) -> RigidTransform:
        return facing_camera(true_depth_m(asked, time_s), asked.turn_deg)

    return Along(at) if asked.tracks else Still(at(0.0))

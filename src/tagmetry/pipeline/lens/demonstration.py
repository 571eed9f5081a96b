"""The whole way on the twin's webcam with a 10 mm marker."""

from collections.abc import Iterator

from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.lens import MarkerKind
from tagmetry.pipeline.lens.session import measure_marker
from tagmetry.pipeline.lens.step import LensStep
from tagmetry.pipeline.lens.task import LensTask
from tagmetry.pipeline.lens.twin import webcam_lens
from tagmetry.twin.camera import (
    BeforeCamera,
    TwinCamera,
    facing_camera,
    markers_before_camera,
    webcam,
)
from tagmetry.twin.scenes import Still

_SIZE_M = 0.01
_LEAST_M, _MOST_M = 0.02, 5.0
_MOST_TURN_DEG = 80.0


def demonstrated(depth_m: float, turn_deg: float, seed: int) -> Iterator[LensStep]:
    """Give a step for each image until the marker is measured.

    Args:
        depth_m: Where it stands.
        turn_deg: How far it is turned.
        seed: Of the images' noise.

    Raises:
        InputError: It stands where nobody would look for it.
    """
    if not (_LEAST_M <= depth_m <= _MOST_M and abs(turn_deg) <= _MOST_TURN_DEG):
        raise InputError(
            f"expected a depth of {_LEAST_M} to {_MOST_M} m and a turn of at most "
            f"{_MOST_TURN_DEG:g} degrees, got {depth_m} m and {turn_deg:g}"
        )
    return _steps(depth_m, turn_deg, seed)


def _steps(depth_m: float, turn_deg: float, seed: int) -> Iterator[LensStep]:
    """Calibrate the webcam when the first step is asked for, then measure."""
    at = Still(facing_camera(depth_m, turn_deg))
    camera = TwinCamera(markers_before_camera(BeforeCamera(at)), webcam(), seed=seed, quick=True)
    marker = MarkerKind(_SIZE_M, 8)
    yield from measure_marker(camera, LensTask(webcam_lens(), Detector(["tag36h11"]), marker))

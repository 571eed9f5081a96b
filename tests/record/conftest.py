"""Results to write: a camera, a marker in front of it, and random ones."""

from collections.abc import Callable

import numpy as np
import pytest

from tagmetry.detect.detection import Detection
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.pose.result import MarkerPose, PoseHypothesis
from tagmetry.record import ImageResult, MarkerResult

CORNERS_PX = np.array([[10.0, 20.5], [30.25, 21.0], [29.0, 41.0], [9.5, 40.0]])
QUARTER_TURN = Rotation.from_quat([0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)])


@pytest.fixture
def make_pose() -> Callable[..., MarkerPose]:
    def make(family: str = "tag36h11", number: int = 7, count: int = 2) -> MarkerPose:
        T = RigidTransform.from_components([0.1, -0.2, 1.5], QUARTER_TURN)
        found = [
            PoseHypothesis(T, np.diag([1.0, 4.0, 9.0, 16.0, 25.0, 36.0]) * 1e-6, 0.125, 3.0, p)
            for p in (0.75, 0.25)[:count]
        ]
        return MarkerPose(family, number, 0.12, tuple(found))

    return make


@pytest.fixture
def make_result(make_pose) -> Callable[..., ImageResult]:
    def make(
        sequence: int = 0, markers: tuple[tuple[str, int], ...] = (("tag36h11", 7),), posed=True
    ) -> ImageResult:
        found = tuple(
            MarkerResult(
                Detection(family, number, CORNERS_PX, np.eye(8) * 0.01, 1, 0.5),
                make_pose(family, number) if posed else None,
            )
            for family, number in markers
        )
        return ImageResult("video.mp4", sequence, 0.1 * sequence, "capture", 640, 480, found)

    return make

"""The stated covariance against the truth of rendered scenes, from picture to pose."""

import numpy as np
import pytest

from tagmetry.camera import Image
from tagmetry.detect import Detector
from tagmetry.geometry import mahalanobis_squared, pose_difference
from tagmetry.pipeline import Measurement
from tagmetry.twin import Look, render, showcase

TASK = Measurement(Detector([showcase.FAMILY]), showcase.CAMERA, showcase.SIZE_M)
TRUTH = {m.id: showcase.T_camera_wall * m.T_body_marker for m in showcase.markers()}


def distances(seed: int, look: Look) -> list[float]:
    """Squared Mahalanobis distances of all measured poses from the truth."""
    scene = showcase.markers(), showcase.T_camera_wall, showcase.CAMERA
    pixels = render(*scene, np.random.default_rng(seed), look)
    return [
        mahalanobis_squared(
            pose_difference(marker.pose.best.T_camera_marker, TRUTH[marker.detection.id]),
            marker.pose.covariance,
        )
        for marker in TASK.measure(Image(pixels)).markers
    ]


@pytest.mark.parametrize("noise", [3.0, 6.0])
def test_the_mean_squared_distance_is_near_its_six_dimensions(noise: float) -> None:
    found = [d for seed in range(3) for d in distances(seed, Look(blur_px=1.2, noise=noise))]
    assert len(found) == 3 * 7
    assert 1 < np.mean(found) < 9

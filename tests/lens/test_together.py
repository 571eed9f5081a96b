"""Images of a marker at rest as one measurement: the noise goes down, the rest stays."""

from dataclasses import replace

import numpy as np
import pytest
from lens_example import MARKER, lens

from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.lens import LensSetting, Measured, measured, together
from tagmetry.markers import marker_corners_m

SETTING = LensSetting(200.0, 41.0)  # a little out of focus, so that noise is most of it
T_CAMERA_MARKER = RigidTransform.from_components(
    [0.0, 0.0, 0.55], Rotation.from_euler("yx", [12, 180], degrees=True)
)
NOISE_PX = 0.02
LENS = lens()


def one_image(rng: np.random.Generator) -> Measured:
    corners_px = LENS.camera_at(SETTING).project(T_CAMERA_MARKER.apply(marker_corners_m(0.01)))
    noisy = corners_px + rng.normal(0, NOISE_PX, (4, 2))
    seen = Detection("tag36h11", 7, noisy, NOISE_PX**2 * np.eye(8), 0, 1.0)
    return measured(seen, LENS, MARKER, SETTING)


def mean_of(count: int, rng: np.random.Generator) -> Measured:
    mean = one_image(rng)
    for _ in range(count - 1):
        mean = together(mean, one_image(rng), LENS, MARKER)
    return mean


def test_noise_is_divided_and_the_rest_is_not() -> None:
    rng = np.random.default_rng(0)
    single, mean = one_image(rng), mean_of(9, rng)
    assert mean.images == 9
    np.testing.assert_allclose(mean.seen.corners_cov_px2, single.seen.corners_cov_px2 / 9)
    rest = [one.detection.corners_cov_px2 - one.seen.corners_cov_px2 for one in (single, mean)]
    np.testing.assert_allclose(rest[0], rest[1], rtol=1e-2, atol=1e-9)
    assert mean.turn_sd_rad < 0.7 * single.turn_sd_rad


def test_in_whatever_order_images_are_joined_the_mean_is_theirs() -> None:
    rng = np.random.default_rng(1)
    images = [one_image(rng) for _ in range(4)]
    pairs = [together(*images[:2], LENS, MARKER), together(*images[2:], LENS, MARKER)]
    mean = together(*pairs, LENS, MARKER)
    expected = np.mean([one.seen.corners_px for one in images], axis=0)
    np.testing.assert_allclose(mean.seen.corners_px, expected, atol=1e-12)
    assert mean.images == 4


def test_errors_of_the_turn_go_down_as_stated() -> None:
    rng = np.random.default_rng(2)
    true = T_CAMERA_MARKER.rotation
    offs = np.array(
        [(mean_of(4, rng).T_camera_marker.rotation * true.inv()).as_rotvec()[1] for _ in range(60)]
    )
    stated = np.sqrt(mean_of(4, rng).pose.covariance[4, 4])
    assert 0.6 * stated < np.sqrt(np.mean(offs**2)) < 1.25 * stated


def test_images_of_two_settings_have_no_mean() -> None:
    one = one_image(np.random.default_rng(3))
    with pytest.raises(InputError, match="only images of one setting have a mean"):
        together(one, replace(one, setting=LensSetting(300.0, 30.0)), LENS, MARKER)

"""Zhang's closed form on exact homographies, and the start on lenses that bend a lot."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from seen_boards import FACING, FISHEYE, NARROW, USUAL, WIDE, Truth, board_points, seen

from tagmetry.calibrate.bundle import Bundle
from tagmetry.calibrate.fit import begin
from tagmetry.calibrate.freedom import Wanted
from tagmetry.calibrate.homographies import fit_homographies
from tagmetry.calibrate.sightings import gather
from tagmetry.calibrate.start import bent, straightened
from tagmetry.calibrate.translate import as_rational
from tagmetry.calibrate.zhang import (
    closed_form,
    focal_lengths,
    least_squares_focal,
    poses_from_homographies,
)
from tagmetry.geometry import Array, apply_homography

K = np.array([[1.4, 0.0, 0.03], [0.0, 1.5, -0.05], [0.0, 0.0, 1.0]])


def poses(count: int = 5) -> tuple[Array, Array]:
    rng = np.random.default_rng(0)
    turns = Rotation.from_rotvec(rng.uniform(-0.6, 0.6, (count, 3))).as_matrix()
    return turns @ FACING, rng.uniform([-0.1, -0.1, 0.4], [0.1, 0.1, 0.8], (count, 3))


def homographies(K: Array) -> Array:
    R, t = poses()
    return K @ np.stack([R[:, :, 0], R[:, :, 1], t], axis=2)


def test_the_camera_comes_back_from_exact_homographies() -> None:
    scales = np.array([1.0, -2.0, 0.3, 5.0, -0.1])[:, None, None]  # H is known up to a factor
    np.testing.assert_allclose(closed_form(homographies(K) * scales), K, atol=1e-10)


def test_every_equation_tells_the_same_focal_length_when_the_centre_is_known() -> None:
    H = homographies(np.diag([1.3, 1.3, 1.0]))
    np.testing.assert_allclose(focal_lengths(H), 1.3, rtol=1e-9)
    assert least_squares_focal(H) == pytest.approx(1.3, rel=1e-9)


def test_the_poses_come_back() -> None:
    R, t = poses_from_homographies(K, -3 * homographies(K))
    np.testing.assert_allclose(R, poses()[0], atol=1e-12)
    np.testing.assert_allclose(t, poses()[1], atol=1e-12)


def test_parallel_boards_determine_no_camera() -> None:
    t = np.random.default_rng(1).uniform([-0.1, -0.1, 0.4], [0.1, 0.1, 0.8], (4, 3))
    R = np.broadcast_to(FACING, (4, 3, 3))
    H = K @ np.stack([R[:, :, 0], R[:, :, 1], t], axis=2)
    assert not focal_lengths(H).size
    assert closed_form(H) is None


def test_homographies_come_back_and_ignore_points_without_weight() -> None:
    xy = board_points()[:, :2]
    H = homographies(K)
    pixels = apply_homography(H, xy)
    weights = np.ones(pixels.shape[:2])
    weights[:, ::7], pixels[:, ::7] = 0.0, 99.0
    found = fit_homographies(xy, pixels, weights)
    expected = H / H[:, 2:, 2:]
    np.testing.assert_allclose(found / found[:, 2:, 2:], expected, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("bend", [-0.8, -0.1, 0.0, 0.3])
def test_bending_undoes_straightening(bend: float) -> None:
    pixels = np.random.default_rng(2).uniform(-0.6, 0.6, (50, 2))
    np.testing.assert_allclose(bent(straightened(pixels, bend), bend), pixels, atol=1e-12)


@pytest.mark.parametrize(
    ("camera", "lens"),
    [(NARROW, "brown5"), (USUAL, "brown5"), (WIDE, "brown5"), (FISHEYE, "fisheye")],
    ids=["55", "70", "120", "fisheye 150"],
)
def test_the_start_is_within_five_percent(camera: Truth, lens: str) -> None:
    found: Bundle = begin(gather(seen(camera, 12, np.random.default_rng(3))), Wanted(lens))
    np.testing.assert_allclose(found.intrinsics[:2], camera.intrinsics[:2], rtol=0.05)


def test_two_wrong_corners_in_every_view_do_not_lead_the_start_astray() -> None:
    views = seen(USUAL, 12, np.random.default_rng(4))
    for view in views:
        view.corners_px[[3, 40]] += 60.0
    found = begin(gather(views), Wanted("brown5"))
    np.testing.assert_allclose(found.intrinsics[:2], USUAL.intrinsics[:2], rtol=0.02)


def test_a_fisheye_translates_to_a_rational_lens() -> None:
    intrinsics = np.array([488.0, 489.0, 635.7, 486.1, 0.02, -0.01, 0.003, -0.001])
    fisheye = Bundle("fisheye", intrinsics, *poses(), board_points())
    brown = as_rational(fisheye, 8, np.radians(60))
    np.testing.assert_allclose(brown.predict(), fisheye.predict(), atol=0.2)

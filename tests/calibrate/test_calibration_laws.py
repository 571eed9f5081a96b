"""Derivatives by finite differences, and what must not change the camera."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from seen_boards import FISHEYE, USUAL, board_points, seen

from tagmetry.calibrate.bundle import Bundle, Freedom, errors_px, linearise
from tagmetry.calibrate.fit import begin, fit_flat, release_shape
from tagmetry.calibrate.freedom import Wanted
from tagmetry.calibrate.leave_out import information_of_all
from tagmetry.calibrate.normal import eliminate_poses, normal_equations, pose_changes
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.sightings import Sightings, gather
from tagmetry.calibrate.view import BoardView, round_covariances
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.geometry import Array


def numbers(found: Calibration) -> Array:
    camera = found.camera
    return np.array([*camera.focal_px, *camera.center_px, *camera.lens.coefficients])


@pytest.fixture(scope="module")
def small() -> tuple[Bundle, Sightings, list[BoardView]]:
    """Return three views, one partial and one of slanted errors, and a bundle near them."""
    views = seen(USUAL, 3, np.random.default_rng(0), sd_px=0.5)
    some = slice(5, 31)
    parts = {"points": views[1].points[some], "p_board": views[1].p_board[some]}
    parts |= {"corners_px": views[1].corners_px[some]}
    parts |= {"covariances_px2": 4 * views[1].covariances_px2[some]}
    slanted = np.tile([[0.3, 0.1], [0.1, 0.2]], (54, 1, 1))
    unlike = [views[0], replace(views[1], **parts), replace(views[2], covariances_px2=slanted)]
    sightings = gather(unlike)
    return begin(sightings, Wanted("brown5")), sightings, unlike


def dense_jacobian(bundle: Bundle, sightings: Sightings) -> Array:
    """Return d(predicted, all corners) / d(intrinsics, points, poses) by central differences."""
    n, k = sightings.used.shape
    shapes = [len(bundle.intrinsics), 3 * k, 6 * n]
    ends = np.cumsum(shapes)[:2]

    def predicted(change: Array) -> Array:
        intrinsics, points, poses = np.split(change, ends)
        moved = bundle.moved(intrinsics, poses.reshape(n, 6), points.reshape(k, 3))
        return np.where(sightings.used[..., None], moved.predict(), 0.0).ravel()

    steps = np.eye(sum(shapes)) * 1e-6
    return np.stack([(predicted(step) - predicted(-step)) / 2e-6 for step in steps], axis=1)


def dense_information(views: list[BoardView]) -> Array:
    """Return the inverse covariance of all corners of all views, zero for those unseen."""
    whole = np.zeros((len(views), 54, 2, len(views), 54, 2))
    for v, view in enumerate(views):
        for point, covariance in zip(view.points, view.covariances_px2, strict=True):
            whole[v, point, :, v, point] = np.linalg.inv(covariance)
    return whole.reshape(len(views) * 108, -1)


def test_the_step_solves_the_whole_normal_equations(
    small: tuple[Bundle, Sightings, list[BoardView]],
) -> None:
    bundle, sightings, views = small
    freedom = Freedom(np.eye(9), np.full(3, 1e-3))
    linear = linearise(bundle, sightings, freedom)
    prior = np.append(np.zeros(9), np.full(3 * len(sightings.points), 1e6))
    normal = normal_equations(linear, freedom).with_prior(prior, 0 * prior)
    information, gradient = eliminate_poses(normal)
    shared = np.linalg.solve(information, gradient)

    J = dense_jacobian(bundle, sightings)
    JtW = J.T @ dense_information(views)
    whole = JtW @ J + np.diag(np.append(prior, np.zeros(18)))
    expected = np.linalg.solve(whole, JtW @ errors_px(bundle, sightings).ravel())
    np.testing.assert_allclose(shared, expected[:-18], rtol=2e-4, atol=1e-7)
    np.testing.assert_allclose(
        pose_changes(normal, shared).ravel(), expected[-18:], rtol=2e-4, atol=1e-7
    )


@pytest.mark.parametrize("lens", ["none", "brown2", "brown5", "fisheye"])
def test_the_intrinsics_derivatives(lens: str) -> None:
    sightings = gather(seen(USUAL, 3, np.random.default_rng(1)))
    bundle, basis = begin(sightings, Wanted(lens)), Wanted(lens).basis()
    linear = linearise(bundle, sightings, Freedom(basis))
    still, fixed = np.zeros((3, 6)), np.zeros((54, 3))
    for column, along in enumerate(basis.T):
        ahead, behind = (bundle.moved(s * along, still, fixed).predict() for s in (1e-6, -1e-6))
        expected = (ahead - behind) / 2e-6
        np.testing.assert_allclose(
            0.1 * linear.by_intrinsics[..., column], expected, rtol=1e-5, atol=1e-6
        )


@pytest.mark.parametrize("free", ["flat", "free"])
def test_the_board_may_be_described_in_any_frame(free: str) -> None:
    views = seen(USUAL, 8, np.random.default_rng(2))
    turn, shift = Rotation.from_rotvec([0.3, 0.2, 1.0]), np.array([0.1, -0.4, 0.2])
    moved = [replace(v, p_board=turn.apply(v.p_board) + shift) for v in views]
    here, there = calibrate(views, "brown4", shape=free), calibrate(moved, "brown4", shape=free)
    tolerance = 1e-6 if free == "flat" else 2e-3  # the print's and the bow's sd follow the axes
    np.testing.assert_allclose(numbers(here)[:4], numbers(there)[:4], rtol=tolerance)
    if free == "flat":
        p_camera = here.Ts_camera_board[0].apply(board_points())
        again = there.Ts_camera_board[0].apply(turn.apply(board_points()) + shift)
        np.testing.assert_allclose(p_camera, again, atol=1e-7)


def test_the_boards_unit_does_not_matter_to_the_camera() -> None:
    views = seen(USUAL, 8, np.random.default_rng(3))
    inches = [replace(v, p_board=v.p_board / 0.0254) for v in views]
    here, there = (
        calibrate(views, "brown5", shape="free"),
        calibrate(inches, "brown5", shape="free"),
    )
    np.testing.assert_allclose(numbers(here)[:4], numbers(there)[:4], rtol=1e-6)
    np.testing.assert_allclose(here.camera.covariance, there.camera.covariance, rtol=1e-3)


def test_a_mirrored_picture_of_a_mirrored_board_mirrors_the_centre() -> None:
    views = seen(USUAL, 8, np.random.default_rng(4))
    flip = np.array([-1.0, 1.0])
    mirrored = [
        replace(
            v,
            p_board=v.p_board * [-1.0, 1.0, 1.0],
            corners_px=v.corners_px * flip + [v.width_px - 1.0, 0.0],
        )
        for v in views
    ]
    here, there = calibrate(views, "brown4"), calibrate(mirrored, "brown4")
    assert there.camera.center_px[0] == pytest.approx(1279 - here.camera.center_px[0], abs=1e-3)
    np.testing.assert_allclose(there.camera.focal_px, here.camera.focal_px, rtol=1e-6)
    assert there.camera.lens.coefficients[3] == pytest.approx(-here.camera.lens.coefficients[3])


def test_exact_corners_give_the_exact_camera() -> None:
    for camera, lens in ((USUAL, "brown5"), (FISHEYE, "fisheye")):
        found = calibrate(seen(camera, 8, np.random.default_rng(5), sd_px=0.0), lens)
        np.testing.assert_allclose(numbers(found), camera.intrinsics, rtol=1e-4, atol=1e-6)
        assert found.rms_px < 1e-5


def test_corners_count_by_their_standard_deviation() -> None:
    rng = np.random.default_rng(6)
    views = seen(USUAL, 10, rng)
    shares = rng.random((10, 54)) < 0.5
    noisy = [
        replace(
            v,
            corners_px=v.corners_px + share[:, None] * rng.normal(0, 3, (54, 2)),
            covariances_px2=round_covariances(np.where(share, 3.0, 0.1)),
        )
        for v, share in zip(views, shares, strict=True)
    ]
    found = calibrate(noisy, "brown5")
    alike = calibrate(
        [replace(v, covariances_px2=round_covariances(np.ones(54))) for v in noisy],
        "brown5",
        robust=False,
    )
    sd, sd_alike = (np.sqrt(c.formula_covariance[0, 0]) for c in (found, alike))
    assert sd < 0.2 * sd_alike
    assert abs(found.camera.focal_px[0] - USUAL.K[0, 0]) < 3 * sd
    assert np.mean([kept.mean() for kept in found.kept]) > 0.995


def test_what_is_held_fixed_stays_and_has_no_variance() -> None:
    views = seen(USUAL, 8, np.random.default_rng(7))
    found = calibrate(views, "brown2", fix_aspect=True, fix_center=True)
    assert found.camera.focal_px[0] == found.camera.focal_px[1]
    assert found.camera.center_px == (639.5, 479.5)
    variances = np.diag(found.camera.covariance)
    np.testing.assert_array_equal(variances > 0, [1, 1, 0, 0, 1, 1, 0, 0])
    assert found.camera.covariance[0, 1] == pytest.approx(variances[0])


def test_wrong_corners_are_named_and_left_out() -> None:
    views = seen(USUAL, 10, np.random.default_rng(8))
    clean = calibrate(views, "brown5")
    views[2].corners_px[7] += [4.0, -3.0]
    views[5].corners_px[[0, 9]] += [30.0, 0.0]
    found = calibrate(views, "brown5")
    dropped = [tuple(np.flatnonzero(~kept)) for kept in found.kept]
    assert dropped[2] == (7,)
    assert dropped[5] == (0, 9)
    assert sum(map(len, dropped)) == 3
    assert found.residuals_px[2][7] == pytest.approx([4.0, -3.0], abs=0.6)
    sd = np.sqrt(np.diag(clean.formula_covariance))
    assert (np.abs(numbers(found) - numbers(clean)) < sd).all()


def test_a_view_that_does_not_fit_is_named_and_left_out() -> None:
    views = seen(USUAL, 10, np.random.default_rng(9))
    wrong = replace(
        views[3], corners_px=views[3].corners_px[np.random.default_rng(0).permutation(54)]
    )
    found = calibrate([*views[:3], wrong, *views[4:]], "brown5")
    assert [view.source for view in found.rejected] == ["view 3"]
    assert "of its corners fit" in found.rejected[0].reason
    np.testing.assert_allclose(found.camera.focal_px, USUAL.intrinsics[:2], rtol=3e-3)


def test_a_bowed_board_is_found_when_the_shape_is_released() -> None:
    views = seen(USUAL, 20, np.random.default_rng(10), bow_m=0.001)
    flat, free = calibrate(views, "brown5"), calibrate(views, "brown5", shape="free")
    assert free.rms_px < 0.5 * flat.rms_px
    rise = free.p_board[:, 2] - board_points()[:, 2]
    bow_m = rise[22] - rise[[0, 8, 45, 53]].mean()  # the middle over the corners
    assert bow_m == pytest.approx(0.001, abs=5e-5)
    error, sd = numbers(free) - USUAL.intrinsics, np.sqrt(np.diag(free.camera.covariance))
    assert (np.abs(error) < 4 * sd).all()


@pytest.mark.parametrize("free", [False, True])
def test_at_the_solution_all_gradients_cancel(free: bool) -> None:
    """With the pull of the maker's places, which leaving views out counts on."""
    sightings = gather(seen(USUAL, 12, np.random.default_rng(12), bow_m=0.001))
    fit = fit_flat(sightings, Wanted("brown5"), robust=True)
    fit = release_shape(fit, sightings, robust=True) if free else fit
    linear = linearise(fit.bundle, fit.seen, fit.freedom)
    information, gradient = information_of_all(fit, linear)
    assert np.abs(gradient / np.sqrt(np.diag(information))).max() < 5e-3

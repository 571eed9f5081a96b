"""Corners fitted again where a camera tells how their edges bend."""

from dataclasses import replace

import cv2
import numpy as np
import pytest
from rendered_boards import Picture, picture

from tagmetry.calibrate.targets import (
    BoardFindings,
    Edges,
    explain_board,
    predicted_edges,
    refitted,
)
from tagmetry.calibrate.targets.patches import cut_out
from tagmetry.calibrate.targets.saddles import fit_saddles
from tagmetry.camera import BrownLens, Camera
from tagmetry.files.board_text import parse_board
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation

BOARDS = {
    "chessboard": (parse_board("chessboard:9x6:25mm"), 0.025),
    "charuco": (parse_board("charuco:7x5:30mm:18mm:5x5_100"), 0.03),
    "aprilgrid": (parse_board("aprilgrid:4x3:60mm:0.3"), 0.06),
}
CHESSBOARD = BOARDS["chessboard"][0]
BENT = (-0.9, 1.5, 0.002, -0.001, -2.0)
T_TILTED = RigidTransform.from_components(
    [0.03, -0.02, 0.34], Rotation.from_euler("xyz", [205.0, 20.0, 12.0], degrees=True)
)


def shown_and_found(name: str, **look: float) -> tuple[Picture, BoardFindings]:
    shown = picture(BOARDS[name][0], coefficients=BENT, **look)
    return shown, explain_board(shown.pixels, BOARDS[name][0])


def edges_of(shown: Picture, found: BoardFindings, name: str) -> Edges:
    board, step_m = BOARDS[name]
    p_board = board.corners_m[found.result.points]
    return predicted_edges(shown.camera, shown.T_camera_board, p_board, step_m)


def curve_of(point_m: Array, along: Array) -> tuple[Array, float]:
    """Return an edge's slope and curvature by a fine polynomial through OpenCV's projections."""
    camera = Camera(640, 480, (400.0, 405.0), (321.0, 238.0), BrownLens(BENT))
    share = np.linspace(-0.2, 0.2, 41)
    p_camera = np.ascontiguousarray(T_TILTED.apply(point_m + share[:, None] * along))
    D, none = np.array(BENT), np.zeros(3)
    pixels = cv2.projectPoints(p_camera, none, none, camera.matrix, D)[0][:, 0]
    x, y = (np.polynomial.Polynomial.fit(share, column, 6) for column in pixels.T)
    (dx, dy), (ddx, ddy) = ([one.deriv(order)(0.0) for one in (x, y)] for order in (1, 2))
    return np.array([dx, dy]), (dx * ddy - dy * ddx) / np.hypot(dx, dy) ** 3


def test_predicted_edges_are_those_of_opencv_s_projection() -> None:
    camera = Camera(640, 480, (400.0, 405.0), (321.0, 238.0), BrownLens(BENT))
    corners_m = CHESSBOARD.corners_m[[0, 8, 30, 53]]
    edges = predicted_edges(camera, T_TILTED, corners_m, 0.025)
    for column, along in enumerate(0.025 * np.array([[1.0, 0, 0], [0, -1.0, 0]])):
        for row, corner_m in enumerate(corners_m):
            slope, bend = curve_of(corner_m, along)
            np.testing.assert_allclose(edges.steps_px[row, :, column], slope, rtol=5e-3, atol=0.02)
            assert edges.bends[row, column] == pytest.approx(bend, rel=0.03, abs=2e-5)


def test_through_a_pinhole_edges_are_straight() -> None:
    camera = Camera(640, 480, (400.0, 405.0), (321.0, 238.0))
    edges = predicted_edges(camera, T_TILTED, CHESSBOARD.corners_m, 0.025)
    np.testing.assert_allclose(edges.bends, 0.0, atol=1e-9)


@pytest.mark.parametrize("name", BOARDS)
def test_patches_tell_all_that_the_picture_does(name: str) -> None:
    shown, found = shown_and_found(name)
    edges = edges_of(shown, found, name)
    view, patches = found.result, found.patches
    along, down = np.moveaxis(edges.steps_px, -1, 0)
    window = (along, down, patches.half, patches.arm, edges.bends)
    whole = fit_saddles(shown.pixels, view.corners_px, *window)
    again = refitted(view, patches, edges)
    np.testing.assert_allclose(again.corners_px, whole.centres_px, atol=1e-6)
    np.testing.assert_allclose(again.covariances_px2, whole.covariances_px2, rtol=1e-6)


@pytest.mark.parametrize("name", BOARDS)
def test_corners_are_closer_to_the_truth_when_the_camera_is_known(name: str) -> None:
    errors_px = []
    for seed in range(3):
        shown, found = shown_and_found(name, seed=seed, axis_deg=90.0 * seed, noise=0.3)
        again = refitted(found.result, found.patches, edges_of(shown, found, name))
        errors_px.append([shown.errors_px(view) for view in (found.result, again)])
    first, second = (np.concatenate(column) for column in zip(*errors_px, strict=True))
    assert np.sqrt((second**2).mean()) < 1.02 * np.sqrt((first**2).mean())
    assert np.sqrt((second**2).mean()) < 0.004


def test_the_covariance_holds_along_every_direction() -> None:
    """Squares seen from the side: a corner is surer along one direction than along the other."""
    whitened, along_axes = [], []
    for seed in range(12):
        look = {"spacing_px": 40.0, "tilt_deg": 68.0, "axis_deg": 30.0, "noise": 4.0}
        shown, found = shown_and_found("chessboard", seed=seed, size_px=(640, 480), **look)
        view = refitted(found.result, found.patches, edges_of(shown, found, "chessboard"))
        values, vectors = np.linalg.eigh(view.covariances_px2)
        errors = np.einsum("nij,ni->nj", vectors, shown.errors_px(view))
        whitened.append(errors / np.sqrt(values))
        along_axes.append(errors / view.sd_px[:, None])
    by_matrix, by_number = (np.concatenate(rows).std(axis=0) for rows in (whitened, along_axes))
    np.testing.assert_allclose(by_matrix, 1.0, atol=0.1)
    assert by_number[0] < 0.85
    assert by_number[1] > 1.1


def test_what_cannot_be_fitted_stays_where_it_was() -> None:
    shown, found = shown_and_found("chessboard")
    edges = edges_of(shown, found, "chessboard")
    lost = np.where(np.arange(54) == 7, np.nan, 1.0)
    unseen = Edges(edges.steps_px * lost[:, None, None], edges.bends * lost[:, None])
    away = found.result.corners_px.copy()
    away[20] += [2.0, 1.0]
    view = replace(found.result, corners_px=away)
    again = refitted(view, found.patches, unseen)
    stayed = (again.corners_px == view.corners_px).all(axis=1)
    np.testing.assert_array_equal(np.flatnonzero(stayed), [7, 20])
    np.testing.assert_array_equal(again.covariances_px2[[7, 20]], view.covariances_px2[[7, 20]])


def test_patches_end_where_the_picture_does() -> None:
    grey = np.arange(30 * 40, dtype=np.uint16).reshape(30, 40).astype(np.uint8)
    steps_px = np.tile(24.0 * np.eye(2), (3, 1, 1))
    corners_px = np.array([[2.0, 3.0], [20.2, 15.4], [37.0, 28.0]])
    cut = cut_out(grey, corners_px, steps_px, 1 / 3, 1.0)
    for patch, (x, y) in zip(cut.pixels, cut.origins_px, strict=True):
        height, width = patch.shape
        np.testing.assert_array_equal(patch, grey[y : y + height, x : x + width])
    assert cut_out(grey, corners_px[:0], steps_px[:0], 1 / 3, 1.0) is None
    tiny = cut_out(grey[:5, :5], corners_px[:1], steps_px[:1], 1 / 3, 1.0)
    assert tiny.pixels.shape == (1, 5, 5)


def test_boards_without_crossings_have_no_patches() -> None:
    board = parse_board("grid:4x3:40mm:10mm:5x5_100")
    assert explain_board(picture(board).pixels, board).patches is None

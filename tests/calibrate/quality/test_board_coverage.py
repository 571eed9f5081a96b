"""Coverage: places, tilts and distances that are known beforehand."""

from dataclasses import replace

import numpy as np
import pytest
from opencv_calibrations import (
    BOARD,
    CAMERA,
    board_poses,
    calibration_of,
    simulated_views,
)

from tagmetry.calibrate.quality import Place, coverage, poses_at
from tagmetry.camera import BrownLens
from tagmetry.errors import InputError


@pytest.mark.parametrize("tilt_deg", [0.0, 20.0, 45.0])
@pytest.mark.parametrize("direction_deg", [0.0, 90.0, -135.0])
def test_a_place_is_where_and_how_it_says(tilt_deg: float, direction_deg: float) -> None:
    place = Place((400.0, 150.0), 0.5, tilt_deg, direction_deg)
    T = poses_at(CAMERA, [place])[0]
    np.testing.assert_allclose(CAMERA.project(T.translation), place.pixel, atol=1e-6)
    normal, sight = T.rotation.apply([0, 0, 1]), T.translation / np.linalg.norm(T.translation)
    assert np.degrees(np.arccos(-normal @ sight)) == pytest.approx(tilt_deg, abs=1e-6)
    assert np.linalg.norm(T.translation) == pytest.approx(0.5)
    if tilt_deg:
        aside = normal + sight * np.cos(np.radians(tilt_deg))
        side = np.degrees(np.arctan2(aside[1], aside[0]))
        assert side == pytest.approx(direction_deg, abs=8)  # seen along a slanted line of sight


def test_an_upright_target_has_its_top_up_in_the_picture() -> None:
    T = poses_at(CAMERA, [Place((100.0, 400.0), 0.5, 0.0)])[0]
    top, right = CAMERA.project(T.apply([[0, 0.01, 0], [0.01, 0, 0]]))
    assert top[1] < 400
    assert abs(top[0] - 100) < 2
    assert right[0] > 100


def test_refuses_a_place_that_the_lens_does_not_show() -> None:
    folding = replace(CAMERA, lens=BrownLens((-0.5, 0.0, 0.0, 0.0)))
    with pytest.raises(InputError, match=r"shows nothing at pixel \(100000.0, 0.0\)"):
        poses_at(folding, [Place((320.0, 240.0), 0.5), Place((1e5, 0.0), 0.5)])


def test_counts_what_was_seen() -> None:
    places = [Place((320.0, 240.0), 0.5, 10.0, 0.0), Place((200.0, 240.0), 0.8, 35.0, 90.0)]
    poses = poses_at(CAMERA, places)
    found = coverage(calibration_of(CAMERA, simulated_views(poses, 0.05, seed=1), poses))
    np.testing.assert_allclose(found.tilts_deg, [10, 35], atol=1e-5)
    np.testing.assert_allclose(found.tilt_directions_deg, [0, 90], atol=8)
    np.testing.assert_allclose(found.distances_m, [0.5, 0.8], atol=1e-9)
    assert found.cells.sum() == found.rings.sum() == 108
    assert found.cells[:, 7].sum() == 0
    assert 0 < found.share < 1
    far = max(
        np.linalg.norm(v.corners_px - [319.5, 239.5], axis=1).max()
        for v in simulated_views(poses, 0.05, seed=1)
    )
    assert found.farthest_share == pytest.approx(far / np.hypot(319.5, 239.5))


def test_a_cell_holds_what_lies_in_it() -> None:
    poses = board_poses(4, seed=0)
    calibration = calibration_of(CAMERA, simulated_views(poses, 0.05, seed=1), poses)
    pixels = np.concatenate([view.corners_px for view in calibration.views])
    cells = coverage(calibration, 4, 2).cells
    inside = (pixels[:, 0] < 159.5) & (pixels[:, 1] >= 239.5)
    assert cells[1, 0] == inside.sum()
    assert cells.shape == (2, 4)
    assert len(BOARD.corners_m) * 4 == cells.sum()


def test_refuses_no_cells() -> None:
    poses = board_poses(4, seed=0)
    calibration = calibration_of(CAMERA, simulated_views(poses, 0.05, seed=1), poses)
    with pytest.raises(InputError, match="at least one cell, got 8x0"):
        coverage(calibration, 8, 0)

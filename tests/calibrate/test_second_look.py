"""The second look at pictures of the widest lens of the study, and what it leaves alone."""

from itertools import islice

import numpy as np
import pytest
import rendered_study
from rendered_study import BOARD, STUDIED, camera_of, pictures

from tagmetry.calibrate import BoardView, calibrate, explain_board, look_again
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.targets import BoardFindings
from tagmetry.geometry import Array
from tagmetry.markers import GridBoard
from tagmetry.twin.optics import Sensor

VIEWS = 14


@pytest.fixture(scope="module")
def looked() -> tuple[list[BoardFindings], list[Array], Calibration]:
    """Return what pictures of little noise give, where corners truly are, and a first camera."""
    rng = np.random.default_rng(8)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rendered_study, "SENSOR", Sensor(full_well_e=500_000, read_noise_e=15))
        shown = list(islice(pictures(STUDIED["120 brown5"][0], rng), VIEWS))
    found = [(explain_board(one.pixels, BOARD), one.corners_px) for one in shown]
    kept = [(one, truth) for one, truth in found if isinstance(one.result, BoardView)]
    findings, truths = ([pair[k] for pair in kept] for k in (0, 1))
    return findings, truths, calibrate([one.result for one in findings], "brown5")


def worst_px(views: list[BoardView], truths: list[Array]) -> float:
    errors = [v.corners_px - t[v.points] for v, t in zip(views, truths, strict=True)]
    return float(np.quantile(np.linalg.norm(np.concatenate(errors), axis=1), 0.99))


def test_outermost_corners_behind_a_wide_lens_come_right(
    looked: tuple[list[BoardFindings], list[Array], Calibration],
) -> None:
    findings, truths, first = looked
    again = look_again(first, findings, BOARD)
    assert worst_px(list(again), truths) < 0.6 * worst_px(list(first.views), truths)
    truth = camera_of(STUDIED["120 brown5"][0])
    cameras = [first.camera, calibrate(again, "brown5").camera]
    grid = np.stack(np.meshgrid(np.linspace(20, 619, 9), np.linspace(20, 459, 7)), -1)
    rays = truth.unproject(grid.reshape(-1, 2))
    errors = [np.sqrt(((c.project(rays) - truth.project(rays)) ** 2).mean()) for c in cameras]
    assert errors[0] > 0.1
    assert errors[1] < 0.05


def test_views_without_patches_and_boards_without_crossings_stay_as_they_are(
    looked: tuple[list[BoardFindings], list[Array], Calibration],
) -> None:
    findings, _, first = looked
    again = look_again(first, findings[1::2], BOARD)
    for i, (before, after) in enumerate(zip(first.views, again, strict=True)):
        assert (before is after) == (i % 2 == 0)
    other = look_again(first, findings, GridBoard(4, 3, 0.04, 0.01))
    assert all(a is b for a, b in zip(first.views, other, strict=True))


def test_a_curvature_that_is_carried_to_the_border_is_doubted(
    looked: tuple[list[BoardFindings], list[Array], Calibration],
) -> None:
    """Without the doubt the mean square would be 3."""
    findings, truths, _ = looked
    squares = []
    for one, truth in zip(findings, truths, strict=True):
        errors = one.result.corners_px - truth[one.result.points]
        inverse = np.linalg.inv(one.result.covariances_px2)
        squares.append(np.einsum("ni,nij,nj->n", errors, inverse, errors) / 2)
    assert np.concatenate(squares).mean() < 2.0

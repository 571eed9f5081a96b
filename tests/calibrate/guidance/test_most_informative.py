"""The best few of many views: better than others, none twice, quick."""

from time import perf_counter

import numpy as np
import pytest
from opencv_calibrations import (
    BOARD,
    CAMERA,
    board_poses,
    calibration_of,
    real_views,
    simulated_views,
    solved_by_opencv,
)

from tagmetry.calibrate.guidance import most_informative
from tagmetry.calibrate.quality import Place, poses_at, projection_uncertainty
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform

POSES = board_poses(80, seed=3)
VIEWS = simulated_views(POSES, 0.15, seed=1)


def middling_px(chosen) -> float:
    """Root mean square over the image, of the true camera with such views."""
    rows = list(chosen)
    solved = calibration_of(CAMERA, [VIEWS[i] for i in rows], POSES[rows])
    return float(np.sqrt((projection_uncertainty(solved).sd_px ** 2).mean()))


def test_better_than_any_of_many_random_choices() -> None:
    rng = np.random.default_rng(0)
    best = middling_px(most_informative(VIEWS, 12))
    others = [middling_px(rng.choice(80, 12, replace=False)) for _ in range(40)]
    assert best < min(others)
    assert best < 0.6 * np.median(others)


def test_the_first_are_the_same_however_many_are_wanted() -> None:
    assert most_informative(VIEWS, 10)[:5] == most_informative(VIEWS, 5)


def test_a_video_of_a_board_at_rest_gives_each_place_once() -> None:
    rest = [view for view in VIEWS[:8] for _ in range(10)]
    chosen = most_informative(rest, 8)
    assert sorted(i // 10 for i in chosen) == list(range(8))
    assert len(most_informative(rest, 20)) == 8


def test_frontal_views_are_left() -> None:
    places = [Place((x, y), 0.5, 0.0) for x in (250.0, 320.0, 390.0) for y in (200.0, 280.0)]
    frontal = poses_at(CAMERA, places)
    poses = RigidTransform.concatenate([frontal, board_poses(8, seed=1)])
    chosen = most_informative(simulated_views(poses, 0.1, seed=1), 6)
    assert sum(i < 6 for i in chosen) <= 1


def test_hundreds_of_views_take_a_moment() -> None:
    views = simulated_views(RigidTransform.concatenate([POSES] * 5), 0.15, seed=2)
    begun = perf_counter()
    chosen = most_informative(views, 20)
    assert len(set(chosen)) == 20
    assert perf_counter() - begun < 10


def test_real_pictures_the_best_eight_are_nearly_as_good_as_all() -> None:
    views = real_views()
    few = solved_by_opencv([views[i] for i in most_informative(views, 8)], 4)
    every = solved_by_opencv(views, 4)
    assert projection_uncertainty(few).worst_px < 1.5 * projection_uncertainty(every).worst_px


def test_all_where_fewer_are_there() -> None:
    assert sorted(most_informative(VIEWS[:4], 10)) == [0, 1, 2, 3]
    assert most_informative(VIEWS[:1], 1) == (0,)
    assert len(BOARD.corners_m) == 54


@pytest.mark.parametrize(("views", "count"), [((), 3), (VIEWS[:3], 0)])
def test_refuses(views, count: int) -> None:
    with pytest.raises(InputError, match="at least one view and a count"):
        most_informative(views, count)

"""What is taken and what not, each with its reason."""

from dataclasses import replace

import numpy as np
import pytest
from opencv_calibrations import CAMERA, board_poses, simulated_views

from tagmetry.calibrate.guidance import GateLimits
from tagmetry.calibrate.guidance.gate import (
    distance_px,
    is_blurred,
    is_repeated,
    is_unsteady,
    median_motion_px,
)
from tagmetry.calibrate.targets import ViewQuality
from tagmetry.calibrate.view import BoardView
from tagmetry.errors import InputError

LIMITS = GateLimits(motion_px=0.5, pause_s=1.0, apart_share=0.03, blur_share=0.1)
VIEW, OTHER = simulated_views(board_poses(2, seed=0), 0.01, seed=0, camera=CAMERA)


def moved(by_px: float, view: BoardView = VIEW) -> BoardView:
    return replace(view, corners_px=view.corners_px + np.array([by_px, 0.0]))


def part(view: BoardView, chosen: slice) -> BoardView:
    fields = {
        n: getattr(view, n)[chosen] for n in ("points", "p_board", "corners_px", "covariances_px2")
    }
    return replace(view, **fields)


def quality(blur_px: float) -> ViewQuality:
    return ViewQuality(blur_px, blur_px, 0.0, 200.0, 30.0, touches_border=False)


def test_a_still_board_is_steady() -> None:
    assert is_unsteady(moved(0.4), VIEW, 0.1, LIMITS) is None


@pytest.mark.parametrize(
    ("view", "before", "passed_s", "reason"),
    [
        (moved(0.6), VIEW, 0.1, "moving: 0.6 px since the image before; hold still"),
        (VIEW, None, 0.0, "seen once; hold still for one more image"),
        (VIEW, VIEW, 5.0, "seen once; hold still for one more image"),
        (VIEW, VIEW, -1.0, "seen once; hold still for one more image"),
        (part(VIEW, slice(0, 20)), part(VIEW, slice(30, 54)), 0.1, "moving: inf px"),
    ],
    ids=["moved", "first", "long ago", "back in time", "nothing in common"],
)
def test_an_unsteady_board_is_said_to_be(view, before, passed_s: float, reason: str) -> None:
    assert is_unsteady(view, before, passed_s, LIMITS).startswith(reason)


def test_one_wild_corner_is_no_motion() -> None:
    wild = moved(0.0)
    wild.corners_px[0] += 20
    assert is_unsteady(wild, VIEW, 0.1, LIMITS) is None


def test_blur_is_measured_by_the_distance_of_corners() -> None:
    assert is_blurred(quality(2.9), LIMITS) is None
    assert is_blurred(None, LIMITS) is None
    assert "blurred by 3.1 px where corners are 30 px apart" in is_blurred(quality(3.1), LIMITS)


def test_a_view_that_is_there_already_is_named() -> None:
    assert is_repeated(VIEW, (), LIMITS) is None
    assert is_repeated(VIEW, (OTHER,), LIMITS) is None
    assert is_repeated(moved(25.0), (VIEW,), LIMITS) is None
    reason = is_repeated(moved(20.0), (OTHER, VIEW), LIMITS)
    assert reason.startswith("only 20 px from view 2, which is taken already")


def test_distances_are_of_common_corners() -> None:
    some = part(moved(3.0), slice(10, 20))
    assert median_motion_px(VIEW, some) == pytest.approx(3.0)
    assert distance_px(some, VIEW) == pytest.approx(3.0)
    assert np.isinf(distance_px(part(VIEW, slice(0, 5)), part(VIEW, slice(5, 9))))


def test_refuses_negative_limits() -> None:
    with pytest.raises(InputError, match=r"motion_px must not be negative, got -1.0"):
        GateLimits(motion_px=-1.0)
    with pytest.raises(InputError, match="pause_s must not be negative, got nan"):
        GateLimits(pause_s=np.nan)

"""A guided calibration of a made-up camera, held by a hand that misses a little."""

from dataclasses import replace

import numpy as np
import pytest
from opencv_calibrations import (
    BOARD,
    CAMERA,
    board_poses,
    simulated_views,
    solved_by_opencv,
    view_of,
)

from tagmetry.calibrate.guidance import Plan, Session
from tagmetry.calibrate.quality import projection_uncertainty
from tagmetry.calibrate.targets import ViewQuality
from tagmetry.calibrate.view import BoardView
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform, perturb_pose

SD_PX = 0.15
SIZE = (640, 480)
HAND = np.array([0.01] * 3 + [0.07] * 3)  # metres and radians


def quick(views):
    return solved_by_opencv(views, 5)


def plan(**words) -> Plan:
    return Plan(BOARD, SIZE, solve=quick, **words)


def held(session: Session, rng: np.random.Generator) -> BoardView:
    """Return what a person shows who is asked for the next view."""
    while True:
        T = perturb_pose(session.next.T_camera_board, rng.normal(0, 1, 6) * HAND)
        pixels = CAMERA.project(T.apply(BOARD.corners_m))
        if CAMERA.contains(pixels).all():
            return view_of(pixels + rng.normal(0, SD_PX, pixels.shape), SIZE, SD_PX)


def twice(session: Session, view: BoardView, at_s: float) -> Session:
    return session.step(view, at_s).step(view, at_s + 0.1)


def guided(session: Session, most: int, seed: int = 0) -> Session:
    rng = np.random.default_rng(seed)
    for i in range(most):
        session = twice(session, held(session, rng), 10.0 * i)
        if session.finished:
            break
    return session


def test_reaches_what_was_asked_for_with_fewer_views_than_random_ones() -> None:
    session = guided(Session.begin(plan(wanted_px=0.5, least_views=6)), 20)
    assert session.finished.startswith("reached: 0.")
    assert session.uncertainty_px[-1] <= 0.5
    twice_as_many = 2 * len(session.taken)
    for seed in range(3):
        views = simulated_views(board_poses(twice_as_many, seed=seed), SD_PX, seed=seed)
        assert projection_uncertainty(quick(views), 9, 7).worst_px > 0.6


def test_the_camera_it_ends_with_is_the_true_one() -> None:
    session = guided(Session.begin(plan()), 9)
    camera = session.calibration.camera
    assert abs(camera.focal_px[0] - CAMERA.focal_px[0]) < 4 * np.sqrt(camera.covariance[0, 0])
    assert abs(camera.center_px[0] - CAMERA.center_px[0]) < 4 * np.sqrt(camera.covariance[2, 2])


def test_the_same_pictures_lead_to_the_same_state() -> None:
    once, again = (guided(Session.begin(plan()), 4, seed=3) for _ in range(2))
    np.testing.assert_allclose(once.uncertainty_px, again.uncertainty_px, rtol=1e-5)
    assert once.next.text == again.next.text


def test_says_what_became_of_each_view() -> None:
    start = Session.begin(plan())
    view = held(start, np.random.default_rng(0))
    assert start.outcome.reason == "no picture yet"
    first = start.step(view, 0.0)
    assert (first.outcome.taken, first.outcome.reason) == (
        False,
        "seen once; hold still for one more image",
    )
    second = first.step(view, 0.1)
    assert second.outcome.taken
    assert second.taken == (view,)
    third = second.step(view, 0.2)
    assert third.outcome.reason.startswith("only 0 px from view 1")
    assert third.taken == second.taken
    lost = third.step("no board", 0.3)
    assert lost.outcome.reason == "no board"
    assert lost.step(view, 0.4).outcome.reason.startswith("seen once")
    assert start.taken == ()


def test_blurred_views_are_not_taken() -> None:
    start = Session.begin(plan())
    view = held(start, np.random.default_rng(0))
    soft = ViewQuality(5.0, 5.0, 0.0, 200.0, 30.0, touches_border=False)
    assert "blurred by 5.0 px" in start.step(view, 0.0).step(view, 0.1, soft).outcome.reason


def test_coverage_counts_the_corners_taken() -> None:
    session = guided(Session.begin(plan()), 4)
    assert session.coverage.shape == (6, 8)
    assert session.coverage.sum() == 54 * len(session.taken)
    assert Session.begin(plan()).coverage.sum() == 0


def test_views_that_determine_no_camera_do_no_harm() -> None:
    def refuse(views):
        raise InputError("not yet")

    session = guided(Session.begin(Plan(BOARD, SIZE, solve=refuse)), 5)
    assert session.calibration is None
    assert session.finished is None
    assert len(session.taken) >= 4
    assert session.uncertainty_px[-1] < session.uncertainty_px[0]


def test_ends_when_views_hardly_help_or_are_too_many() -> None:
    many = guided(Session.begin(plan(wanted_px=1e-3, most_views=6, least_views=3)), 8)
    assert many.finished.startswith("6 views taken: ")
    stalled = replace(many, plan=plan(wanted_px=1e-3, least_views=3), uncertainty_px=(1.0,) * 6)
    assert stalled.finished == "1.00 px: the last 5 views hardly helped"
    falling = replace(stalled, uncertainty_px=(1.0, 0.9, 0.8, 0.7, 0.6, 0.5))
    assert falling.finished is None


def test_refuses_pictures_of_another_size() -> None:
    view = replace(held(Session.begin(plan()), np.random.default_rng(0)), width_px=800)
    with pytest.raises(InputError, match="expected pictures of 640x480, got 800x480"):
        Session.begin(plan()).step(view, 0.0)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"wanted_px": 0.0}, "wanted_px must be positive, got 0.0"),
        ({"least_views": 2}, "3 <= least_views <= most_views, got 2 and 60"),
        ({"most_views": 5}, "3 <= least_views <= most_views, got 10 and 5"),
    ],
)
def test_refuses_plans(words: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        plan(**words)


def test_the_solver_of_the_package_guides_as_well() -> None:
    session = guided(Session.begin(Plan(BOARD, SIZE)), 4)
    assert session.calibration is not None
    assert isinstance(session.next.T_camera_board, RigidTransform)

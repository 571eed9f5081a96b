"""The tracker meets markers however they move, and finds new ones in the images it states."""

import numpy as np
import pytest
from moving_markers import (
    CAMERA,
    STEP_S,
    Shown,
    along,
    error_px,
    ids,
    image,
    small_tracker,
    smeared,
    tracked,
)

from tagmetry.detect import Detector, Tracker
from tagmetry.detect.candidates import Candidates
from tagmetry.twin import Look


def test_the_first_image_gives_what_the_detector_gives() -> None:
    shown = [Shown(3, 80, 70), Shown(5, 230, 150, side_px=60), Shown(5, 90, 180)]
    pixels, detector = image(shown), Detector(min_side_px=16)
    for by_tracker, by_detector in zip(
        Tracker(detector).track(pixels, 0.0), detector.detect(pixels), strict=True
    ):
        assert by_tracker.id == by_detector.id
        assert by_tracker.is_duplicate == by_detector.is_duplicate == (by_tracker.id == 5)
        np.testing.assert_allclose(by_tracker.corners_px, by_detector.corners_px, atol=0.02)


@pytest.mark.parametrize(
    ("first", "per_image"),
    [
        pytest.param(Shown(7, 60, 120), {}, id="at rest"),
        pytest.param(Shown(7, 50, 60), {"x_px": 30.0, "y_px": 12.0}, id="30 px per image"),
        pytest.param(Shown(7, 150, 120), {"turn_deg": 25.0}, id="turning"),
        pytest.param(Shown(7, 150, 120, side_px=30), {"side_px": 9.0}, id="coming closer"),
        pytest.param(Shown(7, 150, 120, tilt_deg=-30), {"tilt_deg": 9.0}, id="tilting"),
        pytest.param(Shown(7, 60, 100, side_px=20), {"x_px": 12.0, "turn_deg": 5.0}, id="small"),
    ],
)
def test_a_moving_marker_is_seen_in_every_image(first: Shown, per_image: dict[str, float]) -> None:
    path = list(along(first, 7, **per_image))
    for found, shown in zip(tracked(small_tracker(), [[one] for one in path]), path, strict=True):
        assert ids(found) == [7]
        assert error_px(found, shown) < 0.08


def test_a_marker_that_speeds_up_and_stops_is_seen_in_every_image() -> None:
    places = [60, 60, 63, 72, 87, 108, 129, 129, 129, 114]
    path = [Shown(7, x_px, 120) for x_px in places]
    for found, shown in zip(tracked(small_tracker(), [[one] for one in path]), path, strict=True):
        assert error_px(found, shown) < 0.08


def test_a_known_motion_needs_no_search(monkeypatch: pytest.MonkeyPatch) -> None:
    tracker = small_tracker()
    path = list(along(Shown(7, 50, 100), 7, x_px=25.0))
    tracked(tracker, [[one] for one in path[:3]])
    monkeypatch.setattr(tracker._search, "found", lambda *_: Candidates.none())
    for k in range(3, 7):
        found = tracker.track(image([path[k]], seed=k), k * STEP_S)
        assert error_px(found, path[k]) < 0.08


def test_uneven_times_do_not_disturb_it(monkeypatch: pytest.MonkeyPatch) -> None:
    times = [0.0, 1.0, 3.0, 3.5, 6.0]
    tracker = small_tracker()
    for k, at in enumerate(times):
        shown = Shown(7, 50 + 30 * at, 120)
        found = tracker.track(image([shown], seed=k), at * STEP_S)
        assert error_px(found, shown) < 0.08
        if k == 1:
            monkeypatch.setattr(tracker._search, "found", lambda *_: Candidates.none())


@pytest.mark.parametrize(("smear_px", "limit_px"), [(4.0, 0.1), (8.0, 0.4), (12.0, 3.0)])
def test_a_marker_keeps_its_id_in_motion_blur(smear_px: float, limit_px: float) -> None:
    tracker, speed_px_s = small_tracker(), 30 / STEP_S
    for k in range(6):
        shown = Shown(7, 60 + 30 * k, 120, side_px=56)
        exposure_s = smear_px / speed_px_s if k >= 3 else 0.001
        found = tracker.track(smeared(shown, (speed_px_s, 0.0), exposure_s), k * STEP_S)
        assert ids(found) == [7]
        assert error_px(found, shown) < limit_px


@pytest.mark.parametrize("side_px", [17.0, 30.0, 44.0, 90.0, 140.0])
def test_new_markers_are_found_within_the_stated_images(side_px: float) -> None:
    tracker = small_tracker(strips=4, acquire_s=STEP_S)
    bound = tracker.images_to_acquire(*CAMERA.size_px)
    tracker.track(image([]), 0.0)
    for place in ([100, 110], [220, 130], [160, 120]):
        shown = [Shown(3, *place, side_px=side_px, turn_deg=45)]
        times = tracker._time_s + STEP_S * np.arange(1, bound + 1)
        assert [3] in [ids(tracker.track(image(shown), time_s)) for time_s in times]
        tracker.reset()
        tracker.track(image([]), times[-1] + 1.0)


@pytest.mark.parametrize("side_px", [18.0, 30.0, 90.0])
def test_new_markers_are_found_within_the_stated_time(side_px: float) -> None:
    empty, rng = image([]), np.random.default_rng(4)
    for appears in range(3, 120, 9):
        shown = image([Shown(3, *rng.uniform([70, 70], [250, 170]), side_px=side_px)])
        tracker = small_tracker(strips=4, acquire_s=0.3)
        found = [
            tracker.track(empty if k < appears else shown, k / 100) for k in range(appears + 30)
        ]
        assert ids(found[-1]) == [3]


def test_fewer_strips_find_new_markers_sooner() -> None:
    few, many = Tracker(strips=4), Tracker(strips=16)
    assert few.images_to_acquire(1920, 1080) < many.images_to_acquire(1920, 1080) <= 21


def test_a_lost_marker_is_found_where_it_went_on() -> None:
    tracker = small_tracker(strips=8)
    path = list(along(Shown(7, 40, 120), 9, x_px=25.0))
    hidden = [[] if 3 <= k < 6 else [one] for k, one in enumerate(path)]
    found = tracked(tracker, hidden)
    assert [ids(one) for one in found] == [[7]] * 3 + [[]] * 3 + [[7]] * 3


def test_whoever_was_seen_once_is_found_again_within_the_speed_allowed() -> None:
    tracker = small_tracker(strips=8, fastest_px_s=1500.0)
    found = tracked(tracker, [[Shown(7, 80, 120)], [Shown(7, 125, 110)]])
    assert ids(found[1]) == [7]


@pytest.mark.parametrize("noise", [1.0, 8.0])
def test_inverted_and_noisy_markers_are_followed(noise: float) -> None:
    look = Look(black=210.0, white=30.0, background=90.0, noise=noise)
    tracker = Tracker(Detector(min_side_px=16, inverted=True))
    found = tracked(tracker, [[one] for one in along(Shown(9, 80, 120), 5, x_px=8.0)], look)
    assert [[(d.id, d.is_inverted) for d in one] for one in found] == [[(9, True)]] * 5


def test_markers_of_several_families_are_followed() -> None:
    families = ["tag36h11", "4x4_50", "tag25h9", "tagStandard41h12"]
    tracker = Tracker(Detector(families, min_side_px=16))
    for k in range(4):
        shown = [Shown(2, 50 + 70 * n + 3 * k, 120, family=name) for n, name in enumerate(families)]
        found = tracker.track(image(shown, seed=k), k * STEP_S)
        assert sorted(one.family for one in found) == sorted(families)
        assert max(error_px(found, one) for one in shown) < 0.1

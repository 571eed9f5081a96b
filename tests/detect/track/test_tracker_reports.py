"""What the tracker reports was seen in that image, and measured in it alone."""

import cv2
import numpy as np
import pytest
from moving_markers import CAMERA, STEP_S, Shown, ids, image, small_tracker, tracked

from tagmetry.detect import Detector, Tracker
from tagmetry.errors import InputError
from tagmetry.twin import Look

AT_REST = [Shown(3, 80, 70), Shown(5, 230, 150)]


def steady_tracker(**wanted: object) -> Tracker:
    """Return a tracker that knows `AT_REST` from four images."""
    tracker = small_tracker(**wanted)
    tracked(tracker, [AT_REST] * 4)
    return tracker


def next_ids(tracker: Tracker, pixels: np.ndarray) -> list[int]:
    return ids(tracker.track(pixels, tracker._time_s + STEP_S))


def test_a_vanished_marker_is_not_reported_but_lost() -> None:
    tracker = steady_tracker()
    assert next_ids(tracker, image(AT_REST[1:])) == [5]
    (lost,) = tracker.lost
    assert (lost.family, lost.id) == ("tag36h11", 3)
    assert lost.age_s == pytest.approx(STEP_S)
    assert np.abs(lost.corners_px - AT_REST[0].corners_px()).max() < 0.5


def test_a_lost_marker_is_forgotten_after_the_stated_time() -> None:
    tracker = steady_tracker(forget_s=0.2)
    for _ in range(5):
        next_ids(tracker, image(AT_REST[1:]))
        assert ids(tracker.lost) == [3]
    for _ in range(2):
        next_ids(tracker, image(AT_REST[1:]))
    assert tracker.lost == ()


@pytest.mark.parametrize("grey", [30, 120, 210])
def test_a_covered_marker_is_not_reported(grey: int) -> None:
    tracker, pixels = steady_tracker(), image(AT_REST)
    pixels[45:95, 55:105] = grey
    assert next_ids(tracker, pixels) == [5]


def test_a_marker_whose_bits_are_covered_is_not_reported() -> None:
    tracker, pixels = steady_tracker(), image(AT_REST)
    pixels[55:85, 65:95] = 120
    assert next_ids(tracker, pixels) == [5]


def test_markers_that_exchange_places_keep_their_ids() -> None:
    tracker = steady_tracker()
    exchanged = [Shown(5, 80, 70), Shown(3, 230, 150)]
    found = tracker.track(image(exchanged), tracker._time_s + STEP_S)
    assert ids(found) == [3, 5]
    for one, shown in zip(found, reversed(exchanged), strict=True):
        np.testing.assert_allclose(one.corners_px, shown.corners_px(), atol=0.1)


@pytest.mark.parametrize("family", ["tag36h11", "4x4_50", "tag16h5"])
def test_a_marker_replaced_in_its_place_is_reported_as_the_other(family: str) -> None:
    tracker = Tracker(Detector([family], min_side_px=16))
    for other in range(1, 8):
        tracker.reset()
        tracked(tracker, [[Shown(0, 150, 120, family=family)]] * 3)
        assert next_ids(tracker, image([Shown(other, 150, 120, family=family)])) == [other]


@pytest.mark.parametrize("blur_px", [4.0, 6.0, 8.0])
def test_a_blurred_other_marker_is_not_taken_for_the_old_one(blur_px: float) -> None:
    for other in range(12):
        tracker = small_tracker()
        tracked(tracker, [[Shown(30, 150, 120, side_px=60)]] * 3)
        blurred = image([Shown(other, 150, 120, side_px=60)], look=Look(blur_px=blur_px))
        assert 30 not in next_ids(tracker, blurred)


def test_the_id_is_kept_where_blur_leaves_bits_unread() -> None:
    kept, detected = 0, 0
    for own in range(12):
        tracker = small_tracker()
        tracked(tracker, [[Shown(own, 150, 120, side_px=60)]] * 3)
        blurred = image([Shown(own, 150, 120, side_px=60)], look=Look(blur_px=5.0))
        found = tracker.track(blurred, tracker._time_s + STEP_S)
        assert ids(found) in ([], [own])
        kept += len(found)
        detected += len(Detector().detect(blurred))
    assert kept >= 10
    assert detected < kept


def test_an_empty_image_after_many_markers_gives_nothing() -> None:
    assert next_ids(steady_tracker(), np.full((240, 320), 120, np.uint8)) == []


def test_errors_do_not_reach_the_next_image() -> None:
    shown, tracker, count = Shown(7, 150.3, 120.4), small_tracker(), 60
    look = Look(noise=6.0)
    found = tracked(tracker, [[shown]] * count, look)
    errors = np.array([(one.corners_px - shown.corners_px()).ravel() for (one,) in found])
    errors -= errors.mean(axis=0)
    lag = (errors[1:] * errors[:-1]).mean(axis=0) / errors.var(axis=0)
    assert abs(lag.mean()) < 3 / np.sqrt(4 * count)  # eight coordinates, half of them alone


def test_the_covariance_holds_for_tracked_corners() -> None:
    tracker, distances2 = small_tracker(), []
    for k in range(60):
        shown = Shown(7, 60 + 2.3 * k, 110 + 0.4 * k, turn_deg=4.0 * k, tilt_deg=20)
        (one,) = tracker.track(image([shown], k, Look(noise=5.0)), k * STEP_S)
        error = (one.corners_px - shown.corners_px()).ravel()
        distances2.append(error @ np.linalg.solve(one.corners_cov_px2, error))
    assert 6.5 < np.mean(distances2) < 9.5


def test_duplicates_are_followed_and_flagged() -> None:
    shown = [Shown(3, 80, 70), Shown(3, 230, 150)]
    for found in tracked(small_tracker(), [shown] * 3):
        assert [(one.id, one.is_duplicate) for one in found] == [(3, True)] * 2
    assert found[0].corners_px[0, 0] < found[1].corners_px[0, 0]


def test_colour_is_followed_as_grey_is() -> None:
    rng, by_grey, by_colour = np.random.default_rng(0), small_tracker(), small_tracker()
    for k in range(6):
        grey = image([Shown(3, 80 + 9 * k, 70), Shown(5, 230, 150)], k)
        colour = np.repeat(grey[:, :, None], 3, axis=2)
        colour[..., 0] = np.clip(colour[..., 0] + rng.normal(0, 4, grey.shape), 0, 255)
        grey = cv2.cvtColor(colour, cv2.COLOR_BGR2GRAY)
        for one, other in zip(
            by_grey.track(grey, float(k)), by_colour.track(colour, float(k)), strict=True
        ):
            np.testing.assert_allclose(one.corners_px, other.corners_px, atol=1e-3)


@pytest.mark.parametrize(
    "changed",
    [
        lambda pixels: pixels.astype(np.uint16) * 200,
        np.asfortranarray,
        lambda pixels: np.repeat(pixels[:, :, None], 4, axis=2),
        lambda pixels: pixels[:, :, None],
    ],
)
def test_any_image_a_detector_takes_is_tracked(changed: object) -> None:
    tracker = small_tracker()
    for k in range(3):
        assert ids(tracker.track(changed(image(AT_REST, k)), k * STEP_S)) == [3, 5]


def test_the_images_are_not_changed() -> None:
    pixels = image(AT_REST)
    before = pixels.copy()
    pixels.flags.writeable = False
    next_ids(steady_tracker(), pixels)
    assert (pixels == before).all()


def test_an_announced_marker_is_found_at_once() -> None:
    tracker = small_tracker(strips=8)
    tracked(tracker, [[], []])
    shown = Shown(9, 250, 190)
    tracker.expect("tag36h11", 9, shown.corners_px() + 3.0, 2.0)
    found = tracker.track(image([shown]), tracker._time_s + STEP_S)
    assert ids(found) == [9]
    np.testing.assert_allclose(found[0].corners_px, shown.corners_px(), atol=0.08)


def test_an_announced_marker_that_is_not_there_is_not_reported() -> None:
    tracker = steady_tracker()
    tracker.expect("tag36h11", 9, AT_REST[0].corners_px(), 2.0)
    assert next_ids(tracker, image(AT_REST)) == [3, 5]
    assert tracker.lost == ()


def test_another_size_begins_anew() -> None:
    tracker = steady_tracker()
    wide = np.pad(image([Shown(8, 60, 200)]), [(0, 16), (0, 0)], mode="edge")
    assert next_ids(tracker, wide) == [8]
    assert tracker.lost == ()


def test_a_long_gap_begins_anew() -> None:
    tracker = steady_tracker(forget_s=0.5)
    found = tracker.track(image([Shown(8, 60, 200), Shown(9, 250, 60)]), tracker._time_s + 0.6)
    assert ids(found) == [8, 9]


@pytest.mark.parametrize("time_s", [1.0, 0.5, -3.0])
def test_time_must_rise(time_s: float) -> None:
    tracker = small_tracker()
    tracker.track(image(AT_REST), 1.0)
    with pytest.raises(InputError, match=r"time_s must rise .* got .* after 1\.0; call reset"):
        tracker.track(image(AT_REST), time_s)
    assert ids(tracker.track(image(AT_REST), 1.1)) == [3, 5]
    tracker.reset()
    assert ids(tracker.track(image(AT_REST), time_s)) == [3, 5]


@pytest.mark.parametrize("time_s", [np.nan, np.inf])
def test_time_must_be_finite(time_s: float) -> None:
    with pytest.raises(InputError, match="time_s must be finite, got"):
        small_tracker().track(image(AT_REST), time_s)


@pytest.mark.parametrize(
    ("pixels", "reason"),
    [
        (np.zeros((1, 1), np.uint8), "too small to show a marker"),
        (np.zeros((0, 0), np.uint8), "too small to show a marker"),
        (np.zeros((240, 320)), "must hold uint8 or uint16"),
        ("photo.png", "must be a NumPy array"),
    ],
)
def test_no_image_is_refused(pixels: np.ndarray, reason: str) -> None:
    tracker = steady_tracker()
    with pytest.raises(InputError, match=reason):
        tracker.track(pixels, 9.0)
    assert next_ids(tracker, image(AT_REST)) == [3, 5]


def test_another_camera_s_size_is_refused() -> None:
    with pytest.raises(InputError, match="belong to 320x240 images, this one is 100x100"):
        small_tracker().track(np.zeros((100, 100), np.uint8), 0.0, CAMERA)


@pytest.mark.parametrize(
    ("wanted", "reason"),
    [
        ({"strips": 0}, "strips must be 1 or more, got 0"),
        ({"acquire_s": 0.0}, "acquire_s must be positive, got 0.0"),
        ({"forget_s": 0.0}, "forget_s must be positive, got 0.0"),
        ({"fastest_px_s": np.nan}, "fastest_px_s must be positive, got nan"),
    ],
)
def test_settings_that_make_no_sense_are_refused(wanted: dict[str, float], reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        Tracker(**wanted)


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("tag16h5", 0, np.zeros((4, 2)), 1.0), "tag16h5 is not looked for.* knows tag36h11"),
        (("tag36h11", 587, np.zeros((4, 2)), 1.0), "has ids 0 to 586, there is no id 587"),
        (("tag36h11", 5, np.zeros((2, 4)), 1.0), r"finite and of shape \(4, 2\)"),
        (("tag36h11", 5, np.full((4, 2), np.nan), 1.0), r"finite and of shape \(4, 2\)"),
        (("tag36h11", 5, np.zeros((4, 2)), 0.0), "deviation_px must be positive, got 0.0"),
    ],
)
def test_what_cannot_be_expected_is_refused(arguments: tuple, reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        small_tracker().expect(*arguments)


def test_expecting_nonsense_places_does_no_harm() -> None:
    tracker = steady_tracker()
    for corners_px in (np.zeros((4, 2)), AT_REST[0].corners_px() + 1e9, np.eye(4)[:, :2] * 1e-9):
        tracker.expect("tag36h11", 8, corners_px, 1e6)
    assert next_ids(tracker, image(AT_REST)) == [3, 5]

"""The parts of the tracker: motion, strips, grey by parts, what is read where it is expected."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from moving_markers import Shown, image

from tagmetry.detect.grey import grey_8bit
from tagmetry.detect.reading.decode import read
from tagmetry.detect.reading.nearest import nearest
from tagmetry.detect.reading.sample import new_room
from tagmetry.detect.track.greyed import Greyed, boxes_around
from tagmetry.detect.track.motion import moved, predicted
from tagmetry.detect.track.nudge import PROFILE_PLACES, new_bench, nudge
from tagmetry.detect.track.sight import look
from tagmetry.detect.track.strips import turns
from tagmetry.detect.track.tracks import Tracks
from tagmetry.markers import family
from tagmetry.twin import Look

SQUARE = np.array([[-20.0, -15.0], [22.0, -18.0], [19.0, 21.0], [-23.0, 17.0]])


def turned(time_s: float) -> np.ndarray:
    """Return a square that moves, turns and grows at constant rates."""
    z = (SQUARE - SQUARE.mean(axis=0)) @ [1, 1j] * np.exp((0.3 + 2.0j) * time_s)
    middle = np.array([100 + 300 * time_s, 80 - 50 * time_s])
    return np.stack([z.real, z.imag], axis=1) + middle


def tracks_of(*times_s: float) -> Tracks:
    """Return one marker as it is known after images at some times."""
    one = np.array([0])
    tracks = Tracks.begun(one, one, one > 0, turned(times_s[0])[None], times_s[0])
    for time_s in times_s[1:]:
        where = predicted(tracks, time_s, 1200.0)
        tracks = moved(tracks, where.corners_px, turned(time_s)[None], time_s)
    return tracks


def test_steady_motion_is_predicted_whatever_the_times() -> None:
    where = predicted(tracks_of(0.0, 0.05, 0.07), 0.31, 1200.0)
    np.testing.assert_allclose(where.corners_px[0], turned(0.31), atol=1e-9)


def test_what_was_seen_once_may_be_as_far_as_the_fastest_goes() -> None:
    where = predicted(tracks_of(0.0), 0.1, 1200.0)
    np.testing.assert_allclose(where.corners_px[0], turned(0.0))
    assert 3 * where.deviation_px[0] == pytest.approx(120.0, rel=0.01)


def test_doubt_grows_with_time_and_fades_with_good_predictions() -> None:
    once, often = tracks_of(0.0, 0.1), tracks_of(*np.arange(0.0, 1.0, 0.1))
    assert predicted(once, 0.2, 1.0).deviation_px < predicted(once, 0.4, 1.0).deviation_px
    assert predicted(often, 1.0, 1.0).deviation_px < 0.4 * predicted(once, 0.2, 1.0).deviation_px


@given(
    st.integers(60, 2000), st.floats(4, 60), st.integers(1, 40), st.floats(0, 1), st.floats(0, 1)
)
def test_every_place_and_size_has_its_turn(
    height_px: int, least_px: float, strips: int, place: float, size: float
) -> None:
    side_px = least_px + size * max(0.0, height_px / 1.42 - least_px)
    extent_px = min(1.415 * side_px, height_px)
    top = place * (height_px - extent_px)
    assert any(
        turn.top <= top and top + extent_px <= turn.bottom and turn.least_px <= side_px
        for turn in turns(height_px, least_px, strips)
    )


def test_a_turn_of_small_markers_is_a_small_part_of_the_image() -> None:
    plan = turns(1080, 16.0, 16)
    looked_at = [(turn.bottom - turn.top) * turn.scale**2 for turn in plan if turn.least_px < 32]
    assert max(looked_at) < 1080 / 7


@pytest.mark.parametrize("channels", [3, 4])
def test_grey_by_parts_is_grey(channels: int) -> None:
    pixels = np.random.default_rng(0).integers(0, 256, (90, 120, channels)).astype(np.uint8)
    greyed, whole = Greyed(pixels), grey_8bit(pixels)
    boxes = np.array([[5, 7, 40, 30], [60, 50, 120, 90]])
    part = greyed.look_at(boxes)
    for left, top, right, bottom in boxes:
        np.testing.assert_array_equal(part[top:bottom, left:right], whole[top:bottom, left:right])
    assert (part == 0).sum() > 0.5 * part.size
    np.testing.assert_array_equal(greyed.look_at(np.array([[0, 0, 120, 90]] * 2)), whole)


def test_boxes_stay_in_the_image() -> None:
    squares = np.stack([SQUARE + 50, SQUARE - 500, SQUARE * np.nan, SQUARE * 1e300])
    boxes = boxes_around(squares, np.full(4, 2.5), (100, 80))
    assert boxes[0].tolist() == [24, 29, 76, 75]
    assert (boxes >= 0).all()
    assert (boxes <= [100, 80, 100, 80]).all()


def nudged(grey: np.ndarray, square_px: np.ndarray, reach_px: float) -> np.ndarray:
    """Return a dark square moved onto the edges within reach, once."""
    moved = np.empty_like(square_px)
    nudge(grey, square_px, reach_px, 1.0, new_bench(new_room(PROFILE_PLACES)), moved)
    return moved


@pytest.mark.parametrize("shift_px", [0.0, 2.0, 4.0, 6.0])
def test_squares_are_moved_onto_the_edges(shift_px: float) -> None:
    for k in range(8):
        shown = Shown(k, 150, 120, side_px=50, turn_deg=17 * k)
        truth = shown.corners_px()
        off = shift_px * np.array([np.cos(k), np.sin(k)])
        found = nudged(image([shown]), truth + off, 9.0)
        assert np.abs(found - truth).max() < 1.5
        again = nudged(image([shown]), found, 3.0)
        assert np.abs(again - truth).max() < 0.4


def test_whatever_the_prediction_squares_come_to_lie_on_the_edges() -> None:
    shown = [
        Shown(k, 40 + 48 * k, 50 + 35 * (k % 5), side_px=36, turn_deg=31 * k) for k in range(6)
    ]
    grey, rng, ids = (
        image(shown, look=Look(noise=3.0)),
        np.random.default_rng(7),
        np.arange(240) % 6,
    )
    truth = np.stack([shown[k].corners_px() for k in ids])
    predicted_px = truth + rng.uniform(-3, 3, (240, 1, 2)) + rng.normal(0, 0.5, truth.shape)
    found = look(grey, family("tag36h11"), ids, predicted_px, np.full(240, 3.0), ids < 0)
    off_px = np.abs(found.corners_px - truth).max(axis=(1, 2))
    assert off_px.max() < 1.6
    assert (off_px > 0.5).sum() <= 2


@pytest.mark.parametrize("name", ["tag36h11", "4x4_50", "7x7_50", "tag25h9"])
def test_markers_read_as_the_detector_reads_them(name: str) -> None:
    own, rng = family(name), np.random.default_rng(2)
    for k in range(6):
        shown = Shown(k, 150, 120, side_px=40, turn_deg=50 * k, family=name)
        grey, corners_px = image([shown], k, Look(noise=6.0)), shown.corners_px()[None]
        wrong = rng.choice(len(own.layout.bit_cells), k // 2, replace=False)
        _flip(grey, corners_px[0], own.layout.bit_centres[wrong])
        sights = look(grey, own, np.array([k]), corners_px, np.array([0.3]), np.array([False]))
        match = nearest(read(grey, sights.corners_px, own.layout)[0], own)
        assert sights.hamming[0] == match.hamming == k // 2
        assert sights.confidence[0] == pytest.approx(match.confidence, abs=0.12)


def _flip(grey: np.ndarray, corners_px: np.ndarray, at: np.ndarray) -> None:
    """Exchange black and white around places of a marker."""
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    H = cv2.getPerspectiveTransform(square, corners_px.astype(np.float32))
    for x, y in cv2.perspectiveTransform(at[None].astype(np.float64), H)[0] if len(at) else ():
        patch = grey[round(y) - 2 : round(y) + 3, round(x) - 2 : round(x) + 3]
        patch[...] = 210 if patch[2, 2] < 120 else 30


def test_markers_look_the_same_to_several_threads() -> None:
    shown = [Shown(k, 60 + 65 * k, 120, side_px=44, turn_deg=30 * k) for k in range(4)]
    rng, threads = np.random.default_rng(5), cv2.getNumThreads()
    ids = np.tile(np.arange(4), 25)
    corners_px = np.stack([shown[k].corners_px() for k in ids]) + rng.normal(0, 2, (100, 1, 2))
    asked = image(shown), family("tag36h11"), ids, corners_px, rng.uniform(0.3, 3, 100), ids < 0
    try:
        cv2.setNumThreads(3)
        shared = look(*asked)
    finally:
        cv2.setNumThreads(threads)
    alone = [look(*asked[:2], *(one[k : k + 1] for one in asked[2:])) for k in range(100)]
    for name in ("ids", "corners_px", "margins", "measures", "steps"):
        each = np.concatenate([getattr(one, name) for one in alone])
        np.testing.assert_allclose(getattr(shared, name), each, atol=1e-9)
    assert (shared.correlation > 0.9).mean() > 0.5


def test_nothing_is_read_in_a_plain_image() -> None:
    plain = np.full((240, 320), 90, np.uint8)
    corners_px = Shown(0, 150, 120).corners_px()[None]
    own = family("tag36h11")
    sights = look(plain, own, np.array([0]), corners_px, np.array([1.0]), np.array([False]))
    assert not sights.reads_as_expected(own.forgiven_bits).any()

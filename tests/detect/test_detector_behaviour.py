"""What holds of every picture: families, turns, formats, repeats, borders, refusals and time."""

import gc
import time
import tracemalloc
from concurrent.futures import ThreadPoolExecutor

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from rendered_markers import only, scene

from tagmetry.camera import Camera
from tagmetry.detect import Detection, Detector
from tagmetry.errors import InputError
from tagmetry.markers import family
from tagmetry.twin import Look

BORDER2 = family("tag36h11").with_border(2)


def board(*markers: tuple[str, int], cell_px: int = 8) -> np.ndarray:
    """Markers in a row on white paper, drawn cell by cell, slightly blurred."""
    tiles = []
    for name, marker_id in markers:
        cells = np.pad(family(name).picture(marker_id), 2, constant_values=True)
        tile = np.kron(cells, np.ones((cell_px, cell_px))) * 180 + 40
        tiles.append(np.pad(tile, [(0, 120 - len(tile)), (0, 0)], constant_values=220))
    return cv2.GaussianBlur(np.hstack(tiles).astype(np.uint8), (0, 0), 0.7)


def named(found: tuple[Detection, ...]) -> list[tuple[str, int]]:
    return [(d.family, d.id) for d in found]


MIXED = board(("tag36h11", 5), ("4x4_50", 3), ("6x6_250", 77), ("aruco_original", 45))
FAMILIES = ("tag36h11", "4x4_50", "6x6_250", "aruco_original")


def test_several_families_in_one_pass_are_the_union_of_single_passes() -> None:
    together = Detector(FAMILIES).detect(MIXED)
    apart = [d for name in FAMILIES for d in Detector([name]).detect(MIXED)]
    assert named(together) == sorted(named(tuple(apart)))
    assert len(together) == 4
    for a, b in zip(together, sorted(apart, key=lambda d: (d.family, d.id)), strict=True):
        np.testing.assert_allclose(a.corners_px, b.corners_px, atol=1e-6)


def test_a_marker_of_two_overlapping_families_is_found_once() -> None:
    picture = board(("4x4_50", 9))
    assert named(Detector(["4x4_50", "4x4_100"]).detect(picture)) == [("4x4_50", 9)]
    assert named(Detector(["4x4_100", "4x4_50"]).detect(picture)) == [("4x4_100", 9)]


def test_inverted_markers_are_found_only_when_asked_for() -> None:
    negative = 255 - board(("4x4_50", 9))
    assert Detector(["4x4_50"]).detect(negative) == ()
    found = only(Detector(["4x4_50"], inverted=True).detect(negative))
    upright = only(Detector(["4x4_50"]).detect(255 - negative))
    assert found.is_inverted
    assert not upright.is_inverted
    np.testing.assert_allclose(found.corners_px, upright.corners_px, atol=0.02)


def test_repeated_markers_are_flagged() -> None:
    found = Detector(["4x4_50"]).detect(board(("4x4_50", 9), ("4x4_50", 9), ("4x4_50", 4)))
    assert [(d.id, d.is_duplicate) for d in found] == [(4, False), (9, True), (9, True)]


def test_a_marker_at_the_picture_s_edge_is_flagged() -> None:
    picture = board(("tag36h11", 5))
    inner = only(Detector().detect(picture))
    assert not inner.touches_border
    left, top = np.rint(inner.corners_px.min(axis=0)).astype(int)
    for cut in (picture[:, left - 1 :], picture[top - 1 :]):
        assert all(d.touches_border for d in Detector().detect(np.ascontiguousarray(cut)))


@pytest.mark.parametrize("quarters", [1, 2, 3])
def test_turning_the_picture_turns_the_corners(quarters: int) -> None:
    """Not quite exactly: passes resize and rounds differ, and fits end within a thousandth."""
    shown = scene(np.random.default_rng(1), 50.0, tilt_deg=30.0)
    side_px = shown.grey.shape[0] - 1
    upright = only(Detector().detect(shown.grey))
    turned = only(Detector().detect(np.rot90(shown.grey, -quarters)))
    expected = upright.corners_px
    for _ in range(quarters):  # clockwise: x' = side - y, y' = x
        expected = np.stack([side_px - expected[:, 1], expected[:, 0]], axis=1)
    np.testing.assert_allclose(turned.corners_px, expected, atol=0.005)


def test_a_mirrored_print_is_no_marker() -> None:
    """Of the original ArUco markers some are others' mirror images: 45 reads as 480."""
    assert Detector(["tag36h11", "4x4_50", "6x6_250"]).detect(np.fliplr(MIXED)) == ()


def test_a_marker_within_a_marker() -> None:
    """A small one in a white cell of a large one: both are read."""
    cells = family("4x4_50").picture(0)
    large = np.pad(np.kron(cells, np.ones((80, 80))), 60, constant_values=1.0) * 180 + 40
    row, column = np.argwhere(cells)[0]
    tile = np.kron(family("tag36h11").picture(5), np.ones((5, 5))) * 180 + 40
    top, left = 60 + 80 * row + 20, 60 + 80 * column + 20
    large[top : top + 40, left : left + 40] = tile
    picture = cv2.GaussianBlur(large.astype(np.uint8), (0, 0), 0.7)
    assert named(Detector(["4x4_50", "tag36h11"]).detect(picture)) == [
        ("4x4_50", 0),
        ("tag36h11", 5),
    ]


def wide(*pieces: tuple[int, int, np.ndarray], ground: float = 200.0) -> np.ndarray:
    """An image of a megapixel, which is looked at in stages, with pieces at (x, y)."""
    picture = np.full((900, 1200), ground)
    for x, y, piece in pieces:
        picture[y : y + piece.shape[0], x : x + piece.shape[1]] = piece
    noise = np.random.default_rng(0).normal(0, 2, picture.shape)
    return np.clip(np.rint(picture + noise), 0, 255).astype(np.uint8)


def tile(marker_id: int, cell_px: int, quiet_cells: int = 1) -> np.ndarray:
    cells = np.pad(family("tag36h11").picture(marker_id), quiet_cells, constant_values=True)
    return cv2.GaussianBlur(np.kron(cells, np.ones((cell_px, cell_px))) * 170 + 40, (0, 0), 0.7)


def grid_with_dots(cell_px: int, overlap_px: int) -> np.ndarray:
    """Three by three markers with black squares between that reach into their corners."""
    side, gap = 8 * cell_px, 3 * cell_px
    sheet = np.full((4 * gap + 3 * side,) * 2, 210.0)
    for row, column in np.ndindex(3, 3):
        top, left = row * (side + gap) + gap, column * (side + gap) + gap
        picture = family("tag36h11").picture(3 * row + column)
        sheet[top : top + side, left : left + side] = np.kron(picture, np.ones((cell_px,) * 2))
    sheet = np.where(sheet <= 1, 170 * sheet + 40, sheet)
    for row, column in np.ndindex(4, 4):
        top, left = row * (side + gap), column * (side + gap)
        rows = slice(max(top - overlap_px, 0), top + gap + overlap_px)
        sheet[rows, max(left - overlap_px, 0) : left + gap + overlap_px] = 40
    return cv2.GaussianBlur(np.pad(sheet, 40, constant_values=210), (0, 0), 1.5)


@pytest.mark.parametrize(("cell_px", "overlap_px"), [(5, 0), (5, 1), (6, 2), (10, 2)])
def test_markers_that_touch_their_neighbours_are_found_beside_lone_ones(
    cell_px: int, overlap_px: int
) -> None:
    """A glance sees those of 40 px joined; as one that it sees has neighbours, it looks again."""
    grid = grid_with_dots(cell_px, overlap_px)
    picture = wide((50, 50, grid), (980, 700, tile(20, 9)), (1000, 500, tile(21, 4)))
    assert [d.id for d in Detector().detect(picture)] == [*range(9), 20, 21]


def test_a_marker_on_a_dark_ground_without_a_quiet_zone_is_not_seen() -> None:
    """What is as dark as the border has no edge with it; on any brighter ground it has."""
    no_zone = tile(5, 8, quiet_cells=0)
    assert Detector().detect(wide((500, 400, no_zone), ground=40.0)) == ()
    assert only(Detector().detect(wide((500, 400, no_zone), ground=120.0))).id == 5


@pytest.mark.parametrize("covered_cells", [0, 2, 4])
def test_dirt_on_the_bits_is_survived_up_to_what_the_code_corrects(covered_cells: int) -> None:
    marker = tile(5, 8)
    marker[24 : 24 + 8 * (covered_cells // 2), 24:40] = 210
    assert only(Detector(forgive_bits=5).detect(wide((500, 400, marker)))).id == 5


def test_a_covered_corner_moves_no_corner_by_much_or_the_marker_is_not_reported() -> None:
    """A sheet over a corner, larger and larger: no corner is ever invented."""
    corners = np.array([[8, 8], [72, 8], [72, 72], [8, 72]]) - 0.5 + np.array([500, 400])
    found = []
    for cover_px in range(0, 24, 3):
        marker = tile(5, 8)
        marker[: 8 + cover_px, : 8 + cover_px] = 210
        seen = Detector(forgive_bits=5).detect(wide((500, 400, marker)))
        found.append(len(seen))
        for detection in seen:
            np.testing.assert_allclose(detection.corners_px, corners, atol=1.0)
    assert found[:2] == [1, 1]
    assert found == sorted(found, reverse=True)


def test_one_detector_serves_four_threads_at_once() -> None:
    pictures = [wide((100 + 90 * k, 300, tile(k, 5 + k)), (700, 500, tile(9, 7))) for k in range(4)]
    detector = Detector()
    alone = [detector.detect(picture) for picture in pictures] * 3
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(detector.detect, pictures * 3))
    for a, b in zip(alone, together, strict=True):
        assert named(a) == named(b)
        assert len(a) == 2
        for one, other in zip(a, b, strict=True):
            np.testing.assert_array_equal(one.corners_px, other.corners_px)


def test_memory_is_the_same_after_many_images() -> None:
    """Two thousand small ones, by what Python and NumPy hold."""
    rng = np.random.default_rng(6)
    pictures = [rng.integers(0, 256, (40 + k, 60 + k), dtype=np.uint8) for k in range(20)]
    pictures.append(board(("tag36h11", 5), cell_px=4))
    detector = Detector()
    for picture in pictures:
        detector.detect(picture)
    tracemalloc.start()
    for k in range(2000):
        detector.detect(pictures[k % len(pictures)])
        if k == 200:
            gc.collect()
            before = tracemalloc.get_traced_memory()[0]
    gc.collect()
    after = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    assert after - before < 100_000


@pytest.mark.parametrize("dtype", [np.int8, np.int16, np.int32, np.uint32, np.int64, np.float16])
def test_other_numbers_than_a_camera_gives_are_refused(dtype: type) -> None:
    with pytest.raises(InputError, match="must hold uint8 or uint16 values"):
        Detector().detect(np.zeros((64, 64), dtype))


@settings(max_examples=25, deadline=None)
@given(
    picture=arrays(
        st.sampled_from([np.dtype(np.uint8), np.dtype(np.uint16)]),
        st.one_of(
            st.tuples(st.integers(0, 24), st.integers(0, 24)),
            st.tuples(st.integers(0, 12), st.integers(0, 12), st.integers(0, 5)),
        ),
    )
)
def test_arrays_of_any_shape_give_markers_or_words(picture: np.ndarray) -> None:
    for form in (picture, picture[::2, ::-1], picture.T):
        try:
            found = Detector(["4x4_50"]).detect(form)
        except InputError:
            continue
        assert all(np.isfinite(one.corners_px).all() for one in found)


def test_every_form_of_an_array_gives_the_same() -> None:
    grey = board(("tag36h11", 5))
    expected = only(Detector().detect(grey)).corners_px
    read_only = grey.copy()
    read_only.setflags(write=False)
    forms = {
        "again": grey,
        "one channel": grey[..., None],
        "BGR": np.dstack([grey] * 3),
        "BGRA": np.dstack([grey] * 4),
        "read-only": read_only,
        "not contiguous": np.repeat(grey, 2, axis=1)[:, ::2],
        "columns first": np.asfortranarray(grey),
        "reversed twice": np.ascontiguousarray(grey[::-1])[::-1],
    }
    for name, form in forms.items():
        kept = form.copy()
        found = only(Detector().detect(form))
        np.testing.assert_array_equal(found.corners_px, expected, err_msg=name)
        np.testing.assert_array_equal(form, kept, err_msg=f"{name} was changed")


def test_sixteen_bits_are_stretched() -> None:
    grey = board(("tag36h11", 5))
    found = only(Detector().detect(grey.astype(np.uint16) * 16))
    expected = only(Detector().detect(grey))
    np.testing.assert_allclose(found.corners_px, expected.corners_px, atol=0.02)


def test_results_are_in_order_and_repeat_exactly() -> None:
    first, second = Detector(FAMILIES).detect(MIXED), Detector(FAMILIES).detect(MIXED)
    assert named(first) == sorted(named(first))
    for a, b in zip(first, second, strict=True):
        np.testing.assert_array_equal(a.corners_px, b.corners_px)
        np.testing.assert_array_equal(a.corners_cov_px2, b.corners_cov_px2)


def test_what_is_turned_down_comes_with_its_reason() -> None:
    findings = Detector(["tag36h11"]).explain(board(("6x6_250", 77)))
    assert findings.detections == ()
    assert any("wrong bits" in r.reason for r in findings.rejections)
    inverted = Detector().explain(255 - board(("tag36h11", 5)))
    assert any("white on black" in r.reason for r in inverted.rejections)


def test_wrong_bits_are_forgiven_up_to_a_number() -> None:
    cells = np.pad(family("tag36h11").picture(5), 2, constant_values=True)
    for flipped in ((4, 4), (6, 7)):
        cells[flipped] ^= True
    picture = np.asarray(np.kron(cells, np.ones((8, 8))) * 180 + 40, dtype=np.uint8)
    assert only(Detector(forgive_bits=2).detect(picture)).hamming == 2
    assert only(Detector().detect(picture)).id == 5
    assert Detector(forgive_bits=1).detect(picture) == ()


def test_a_covariance_is_symmetric_and_positive() -> None:
    for found in Detector(FAMILIES).detect(MIXED):
        np.testing.assert_allclose(found.corners_cov_px2, found.corners_cov_px2.T, atol=1e-12)
        assert np.linalg.eigvalsh(found.corners_cov_px2).min() > 0


@pytest.mark.parametrize(
    ("image", "message"),
    [
        (np.zeros((1, 1), np.uint8), "1x1 pixels is too small"),
        (np.zeros((1, 640), np.uint8), "640x1 pixels is too small"),
        (np.zeros((0, 0), np.uint8), "too small"),
        (np.zeros((64, 64)), "must hold uint8 or uint16 values, got float64"),
        (np.full((64, 64), np.nan), "must hold uint8 or uint16"),
        (np.zeros((64, 64), bool), "got bool"),
        (np.zeros((2, 2, 2, 2, 2), np.uint8), "must have shape"),
        (np.zeros((64, 64, 2), np.uint8), "must have shape"),
        (np.zeros(64, np.uint8), "must have shape"),
        ([[0, 1], [1, 0]], "must be a NumPy array, got list"),
        (None, "must be a NumPy array, got NoneType"),
    ],
)
def test_no_image_is_refused_in_words(image: object, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Detector().detect(image)


def test_settings_are_refused_in_words() -> None:
    with pytest.raises(InputError, match="at least one marker family"):
        Detector([])
    with pytest.raises(InputError, match="tag36h12"):
        Detector(["tag36h12"])
    with pytest.raises(InputError, match="forgive_bits must be 0 or more, got -1"):
        Detector(forgive_bits=-1)
    for side_px in (0.0, np.nan, np.inf):
        with pytest.raises(InputError, match="min_side_px must be at least 4"):
            Detector(min_side_px=side_px)


def test_a_camera_of_another_size_is_refused() -> None:
    with pytest.raises(InputError, match="640"):
        Detector().detect(MIXED, Camera(640, 480, (500.0, 500.0), (320.0, 240.0)))


@settings(max_examples=40)
@given(
    seed=st.integers(0, 2**32 - 1),
    height=st.integers(1, 90),
    width=st.integers(1, 90),
    kind=st.sampled_from(["noise", "two values", "stripes", "checks", "flat", "piece", "blocks"]),
)
def test_any_array_gives_markers_or_words(seed: int, height: int, width: int, kind: str) -> None:
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[:height, :width]
    pitch = int(rng.integers(1, 20))
    pictures = {
        "noise": rng.integers(0, 256, (height, width)),
        "two values": rng.integers(0, 2, (height, width)) * 255,
        "stripes": (x // pitch % 2) * 255,
        "checks": ((x // pitch + y // pitch) % 2) * 255,
        "flat": np.full((height, width), rng.integers(256)),
        "piece": MIXED[: min(height, 80), pitch : pitch + width],
        "blocks": np.kron(rng.integers(0, 2, (20, 20)), np.ones((9, 9)))[:height, :width] * 255,
    }
    picture = np.asarray(pictures[kind], dtype=np.uint8)
    detector = Detector(["tag36h11", "4x4_50", BORDER2], inverted=True, min_side_px=4.0)
    try:
        found = detector.explain(picture).detections
    except InputError:
        assert min(picture.shape) < 8
        return
    for detection in found:
        assert np.isfinite(detection.corners_px).all()
        assert np.linalg.eigvalsh(detection.corners_cov_px2).min() > 0


def grid_of_squares(pitch_px: int) -> np.ndarray:
    picture = np.full((1080, 1920), 200, np.uint8)
    for offset in range(0, pitch_px, 2 * pitch_px // 3):
        picture[offset::pitch_px] = 30
        picture[:, offset::pitch_px] = 30
    return picture


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["flat", "noise", "squares", "blocks"])
def test_no_frame_stalls(kind: str) -> None:
    """Frames of 1080 lines; a loaded machine of two cores takes its time, a stall takes minutes."""
    rng = np.random.default_rng(2)
    blocks = np.kron(rng.integers(0, 2, (60, 107)), np.ones((18, 18)))[:1080, :1920] * 180 + 30
    picture = {
        "flat": np.full((1080, 1920), 120.0),
        "noise": 120 + rng.normal(0, 8, (1080, 1920)),
        "squares": grid_of_squares(24),
        "blocks": blocks,
    }[kind]
    start_s = time.process_time()
    Detector().detect(np.clip(picture, 0, 255).astype(np.uint8))
    assert time.process_time() - start_s < 8.0


def test_dim_and_flat_light_are_enough() -> None:
    """Forty grey values between black and white, light falling off by half across the marker."""
    shown = scene(np.random.default_rng(3), 60.0, look=Look(black=60.0, white=100.0, noise=1.0))
    fall_off = np.linspace(0.6, 1.2, shown.grey.shape[1])
    picture = np.asarray(shown.grey * fall_off, dtype=np.uint8)
    assert only(Detector().detect(picture)).id == 7


@pytest.mark.parametrize("marker_id", range(4))
def test_a_wide_border_is_not_taken_for_a_narrow_one(marker_id: int) -> None:
    """Its inner ring and its bits read well, but there is no edge where the corners would be."""
    shown = scene(
        np.random.default_rng(marker_id), 100.0, family="tag36h11_border2", marker_id=marker_id
    )
    for found in Detector(["tag36h11"]).detect(shown.grey):  # some still read, with wrong bits
        np.testing.assert_allclose(found.corners_px, shown.corners_px, atol=0.1)
        assert found.hamming > 0
    found = only(Detector(["tag36h11_border2"]).detect(shown.grey))
    np.testing.assert_allclose(found.corners_px, shown.corners_px, atol=0.1)


@pytest.mark.parametrize("marker_id", range(4))
def test_the_inside_of_a_wide_border_is_turned_down_where_bright_squares_count(
    marker_id: int,
) -> None:
    """`explain` and inverted markers look at bright squares as well; both must not fall for it."""
    shown = scene(
        np.random.default_rng(marker_id), 100.0, family="tag36h11_border2", marker_id=marker_id
    )
    findings = Detector(["tag36h11"]).explain(shown.grey)
    inverted_too = Detector(["tag36h11"], inverted=True).detect(shown.grey)
    for found in (*findings.detections, *inverted_too):
        np.testing.assert_allclose(found.corners_px, shown.corners_px, atol=0.1)

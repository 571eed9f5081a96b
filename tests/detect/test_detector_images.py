"""Every form of an image: what is no image is refused, nothing hostile crashes or stalls."""

import gc
import time
import tracemalloc
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from drawn_markers import board, named, tile, wide
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from rendered_markers import only

from tagmetry.camera import Camera
from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.markers import family

BORDER2 = family("tag36h11").with_border(2)

MIXED = board(("tag36h11", 5), ("4x4_50", 3), ("6x6_250", 77), ("aruco_original", 45))


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


def test_an_image_full_of_small_markers() -> None:
    """Cells of 3 px everywhere, so that every tile has dark and bright pixels, as noise has."""
    own = family("tag36h11")
    tiles = [np.pad(own.picture(n), 1, constant_values=True) for n in range(80)]
    cells = np.block([tiles[10 * row : 10 * row + 10] for row in range(8)])
    picture = np.where(cells, 220, 30).repeat(3, axis=0).repeat(3, axis=1).astype(np.uint8)
    found = Detector(min_side_px=20).detect(picture)
    assert named(found) == [(own.name, n) for n in range(80)]


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

"""Each kernel against the plain definition of what it computes, or OpenCV's own."""

import cv2
import numpy as np
import pytest

from tagmetry.detect.segment.corners import far_points, four_corners
from tagmetry.detect.segment.dark import columns_and_rows, dark_bits, row_shift, thinned
from tagmetry.detect.segment.distinct import distinct
from tagmetry.detect.segment.outline import at_level, box, crack_at, midway, steps, walk
from tagmetry.detect.segment.starts import starts
from tagmetry.detect.segment.tiles import Extremes, Tiles, noise_gate, tile_extremes

RNG = np.random.default_rng(0)
SIZES = [(4, 4), (5, 9), (8, 8), (31, 70), (48, 64)]


def bits_of(dark: np.ndarray) -> np.ndarray:
    """What is dark, as `dark_bits` gives it."""
    levels = np.full((-(-dark.shape[0] // 4), -(-dark.shape[1] // 4)), 128, np.uint8)
    return dark_bits(np.where(dark, 10, 200).astype(np.uint8), levels)


def unpacked(bits: np.ndarray) -> np.ndarray:
    """A byte for each bit, with the rim."""
    return np.unpackbits(bits, axis=1, bitorder="little")


@pytest.mark.parametrize("size", SIZES)
def test_tiles_know_their_darkest_and_brightest(size: tuple[int, int]) -> None:
    grey = RNG.integers(0, 256, size, dtype=np.uint8)
    darkest, brightest = tile_extremes(grey)
    for row, column in np.ndindex(darkest.shape):
        top, left = min(4 * row, size[0] - 4), 4 * column
        tile = grey[top : top + 4, left : left + 4]
        assert (darkest[row, column], brightest[row, column]) == (tile.min(), tile.max())


@pytest.mark.parametrize("noise", [4.0, 10.0])
def test_noise_alone_hardly_passes_the_gate(noise: float) -> None:
    grey = np.rint(128 + RNG.normal(0, noise, (400, 400))).astype(np.uint8)
    own = Extremes(*tile_extremes(grey))
    gate = noise_gate(own)
    assert Tiles.of(grey).gate == gate
    assert (own.around(3).ranges >= gate).mean() < 0.02
    assert gate < 9 * noise  # and a marker of ten times the noise does


@pytest.mark.parametrize("size", [*SIZES, (7, 62), (7, 63)])
def test_dark_is_what_lies_below_the_levels(size: tuple[int, int]) -> None:
    grey = RNG.integers(0, 256, size, dtype=np.uint8)
    levels = RNG.integers(0, 256, (-(-size[0] // 4), -(-size[1] // 4)), dtype=np.uint8)
    bits = dark_bits(grey, levels)
    expected = grey < np.kron(levels, np.ones((4, 4), np.uint8))[: size[0], : size[1]]
    mask = unpacked(bits)
    np.testing.assert_array_equal(mask[1 : size[0] + 1, 1 : size[1] + 1], expected)
    assert mask.sum() == expected.sum()
    assert mask.shape[1] == 2 ** row_shift(bits)


@pytest.mark.parametrize("size", [*SIZES, (70, 200)])
def test_thinned_is_what_opencv_erodes(size: tuple[int, int]) -> None:
    bits = bits_of(RNG.random(size) < 0.9)
    expected = cv2.erode(unpacked(bits), np.ones((3, 3), np.uint8))
    np.testing.assert_array_equal(unpacked(thinned(bits)), expected)


def beginnings(bits: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """All places where an outline may begin, whatever the grey values are."""
    grey = np.zeros(shape, np.uint8)
    return starts(bits, grey, tile_extremes(grey)[0], 0.5, 8 * bits.size)


def walk_on(bits: np.ndarray, start: np.uint64, cracks: np.ndarray) -> np.ndarray:
    """Walk on bits with rows, and return the outline's cracks; all that were written are in it."""
    row = 8 * bits.shape[1]
    ways = steps(row, 1), steps(row, -1)
    begin, end = walk(bits.reshape(-1), np.uint64(row), *ways, start, cracks)
    return cracks[begin:end]


def walked(dark: np.ndarray) -> tuple[list[np.ndarray], int]:
    """All outlines of what is dark as (column, row, side), and how many cracks were written."""
    outlines, count, bits = [], 0, bits_of(dark)
    nothing = np.uint64(2**64 - 1)
    for start in beginnings(bits, dark.shape):
        cracks = np.full(16 * bits.size, nothing)
        outline = walk_on(bits, start, cracks)
        count += np.count_nonzero(cracks != nothing)
        if len(outline):
            outlines.append(outline)
    return outlines, count


def middles(cracks: np.ndarray, dark: np.ndarray) -> np.ndarray:
    points = np.empty((len(cracks), 2))
    midway(cracks, row_shift(bits_of(dark)), 1, points)
    return points


def area(points: np.ndarray) -> float:
    """By the shoelace formula: positive where they go clockwise as seen."""
    x, y = points.T
    return 0.5 * float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())


def is_covered(mask: np.ndarray, row: int, column: int) -> bool:
    """Whether a run has a one above it, within eight pixels and a word of 64."""
    run = run_of(mask, row, column)
    return bool(mask[row - 1, run].any())


def is_borne(mask: np.ndarray, row: int, column: int) -> bool:
    """Whether a run has a one below it, within eight pixels, or may have in the next word."""
    run = run_of(mask, row, column)
    return bool(mask[row + 1, run].any()) or run.stop % 64 == 0


def run_of(mask: np.ndarray, row: int, column: int) -> slice:
    """The columns of a run, up to eight and within a word of 64."""
    end = column
    while end < min(column + 8, (column // 64 + 1) * 64) and mask[row, end]:
        end += 1
    return slice(column, end)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("size", [*SIZES, (9, 130)])
def test_outlines_may_begin_at_runs_of_dark_with_none_above_and_some_below(
    size: tuple[int, int], share: float
) -> None:
    bits = bits_of(RNG.random(size) < share)
    mask = unpacked(bits)
    rows, columns = np.nonzero((mask[1:, 1:] == 1) & (mask[1:, :-1] == 0))
    runs = np.stack([columns, rows], axis=1)
    first = [not is_covered(mask, y + 1, x + 1) and is_borne(mask, y + 1, x + 1) for x, y in runs]
    expected = runs[first]
    begins = columns_and_rows(beginnings(bits, size), bits)
    np.testing.assert_array_equal(begins, expected)


@pytest.mark.parametrize("least", [0, 99, 100, 101, 255])
def test_outlines_begin_where_the_image_steps_down(least: int) -> None:
    """A square and a faint ramp are dark; only the square's step is 100 grey values high."""
    grey = np.full((24, 48), 160, np.uint8)
    grey[8:18, 8:18] = 60
    grey[8:18, 30:40] = 125 - np.arange(10)[:, None]
    bits, ranges = bits_of(grey < 130), np.full((6, 12), 255, np.uint8)
    places = starts(bits, grey, ranges, (least + 0.5) / 255, 100)
    begins = columns_and_rows(places, bits).tolist()
    assert ([8, 8] in begins) == (least <= 100)
    assert ([30, 8] in begins) == (least == 0)


@pytest.mark.parametrize(("x", "y"), [(8, 7), (8, 5), (7, 8), (5, 8)])
def test_what_is_bright_within_three_pixels_above_or_left_counts(x: int, y: int) -> None:
    grey = np.full((24, 24), 100, np.uint8)
    grey[8:18, 8:18] = 60
    grey[y, x] = 240
    bits, ranges = bits_of(grey < 80), np.full((6, 6), 180, np.uint8)
    assert columns_and_rows(starts(bits, grey, ranges, 1.0, 9), bits).tolist() == [[8, 8]]
    assert len(starts(bits, grey, ranges + 1, 1.0, 9)) == 0


def test_no_more_starts_are_given_than_asked_for() -> None:
    bits = bits_of((np.indices((40, 20)) // np.array([2, 1])[:, None, None]).sum(axis=0) % 2 == 0)
    grey, ranges = np.zeros((40, 20), np.uint8), np.zeros((10, 5), np.uint8)
    assert len(starts(bits, grey, ranges, 0.5, 7)) == 7
    assert len(starts(bits, grey, ranges, 0.5, 10_000)) == 200


@pytest.mark.parametrize("share", [0.3, 0.5, 0.6, 0.7])
def test_one_outline_around_each_of_opencv_s_components(share: float) -> None:
    dark = RNG.random((60, 90)) < share
    count, labels = cv2.connectedComponents(dark.astype(np.uint8), connectivity=4)
    outlines, _ = walked(dark)
    outer = [cracks for cracks in outlines if area(middles(cracks, dark)) > 0]
    shift = row_shift(bits_of(dark))
    around = [{labels[y, x] for x, y, _ in (crack_at(c, shift) for c in own)} for own in outer]
    assert all(len(own) == 1 for own in around)
    of_rows = [k for k in range(1, count) if np.ptp(np.nonzero(labels == k)[0]) > 0]
    found = sorted(own.pop() for own in around)
    assert set(of_rows) <= set(found)  # what is one row high is no marker
    assert len(set(found)) == len(found)


@pytest.mark.parametrize("kind", ["noise", "comb", "ruler", "checks", "spiral"])
def test_n_cracks_are_walked_n_log_n_times_at_most(kind: str) -> None:
    """So the time is bounded by the number of pixels, whatever an image shows."""
    y, x = np.indices((64, 96))
    teeth = x // 4 + 1
    longer_teeth = np.log2(teeth & -teeth)  # every second, fourth, eighth is longer
    dark = {
        "noise": RNG.random((64, 96)) < 0.55,
        "comb": (x % 4 < 2) | (y > 60),
        "ruler": (x % 4 < 2) & (y > 50 - 10 * longer_teeth) | (y > 60),
        "checks": (x + y) % 2 == 0,
        "spiral": (np.hypot(x - 48, y - 32) + 1.3 * np.arctan2(y - 32, x - 48)) % 8 < 4,
    }[kind]
    inner = np.pad(dark, 1).astype(int)
    cracks = np.abs(np.diff(inner, axis=0)).sum() + np.abs(np.diff(inner, axis=1)).sum()
    _, steps = walked(dark)
    assert steps <= 0.5 * cracks * np.log2(cracks)


def test_an_outline_surrounds_its_component_clockwise() -> None:
    """Its area by the shoelace formula is the number of pixels where it runs along cracks."""
    dark = np.zeros((20, 30), dtype=bool)
    dark[3:12, 5:9] = dark[8:12, 5:20] = True
    dark[5:7, 6:8] = False  # a hole is not walked around
    (cracks,), _ = walked(dark)
    assert len(cracks) == 2 * (15 + 9)
    points = middles(cracks, dark)
    assert area(points) == pytest.approx(9 * 4 + 4 * 11, abs=3)  # the corners are cut
    assert box(cracks, row_shift(bits_of(dark))) == (15, 9)
    bits, short = bits_of(dark), np.empty(len(cracks) - 1, np.uint64)
    (start,) = beginnings(bits, dark.shape)[:1]
    assert len(walk_on(bits, start, short)) == 0
    few = np.empty((8, 2))
    midway(cracks, row_shift(bits), 6, few)
    np.testing.assert_array_equal(few, points[::6])


def test_an_outline_passes_between_pixels_where_the_level_does() -> None:
    x = np.arange(24.0)
    ramp = 200.0 - 160.0 / (1 + np.exp((x - 9.3) / 1.5))
    grey = np.tile(np.rint(np.where(x < 3, 200, ramp)).astype(np.uint8), (24, 1))
    grey[:4] = grey[-4:] = 200
    levels = np.full((6, 6), 120, np.uint8)
    (cracks,), _ = walked(grey < 120)
    points = np.empty((len(cracks), 2))
    at_level(cracks, row_shift(bits_of(grey < 120)), 1, grey, levels, points)
    right = points[(points[:, 0] > 8) & (points[:, 1] > 6) & (points[:, 1] < 17)]
    np.testing.assert_allclose(right[:, 0], 9.3, atol=0.05)


@pytest.mark.parametrize("turn_deg", [0, 10, 30, 45, 80])
@pytest.mark.parametrize("outset_px", [0.0, 1.0])
def test_corners_of_a_sampled_square(turn_deg: float, outset_px: float) -> None:
    angle = np.radians(turn_deg)
    R = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    square = np.array([[-20.0, -15], [20, -15], [20, 15], [-20, 15]])
    along = np.linspace(0, 1, 40, endpoint=False)[:, None]
    sides = [a + along * (b - a) for a, b in zip(square, np.roll(square, -1, axis=0), strict=True)]
    points = np.concatenate(sides) @ R.T + 50
    corners, indices = np.empty((4, 2)), np.empty(5, np.int64)
    assert far_points(points, 0.0, indices, np.empty((2, 4)))
    assert four_corners(points, indices, outset_px, corners)
    expected = (square + outset_px * np.sign(square)) @ R.T + 50
    turned = [np.abs(np.roll(corners, k, axis=0) - expected).max() for k in range(4)]
    assert min(turned) < 1e-9


@pytest.mark.parametrize("count", [3, 5, 6, 60])
def test_other_polygons_have_not_four_corners(count: int) -> None:
    angles = 2 * np.pi * np.arange(count) / count
    polygon = 40 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    along = np.linspace(0, 1, 30, endpoint=False)[:, None]
    following = np.roll(polygon, -1, axis=0)
    sides = [a + along * (b - a) for a, b in zip(polygon, following, strict=True)]
    points, indices, corners = np.concatenate(sides), np.empty(5, np.int64), np.empty((4, 2))
    is_four_sided = far_points(points, 0.0, indices, np.empty((2, 4)))
    assert not (is_four_sided and four_corners(points, indices, 0.0, corners))


def test_squares_seen_twice_are_kept_once() -> None:
    square = np.array([[10.0, 10], [40, 12], [41, 44], [9, 40]])
    others = [np.roll(square, 2, axis=0) + 0.1, square + 2.0, square + np.array([0.0, 30.0])]
    expected = [True, False, True, True]
    np.testing.assert_array_equal(distinct(np.stack([square, *others])), expected)

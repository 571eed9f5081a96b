"""Each kernel against the plain definition of what it computes, or OpenCV's own."""

import cv2
import numpy as np
import pytest

from tagmetry.detect.closest import closest
from tagmetry.detect.segment.components import joined
from tagmetry.detect.segment.corners import four_corners
from tagmetry.detect.segment.distinct import distinct
from tagmetry.detect.segment.mask import dark_mask
from tagmetry.detect.segment.outline import outline, outline_length
from tagmetry.detect.segment.runs import runs
from tagmetry.detect.segment.tiles import noise_gate, tile_extremes
from tagmetry.markers import family
from tagmetry.markers.packed import packed

RNG = np.random.default_rng(0)
SIZES = [(4, 4), (5, 9), (8, 8), (31, 70), (48, 64)]


def mask_of(dark: np.ndarray) -> np.ndarray:
    """A mask with its rim, as `dark_mask` makes it."""
    levels = np.full((-(-dark.shape[0] // 4), -(-dark.shape[1] // 4)), 128, np.uint8)
    return dark_mask(np.where(dark, 10, 200).astype(np.uint8), levels)


@pytest.mark.parametrize("size", SIZES)
def test_tiles_know_their_darkest_and_brightest(size: tuple[int, int]) -> None:
    grey = RNG.integers(0, 256, size, dtype=np.uint8)
    darkest, brightest = tile_extremes(grey)
    for row, column in np.ndindex(darkest.shape):
        top, left = min(4 * row, size[0] - 4), min(4 * column, size[1] - 4)
        tile = grey[top : top + 4, left : left + 4]
        assert (darkest[row, column], brightest[row, column]) == (tile.min(), tile.max())


@pytest.mark.parametrize("noise", [4.0, 10.0])
def test_noise_alone_hardly_passes_the_gate(noise: float) -> None:
    grey = np.rint(128 + RNG.normal(0, noise, (400, 400))).astype(np.uint8)
    extremes = tile_extremes(grey)
    around = np.ones((3, 3), np.uint8)
    ranges = cv2.dilate(extremes[1], around) - cv2.erode(extremes[0], around)
    gate = noise_gate(*extremes)
    assert (ranges >= gate).mean() < 0.02
    assert gate < 9 * noise  # and a marker of ten times the noise does


@pytest.mark.parametrize("size", SIZES)
def test_a_mask_is_what_lies_below_the_levels(size: tuple[int, int]) -> None:
    grey = RNG.integers(0, 256, size, dtype=np.uint8)
    levels = RNG.integers(0, 256, (-(-size[0] // 4), -(-size[1] // 4)), dtype=np.uint8)
    mask = dark_mask(grey, levels)
    expected = grey < np.kron(levels, np.ones((4, 4), np.uint8))[: size[0], : size[1]]
    np.testing.assert_array_equal(mask[1 : size[0] + 1, 1 : size[1] + 1], expected)
    assert mask.sum() == expected.sum()
    assert mask.shape[1] % 8 == 0


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("size", SIZES)
def test_runs_draw_the_mask_again(size: tuple[int, int], share: float) -> None:
    mask = mask_of(RNG.random(size) < share)
    first, begins, ends = runs(mask, mask.size)
    drawn = np.zeros_like(mask)
    for row in range(len(mask)):
        for run in range(first[row], first[row + 1]):
            drawn[row, begins[run] : ends[run]] += 1
    np.testing.assert_array_equal(drawn, mask)
    assert runs(mask, len(begins)) is not None
    assert runs(mask, len(begins) - 1) is None


@pytest.mark.parametrize("share", [0.3, 0.5, 0.6, 0.7])
def test_components_are_opencv_s(share: float) -> None:
    mask = mask_of(RNG.random((60, 90)) < share)
    first, begins, ends = runs(mask, mask.size)
    roots = joined(first, begins, ends)
    labels = np.zeros(mask.shape, np.int32)
    for row in range(len(mask)):
        for run in range(first[row], first[row + 1]):
            labels[row, begins[run] : ends[run]] = roots[run] + 1
    count, expected = cv2.connectedComponents(mask, connectivity=4)
    pairs = np.unique(np.stack([labels.ravel(), expected.ravel()]), axis=1)
    assert pairs.shape[1] == count  # one of ours for each of theirs


def test_an_outline_surrounds_its_component_clockwise() -> None:
    """Its area by the shoelace formula is the number of pixels where it runs along cracks."""
    dark = np.zeros((20, 30), dtype=bool)
    dark[3:12, 5:9] = dark[8:12, 5:20] = True
    dark[5:7, 6:8] = False  # a hole is not walked around
    mask = mask_of(dark)
    grey = np.where(dark, 10, 200).astype(np.uint8)
    start = (6, 4)
    length = outline_length(mask, start, 1000)
    assert length == 2 * (15 + 9)
    points = np.empty((length, 2))
    outline(mask, grey, np.zeros((0, 0), np.uint8), start, points)
    x, y = points.T
    area = 0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum()
    assert area == pytest.approx(9 * 4 + 4 * 11, abs=3)  # the corners are cut
    assert outline_length(mask, start, length - 1) == 0


def test_an_outline_passes_between_pixels_where_the_level_does() -> None:
    x = np.arange(24.0)
    ramp = 200.0 - 160.0 / (1 + np.exp((x - 9.3) / 1.5))
    grey = np.tile(np.rint(np.where(x < 3, 200, ramp)).astype(np.uint8), (24, 1))
    grey[:4] = grey[-4:] = 200
    levels = np.full((6, 6), 120, np.uint8)
    mask = dark_mask(grey, levels)
    points = np.empty((outline_length(mask, (4, 5), 1000), 2))
    outline(mask, grey, levels, (4, 5), points)
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
    corners = np.empty((4, 2))
    assert four_corners(points, outset_px, corners)
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
    assert not four_corners(np.concatenate(sides), 0.0, np.empty((4, 2)))


def test_squares_seen_twice_are_kept_once() -> None:
    square = np.array([[10.0, 10], [40, 12], [41, 44], [9, 40]])
    others = [np.roll(square, 2, axis=0) + 0.1, square + 2.0, square + np.array([0.0, 30.0])]
    expected = [True, False, True, True]
    np.testing.assert_array_equal(distinct(np.stack([square, *others])), expected)


@pytest.mark.parametrize("name", ["tag36h11", "4x4_50", "7x7_1000"])
def test_the_closest_code_differs_in_the_fewest_bits(name: str) -> None:
    one = family(name)
    for _ in range(20):
        read = RNG.random(one.layout.bit_count) < 0.5
        wrong = ((one.turned_codes > 0) != read).sum(axis=1)
        index, count = closest(packed(read[None])[0], one.packed_codes)
        assert (index, count) == (wrong.argmin(), wrong.min())


def test_codes_longer_than_a_word_are_packed_too() -> None:
    bits = RNG.random((5, 70)) < 0.5
    index, count = closest(packed(bits[3:4])[0], packed(bits))
    assert (index, count) == (3, 0)
    flipped = bits[3].copy()
    flipped[[0, 69]] ^= True
    assert closest(packed(flipped[None])[0], packed(bits)) == (3, 2)

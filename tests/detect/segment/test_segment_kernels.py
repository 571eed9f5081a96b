"""Each kernel against the plain definition of what it computes, or OpenCV's own."""

import cv2
import numpy as np
import pytest

from tagmetry.detect.segment.corners import far_points, four_corners
from tagmetry.detect.segment.distinct import distinct
from tagmetry.detect.segment.mask import dark_mask
from tagmetry.detect.segment.outline import at_level, midway, steps, walk
from tagmetry.detect.segment.starts import starts
from tagmetry.detect.segment.tiles import Extremes, Tiles, noise_gate, tile_extremes

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


@pytest.mark.parametrize("size", SIZES)
def test_a_mask_is_what_lies_below_the_levels(size: tuple[int, int]) -> None:
    grey = RNG.integers(0, 256, size, dtype=np.uint8)
    levels = RNG.integers(0, 256, (-(-size[0] // 4), -(-size[1] // 4)), dtype=np.uint8)
    mask = dark_mask(grey, levels)
    expected = grey < np.kron(levels, np.ones((4, 4), np.uint8))[: size[0], : size[1]]
    np.testing.assert_array_equal(mask[1 : size[0] + 1, 1 : size[1] + 1], expected)
    assert mask.sum() == expected.sum()
    assert mask.shape[1] % 8 == 0


def beginnings(mask: np.ndarray) -> np.ndarray:
    """All places where an outline of a mask may begin, whatever the grey values are."""
    grey = np.zeros((mask.shape[0] - 2, mask.shape[1] - 2), np.uint8)
    return starts(mask, grey, tile_extremes(grey)[0], mask.size)


def walk_on(mask: np.ndarray, start: np.ndarray, cracks: np.ndarray) -> int:
    """Walk on a mask with rows, and return how many cracks were written."""
    width = mask.shape[1]
    return walk(mask.reshape(-1), width, steps(width), start, cracks)


def walked(mask: np.ndarray) -> tuple[list[np.ndarray], int]:
    """All outlines of a mask as cracks (n, 3), and how many cracks were written in all."""
    outlines, count = [], 0
    for start in beginnings(mask):
        cracks = np.full((mask.size, 3), -1, np.int32)
        length = walk_on(mask, start, cracks)
        count += np.count_nonzero(cracks[:, 2] >= 0)
        if length:
            outlines.append(cracks[:length])
    return outlines, count


def middles(cracks: np.ndarray) -> np.ndarray:
    points = np.empty((len(cracks), 2))
    midway(cracks, 1, points)
    return points


def area(points: np.ndarray) -> float:
    """By the shoelace formula: positive where they go clockwise as seen."""
    x, y = points.T
    return 0.5 * float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("size", SIZES)
def test_outlines_may_begin_where_left_and_above_are_bright(
    size: tuple[int, int], share: float
) -> None:
    mask = mask_of(RNG.random(size) < share)
    first = (mask[1:, 1:] == 1) & (mask[1:, :-1] == 0) & (mask[:-1, 1:] == 0)
    rows, columns = np.nonzero(first)
    np.testing.assert_array_equal(beginnings(mask), np.stack([columns, rows], axis=1) + 1)


@pytest.mark.parametrize("least", [0, 99, 100, 101, 255])
def test_outlines_begin_where_the_image_steps_down(least: int) -> None:
    """A square and a faint ramp are dark; only the square's step is 100 grey values high."""
    grey = np.full((24, 48), 160, np.uint8)
    grey[8:18, 8:18] = 60
    grey[8:18, 30:40] = 125 - np.arange(10)[:, None]
    mask = mask_of(grey < 130)
    steps = np.full((6, 12), least, np.uint8)
    begins = starts(mask, grey, steps, 100).tolist()
    assert ([9, 9] in begins) == (least <= 100)
    assert ([31, 9] in begins) == (least == 0)


def test_no_more_starts_are_given_than_asked_for() -> None:
    mask = mask_of(np.indices((20, 20)).sum(axis=0) % 2 == 0)
    grey, steps = np.zeros((20, 20), np.uint8), np.zeros((5, 5), np.uint8)
    assert len(starts(mask, grey, steps, 7)) == 7
    assert len(starts(mask, grey, steps, 10_000)) == 200


@pytest.mark.parametrize("share", [0.3, 0.5, 0.6, 0.7])
def test_one_outline_around_each_of_opencv_s_components(share: float) -> None:
    mask = mask_of(RNG.random((60, 90)) < share)
    count, labels = cv2.connectedComponents(mask, connectivity=4)
    outlines, _ = walked(mask)
    outer = [cracks for cracks in outlines if area(middles(cracks)) > 0]
    around = [labels[cracks[:, 1], cracks[:, 0]] for cracks in outer]
    assert all(len(set(own.tolist())) == 1 for own in around)
    assert sorted(own[0] for own in around) == list(range(1, count))


@pytest.mark.parametrize("kind", ["noise", "comb", "checks", "spiral"])
def test_no_crack_is_walked_much_more_than_once(kind: str) -> None:
    """So the time is bounded by the number of pixels, whatever an image shows."""
    y, x = np.indices((64, 96))
    dark = {
        "noise": RNG.random((64, 96)) < 0.55,
        "comb": (x % 4 < 2) | (y > 60),
        "checks": (x + y) % 2 == 0,
        "spiral": (np.hypot(x - 48, y - 32) + 1.3 * np.arctan2(y - 32, x - 48)) % 8 < 4,
    }[kind]
    mask = mask_of(dark)
    inner = mask.astype(int)
    cracks = np.abs(np.diff(inner, axis=0)).sum() + np.abs(np.diff(inner, axis=1)).sum()
    _, steps = walked(mask)
    assert steps <= 1.5 * cracks


def test_an_outline_surrounds_its_component_clockwise() -> None:
    """Its area by the shoelace formula is the number of pixels where it runs along cracks."""
    dark = np.zeros((20, 30), dtype=bool)
    dark[3:12, 5:9] = dark[8:12, 5:20] = True
    dark[5:7, 6:8] = False  # a hole is not walked around
    (cracks,), _ = walked(mask_of(dark))
    assert len(cracks) == 2 * (15 + 9)
    assert area(middles(cracks)) == pytest.approx(9 * 4 + 4 * 11, abs=3)  # the corners are cut
    short = np.empty((len(cracks) - 1, 3), np.int32)
    assert walk_on(mask_of(dark), np.array([6, 4], np.int32), short) == 0


def test_an_outline_passes_between_pixels_where_the_level_does() -> None:
    x = np.arange(24.0)
    ramp = 200.0 - 160.0 / (1 + np.exp((x - 9.3) / 1.5))
    grey = np.tile(np.rint(np.where(x < 3, 200, ramp)).astype(np.uint8), (24, 1))
    grey[:4] = grey[-4:] = 200
    levels = np.full((6, 6), 120, np.uint8)
    (cracks,), _ = walked(dark_mask(grey, levels))
    points = np.empty((len(cracks), 2))
    at_level(cracks, grey, levels, points)
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
    indices = np.empty(5, np.int64)
    assert far_points(points, 0.0, indices)
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
    assert not (far_points(points, 0.0, indices) and four_corners(points, indices, 0.0, corners))


def test_squares_seen_twice_are_kept_once() -> None:
    square = np.array([[10.0, 10], [40, 12], [41, 44], [9, 40]])
    others = [np.roll(square, 2, axis=0) + 0.1, square + 2.0, square + np.array([0.0, 30.0])]
    expected = [True, False, True, True]
    np.testing.assert_array_equal(distinct(np.stack([square, *others])), expected)

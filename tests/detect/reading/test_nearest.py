"""Which marker was read: the nearest code among few and many, one by one or all at once."""

import numpy as np
import pytest

from tagmetry.detect.choose import Rules
from tagmetry.detect.reading.closest import clearness, closest
from tagmetry.detect.reading.decode import Readings
from tagmetry.detect.reading.nearest import nearest
from tagmetry.detect.reading.shelves import MOST_WRONG_BITS, Shelves, shelves_of
from tagmetry.markers import MarkerFamily, family
from tagmetry.markers.packed import packed

RNG = np.random.default_rng(0)
LARGE = ["tag36h11", "tagStandard41h12", "tagStandard52h13", "tagCustom48h12", "tagCircle49h12"]


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


@pytest.mark.parametrize("name", ["tag36h11", "4x4_50", "7x7_1000"])
def test_how_clearly_a_code_was_read(name: str) -> None:
    one = family(name)
    margins = RNG.normal(0, 1.5, one.layout.bit_count)
    for index in (0, len(one), 3 * len(one) + 7):
        quarters, marker_id = divmod(index, len(one))
        white = one.codes[marker_id][one.layout.rotations[quarters]]
        expected = np.clip(np.where(white, margins, -margins), -1, 1).mean()
        assert clearness(margins, one.packed_codes[index]) == pytest.approx(expected)


def with_wrong_bits(codes: np.ndarray, count: int) -> np.ndarray:
    """Return codes with so many bits flipped in each."""
    wrong = np.argsort(RNG.random(codes.shape), axis=1) < count
    return codes ^ wrong


@pytest.mark.parametrize("name", LARGE)
@pytest.mark.parametrize("wrong_bits", range(MOST_WRONG_BITS + 1))
def test_shelves_hold_the_same_nearest_code_as_all_codes(name: str, wrong_bits: int) -> None:
    one = family(name)
    shelves = shelves_of(one)
    assert shelves is not None
    codes = one.turned_codes[RNG.integers(0, 4 * len(one), 6)] > 0
    read = packed(with_wrong_bits(codes, wrong_bits))
    indices, hammings = shelves.closest_of_each(read)
    expected = [closest(row, one.packed_codes) for row in read]
    assert list(zip(indices.tolist(), hammings.tolist(), strict=True)) == expected


def test_of_codes_equally_near_the_first_is_taken() -> None:
    codes = np.repeat(RNG.random((1, 40)) < 0.5, 5, axis=0)
    codes[[0, 1, 4], [3, 20, 7]] ^= True
    indices, hammings = Shelves.of(packed(codes), 40).closest_of_each(packed(codes[[2, 4]]))
    assert indices.tolist() == [2, 4]
    assert hammings.tolist() == [0, 0]


def test_what_no_code_is_near_to_is_far_on_shelves_too() -> None:
    codes = np.zeros((3, 48), dtype=bool)
    _, hammings = Shelves.of(packed(codes), 48).closest_of_each(packed(codes[:1] ^ True))
    assert hammings[0] > MOST_WRONG_BITS


@pytest.mark.parametrize("name", ["tag25h9", "4x4_250", "5x5_1000"])
def test_few_codes_and_short_ones_have_no_shelves(name: str) -> None:
    assert shelves_of(family(name)) is None


def readings_of(families: list[MarkerFamily]) -> Readings:
    """Return readings of markers with wrong bits, faint ones, and of what is no marker."""
    rows = [
        np.concatenate(
            [with_wrong_bits(one.turned_codes[:: len(one) // 10] > 0, k) for k in range(4)]
        )
        for one in families
    ]
    rows.append(RNG.random((60, families[0].layout.bit_count)) < 0.5)
    white = np.concatenate(rows)
    margins = np.where(white, 1.0, -1.0) * RNG.uniform(0.1, 2.0, (len(white), 1))
    n = len(white)
    measures = np.column_stack(
        [
            RNG.choice([0.5, 1.0], n, p=[0.1, 0.9]),
            RNG.choice([-60.0, 80.0, np.nan], n, p=[0.2, 0.7, 0.1]),
            RNG.uniform(0.2, 1.0, n),
            RNG.uniform(0.0, 1.0, n),
            RNG.uniform(0.0, 1.0, n),
        ]
    )
    measures[np.isnan(measures[:, 1]), 0] = 0.0  # as it is where black and white are alike
    return Readings(margins, packed(white), measures)


@pytest.mark.parametrize(
    "names",
    [["tag36h11"], ["6x6_250", "tag36h11", "aruco_mip_36h12"], ["4x4_50"], ["tagStandard52h13"]],
)
@pytest.mark.parametrize("inverted", [False, True])
@pytest.mark.parametrize("forgive_bits", [None, 2, 9])
def test_all_at_once_are_judged_like_one_by_one(
    names: list[str], inverted: bool, forgive_bits: int | None
) -> None:
    families, rules = [family(name) for name in names], Rules(forgive_bits, inverted)
    readings = readings_of(families)
    squares_px = RNG.uniform(0, 500, (len(readings), 4, 2))
    is_bright = RNG.random(len(readings)) < 0.4
    found = rules.markers_among(squares_px, is_bright, readings, dict(enumerate(families, 3)))
    passed = [
        k
        for k, (bright, reading) in enumerate(zip(is_bright, readings, strict=True))
        if rules.why_not(bool(bright), reading, families) is None
    ]
    assert passed
    for k, row in enumerate(passed):
        reading = readings[row]
        matches = [nearest(reading, one) for one in families]
        own = matches[found.families[k] - 3]
        assert own.hamming == min(match.hamming for match in matches)
        read = own.id, own.hamming, own.confidence, reading.contrast < 0, reading.sharp_outline
        told = found.ids, found.hamming, found.confidence, found.is_inverted, found.sharp_outline
        assert read == tuple(column[k] for column in told)
        turned_px = np.roll(squares_px[row], -own.quarters, axis=0)
        np.testing.assert_array_equal(found.corners_px[k], turned_px)
    assert len(found) == len(passed)


@pytest.mark.slow
@pytest.mark.parametrize("name", LARGE)
def test_every_id_is_told_in_four_turns_with_the_wrong_bits_that_are_forgiven(name: str) -> None:
    one = family(name)
    shelves, codes = shelves_of(one), one.turned_codes > 0
    assert shelves is not None
    for wrong_bits in (0, one.forgiven_bits):
        indices, hammings = shelves.closest_of_each(packed(with_wrong_bits(codes, wrong_bits)))
        np.testing.assert_array_equal(indices, np.arange(len(codes)))
        assert set(hammings.tolist()) == {wrong_bits}

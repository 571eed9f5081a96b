"""Lists of many robots' neighbours, packed at once, are those that are packed one by one."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.link import Neighbour, Neighbours
from tagmetry.link.bodies import pack_body
from tagmetry.link.neighbour_table import pack_neighbour_table


def random_neighbours(rng: np.random.Generator, count: int) -> np.ndarray:
    """Return ids, ranges, bearings, headings and ages, the nearest first, shape (count, 5)."""
    ranges = np.sort(rng.uniform(0, 70, count))
    angles = rng.uniform(-4, 4, (count, 2))
    ids, ages = rng.integers(0, 65536, count), rng.uniform(0, 0.4, count)
    return np.column_stack([ids, ranges, angles, ages])


def one_by_one(captured_us: int, limit_m: float, sensed: np.ndarray) -> bytes:
    seen = tuple(Neighbour(int(one[0]), *one[1:]) for one in sensed.tolist())
    return pack_body(Neighbours(captured_us, limit_m, seen))[1]


def test_a_table_packs_what_lists_do() -> None:
    rng = np.random.default_rng(0)
    sensed = [random_neighbours(rng, count) for count in (3, 0, 100, 1, 130, 400)]
    limits_m = [0.5, 0.3004, 70.0, 65.535, 1.0, 2.0]
    packed = pack_neighbour_table(123_456_789, limits_m, sensed)
    for message, limit_m, of_robot in zip(packed, limits_m, sensed, strict=True):
        assert pack_body(message)[1] == one_by_one(123_456_789, limit_m, of_robot)


def test_halves_and_the_ends_of_the_circle_are_rounded_alike() -> None:
    halves = np.arange(0.5, 40.5)
    sensed = np.column_stack(
        [halves - 0.5, halves / 1000, halves / 1e4, -halves / 1e4, halves / 1e3]
    )
    sensed[0, 2:4] = np.pi, -np.pi + 1e-12
    (packed,) = pack_neighbour_table(1, [0.5], [sensed])
    assert packed.body == one_by_one(1, 0.5, sensed)


def test_no_robots_are_told_nothing() -> None:
    assert pack_neighbour_table(1, [], []) == []


@pytest.mark.parametrize(
    ("column", "value"),
    [(0, -1.0), (0, 65536.0), (1, -0.1), (1, np.nan), (2, np.inf), (3, np.nan), (4, -1e-3)],
)
def test_what_does_not_fit_is_refused(column: int, value: float) -> None:
    sensed = random_neighbours(np.random.default_rng(1), 5)
    sensed[3, column] = value
    with pytest.raises(InputError, match="this neighbour cannot be sent"):
        pack_neighbour_table(1, [0.5], [sensed])

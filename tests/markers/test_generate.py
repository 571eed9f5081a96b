"""Generated families keep what was asked of them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.errors import InputError
from tagmetry.markers import MarkerFamily, generate_family


def distances(family: MarkerFamily) -> list[int]:
    """Count differing cells of pictures, one by one and turned by turned."""
    pictures = [family.picture(i) for i in range(len(family))]
    found = []
    for i, one in enumerate(pictures):
        found += [int((one != np.rot90(one, k)).sum()) for k in (1, 2, 3)]
        for other in pictures[:i]:
            found += [int((one != np.rot90(other, k)).sum()) for k in range(4)]
    return found


@given(
    data_cells=st.integers(3, 7),
    count=st.integers(1, 5),
    share=st.floats(0.1, 0.25),
    seed=st.integers(0, 2**32 - 1),
)
def test_a_family_keeps_its_distance(data_cells: int, count: int, share: float, seed: int) -> None:
    wanted = max(1, int(share * data_cells**2))
    made = generate_family("mine", data_cells, count, wanted, np.random.default_rng(seed))
    assert len(made) == count
    assert min(distances(made)) >= wanted
    assert made.minimum_distance() == min(distances(made))
    assert made.correction_bits == (wanted - 1) // 2


def test_the_same_seed_gives_the_same_family() -> None:
    one, same, other = (
        generate_family("mine", 5, 10, 6, np.random.default_rng(seed)) for seed in (7, 7, 8)
    )
    np.testing.assert_array_equal(one.codes, same.codes)
    assert (one.codes != other.codes).any()


def test_no_marker_looks_like_a_tile() -> None:
    made = generate_family("mine", 4, 20, 2, np.random.default_rng(0))
    for marker_id in range(len(made)):
        bits = made.picture(marker_id)[1:-1, 1:-1]
        changes = np.diff(bits, axis=0).sum() + np.diff(bits, axis=1).sum()
        assert changes >= 24 / 3


def test_refuses_what_cannot_be_found() -> None:
    text = r"found only \d of 100 markers of 3x3 bits at distance 4 in 300 tries"
    with pytest.raises(InputError, match=text):
        generate_family("mine", 3, 100, 4, np.random.default_rng(0), tries=300)


@pytest.mark.parametrize(
    ("data_cells", "count", "distance"), [(2, 1, 1), (17, 1, 1), (5, 0, 1), (5, 1, 0), (-3, 1, 1)]
)
def test_refuses_what_is_no_family(data_cells: int, count: int, distance: int) -> None:
    text = f"at least 1, got {data_cells}, {count} and {distance}"
    with pytest.raises(InputError, match=text):
        generate_family("mine", data_cells, count, distance, np.random.default_rng(0))

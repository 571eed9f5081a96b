"""The code of the original ArUco markers: ids, parity, and OpenCV's table."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.markers import family
from tagmetry.markers.original import original_code, original_id


def test_all_ids_are_opencv_s_table() -> None:
    codes = np.stack([original_code(marker_id) for marker_id in range(1024)])
    np.testing.assert_array_equal(codes, family("aruco_original").codes)


def test_every_code_spells_its_id() -> None:
    assert [original_id(original_code(i)) for i in range(1024)] == list(range(1024))


def test_seed_003_s_marker_is_30() -> None:
    bits = original_code(30).reshape(5, 5)[:, [1, 3]].astype(int)
    assert "".join(map(str, bits.ravel())) == "0000011110"
    code = original_code(0).reshape(5, 5)
    code[2] = [1, 0, 1, 1, 1]  # data 01
    code[3] = [0, 1, 1, 1, 0]  # data 11
    code[4] = [0, 1, 0, 0, 1]  # data 10
    assert original_id(code.reshape(25)) == 30


@pytest.mark.parametrize("marker_id", [0, 30, 511, 1023])
@pytest.mark.parametrize("bit", range(25))
def test_one_flipped_bit_never_passes_for_the_marker(marker_id: int, bit: int) -> None:
    """The rows are two bits apart or more, so a single wrong bit is always seen."""
    code = original_code(marker_id)
    code[bit] = not code[bit]
    assert original_id(code) is None


@pytest.mark.parametrize("marker_id", [-1, 1024])
def test_refuses_an_id_beyond_ten_bits(marker_id: int) -> None:
    with pytest.raises(InputError, match=f"ids are 0 to 1023, got {marker_id}"):
        original_code(marker_id)

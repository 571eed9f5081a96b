"""TUM files: read back what is written, and what is refused with the line named."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.files.trajectories import load_trajectory

GOOD = "# a comment\n10.5 1 2 3 0 0 0 1\n\n 11,1.5,2,3,0,0,2,0 \n"


def written(path, text):
    path.write_text(text)
    return path


def test_reads_spaces_commas_comments_and_any_length_of_quaternion(tmp_path):
    found = load_trajectory(written(tmp_path / "a.tum", GOOD))
    np.testing.assert_array_equal(found.times_s, [10.5, 11.0])
    np.testing.assert_array_equal(found.positions_m, [[1, 2, 3], [1.5, 2, 3]])
    turns = found.poses.rotation.magnitude()
    np.testing.assert_allclose(turns, [0, np.pi])
    assert found.length_m == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("# only\n", "found only comments"),
        ("", "the file is empty"),
        ("1 2 3\n", "line 1: expected the 8 numbers"),
        ("1 0 0 0 0 0 0 1\n2 0 0 nan 0 0 0 1\n", "line 2: expected the 8 numbers"),
        ("1 0 0 0 0 0 0 one\n", "found '1 0 0 0 0 0 0 one'"),
        ("1 0 0 0 0 0 0 0\n", "line 1: the quaternion is zero"),
        ("2 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n", "line 2: time does not rise, 2.000000 s"),
    ],
)
def test_refuses(tmp_path, text, why):
    with pytest.raises(InputError, match=why):
        load_trajectory(written(tmp_path / "broken.tum", text))
    with pytest.raises(InputError, match="no such file"):
        load_trajectory(tmp_path / "none.tum")

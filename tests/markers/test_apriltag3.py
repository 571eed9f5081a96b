"""AprilTag 3's newer families, against the AprilTag project's own library."""

import numpy as np
import pytest

from apriltag_library import library_family
from tagmetry.errors import InputError
from tagmetry.markers import family

NAMES = (
    "tagStandard41h12",
    "tagStandard52h13",
    "tagCircle21h7",
    "tagCircle49h12",
    "tagCustom48h12",
)
LARGE = ("tagStandard52h13", "tagCircle49h12", "tagCustom48h12")
FORGIVEN = {
    "tagStandard41h12": 4,
    "tagStandard52h13": 5,
    "tagCircle21h7": 0,
    "tagCircle49h12": 5,
    "tagCustom48h12": 4,
}
every_family = pytest.mark.parametrize("name", NAMES)


@every_family
def test_every_code_and_every_place_of_a_bit_is_the_library_s(name: str) -> None:
    ours, theirs = family(name), library_family(name)
    np.testing.assert_array_equal(ours.codes, theirs.codes)
    assert ours.layout.bit_cells == theirs.bit_cells
    assert ours.layout.side_cells == theirs.side_cells
    assert ours.layout.side_cells + 2 * ours.layout.margin_cells == theirs.total_cells
    assert ours.correction_bits == (theirs.distance - 1) // 2


@every_family
def test_pictures_are_the_library_s_wherever_something_is_printed(name: str) -> None:
    ours, theirs = family(name), library_family(name)
    layout = ours.layout
    cells = np.concatenate([layout.bit_cells, layout.black_cells, layout.white_cells])
    columns, rows = cells.T + layout.margin_cells
    for marker_id in (0, 7, len(ours) - 1):
        drawn, printed = theirs.drawn(marker_id), ours.picture(marker_id)
        np.testing.assert_array_equal(printed[rows, columns], drawn[rows, columns])


@every_family
def test_what_is_neither_bit_nor_border_is_left_white(name: str) -> None:
    layout = family(name).layout
    picture = layout.picture(np.zeros(layout.bit_count, dtype=bool))
    black = len(layout.bit_cells) + len(layout.black_cells)
    assert (~picture).sum() == black
    side_cells = layout.side_cells + 2 * layout.margin_cells
    assert black + len(layout.white_cells) <= side_cells**2


@pytest.mark.parametrize(
    ("name", "free", "rings"),
    [
        ("tagStandard41h12", 0, 2),
        ("tagStandard52h13", 0, 2),
        ("tagCircle21h7", 0, 1),
        ("tagCircle49h12", 0, 1),
        ("tagCustom48h12", 4, 2),
        ("tag36h11", 0, 0),
    ],
)
def test_free_cells_and_whole_rings(name: str, free: int, rings: int) -> None:
    assert len(family(name).layout.free_cells) == free
    assert family(name).layout.whole_rings == rings


def test_a_circle_s_cells_lie_within_a_disc() -> None:
    """The corners beyond it are free; the square's own corners lie on no smaller disc."""
    for name in ("tagCircle21h7", "tagCircle49h12"):
        layout = family(name).layout
        cells = np.concatenate([layout.bit_cells, layout.black_cells])
        corners = np.array([[0, 0], [0, 1], [1, 0], [1, 1]])
        reach = np.linalg.norm((cells[:, None] + corners) - layout.side_cells / 2, axis=2).max()
        total_cells = layout.side_cells + 2 * layout.margin_cells
        assert reach < 0.85 * np.hypot(total_cells, total_cells) / 2


@pytest.mark.parametrize("name", ["tagStandard41h12", "tagCircle21h7"])
def test_correction_bits_are_what_the_measured_distance_allows(name: str) -> None:
    _check_distance(name)


@pytest.mark.slow
@pytest.mark.parametrize("name", LARGE)
def test_correction_bits_of_large_families_too(name: str) -> None:
    _check_distance(name)


def _check_distance(name: str) -> None:
    assert family(name).minimum_distance() == library_family(name).distance


@pytest.mark.parametrize(("name", "bits"), FORGIVEN.items())
def test_forgiven_bits_are_these(name: str, bits: int) -> None:
    ours = family(name)
    assert ours.forgiven_bits == bits <= ours.correction_bits
    assert bits == 0 or ours.chance_of_random_match(bits) <= 1e-3
    assert bits == ours.correction_bits or ours.chance_of_random_match(bits + 1) > 1e-3


@pytest.mark.parametrize(
    "alias", ["tagStandard41h12", "tagstandard41h12", "standard41h12", " Standard41H12 "]
)
def test_other_spellings_are_understood(alias: str) -> None:
    assert family(alias).name == "tagStandard41h12"


def test_the_border_has_one_width_only() -> None:
    with pytest.raises(InputError, match="tagCircle21h7 has bits around its border"):
        family("tagCircle21h7_border2")

"""The predefined families, against OpenCV's own pictures and a frozen table."""

import cv2
import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.markers import MarkerFamily, family, family_names

OPENCV_NAMES = {
    **{f"{n}x{n}_{c}": f"DICT_{n}X{n}_{c}" for n in (4, 5, 6, 7) for c in (50, 100, 250, 1000)},
    "aruco_original": "DICT_ARUCO_ORIGINAL",
    "aruco_mip_36h12": "DICT_ARUCO_MIP_36h12",
    "tag16h5": "DICT_APRILTAG_16h5",
    "tag25h9": "DICT_APRILTAG_25h9",
    "tag36h10": "DICT_APRILTAG_36h10",
    "tag36h11": "DICT_APRILTAG_36h11",
}

APRILTAG3 = {  # these are held against the AprilTag library in test_apriltag3
    "tagStandard41h12", "tagStandard52h13", "tagCircle21h7", "tagCircle49h12", "tagCustom48h12",
}  # fmt: skip

# name: ids, minimum distance over all pairs and turns, correction bits, forgiven bits
FROZEN = {
    "4x4_50": (50, 4, 1, 0), "4x4_100": (100, 3, 1, 0), "4x4_250": (250, 3, 1, 0),
    "4x4_1000": (1000, 2, 0, 0),
    "5x5_50": (50, 8, 3, 1), "5x5_100": (100, 7, 3, 1), "5x5_250": (250, 6, 2, 1),
    "5x5_1000": (1000, 5, 2, 0),
    "6x6_50": (50, 13, 6, 4), "6x6_100": (100, 12, 5, 4), "6x6_250": (250, 11, 5, 4),
    "6x6_1000": (1000, 9, 4, 3),
    "7x7_50": (50, 19, 9, 9), "7x7_100": (100, 18, 8, 8), "7x7_250": (250, 17, 8, 8),
    "7x7_1000": (1000, 14, 6, 6),
    "aruco_original": (1024, 0, 0, 0), "aruco_mip_36h12": (250, 12, 5, 4),
    "tag16h5": (30, 5, 2, 0), "tag25h9": (35, 9, 4, 1),
    "tag36h10": (2320, 10, 4, 2), "tag36h11": (587, 11, 5, 3),
}  # fmt: skip
every_family = pytest.mark.parametrize("name", FROZEN)


def opencv_dictionary(name: str) -> cv2.aruco.Dictionary:
    return cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, OPENCV_NAMES[name]))


def cells_of_opencv_picture(name: str, marker_id: int) -> np.ndarray:
    """Read the middle pixel of every cell of the picture that OpenCV prints."""
    dictionary = opencv_dictionary(name)
    cells = dictionary.markerSize + 2
    pixels = cv2.aruco.generateImageMarker(dictionary, marker_id, 8 * cells, borderBits=1)
    return pixels[4::8, 4::8] > 127


def quarters_to_opencv(name: str) -> int:
    """AprilTags stand on their head in OpenCV."""
    return 2 if name.startswith("tag") else 0


def test_the_names_are_these() -> None:
    assert set(FROZEN) == set(OPENCV_NAMES)
    assert set(family_names()) == set(FROZEN) | APRILTAG3
    assert len(family_names()) == 27


@every_family
def test_every_picture_is_opencv_s_with_apriltags_turned_by_180_degrees(name: str) -> None:
    ours = family(name)
    for marker_id in range(len(ours)):
        expected = np.rot90(cells_of_opencv_picture(name, marker_id), quarters_to_opencv(name))
        np.testing.assert_array_equal(ours.picture(marker_id), expected)


@every_family
def test_there_are_as_many_ids_as_opencv_has(name: str) -> None:
    assert len(family(name)) == FROZEN[name][0] == len(opencv_dictionary(name).bytesList)


@every_family
def test_correction_bits_are_what_the_measured_distance_allows(name: str) -> None:
    _, distance, correction, _ = FROZEN[name]
    assert family(name).minimum_distance() == distance
    assert family(name).correction_bits == correction == max(0, (distance - 1) // 2)


@every_family
def test_forgiven_bits_are_these(name: str) -> None:
    assert family(name).forgiven_bits == FROZEN[name][3]


@every_family
def test_one_wrong_bit_more_would_be_too_likely_or_too_many(name: str) -> None:
    ours = family(name)
    if ours.forgiven_bits > 0:
        assert ours.chance_of_random_match(ours.forgiven_bits) <= 1e-3
    if ours.forgiven_bits < ours.correction_bits:
        assert ours.chance_of_random_match(ours.forgiven_bits + 1) > 1e-3


@pytest.mark.parametrize(
    ("alias", "name"),
    [
        *((opencv, name) for name, opencv in OPENCV_NAMES.items()),
        ("4X4_50", "4x4_50"),
        (" Tag36H11 ", "tag36h11"),
        ("apriltag_36h11", "tag36h11"),
        ("DICT_ARUCO_MIP_36H12", "aruco_mip_36h12"),
        ("aruco_mip36h12", "aruco_mip_36h12"),
    ],
)
def test_other_spellings_are_understood(alias: str, name: str) -> None:
    assert family(alias).name == name
    np.testing.assert_array_equal(family(alias).codes, family(name).codes)


@pytest.mark.parametrize("unknown", ["tag37h12", "", "4x4", "tag36h11_border", "tag36h11_border22"])
def test_an_unknown_name_lists_those_there_are(unknown: str) -> None:
    with pytest.raises(InputError, match=f"unknown marker family '{unknown}'") as caught:
        family(unknown)
    assert all(name in str(caught.value) for name in family_names())


def test_an_unknown_family_with_a_border_is_unknown_too() -> None:
    with pytest.raises(InputError, match="unknown marker family 'nosuch'"):
        family("nosuch_border2")


@pytest.mark.parametrize("name", ["tag36h11", "5x5_50"])
def test_a_border_of_two_cells_is_as_opencv_draws_it(name: str) -> None:
    ours = family(f"{name}_border2")
    cells = ours.layout.side_cells
    pixels = cv2.aruco.generateImageMarker(opencv_dictionary(name), 7, 8 * cells, borderBits=2)
    expected = np.rot90(pixels[4::8, 4::8] > 127, quarters_to_opencv(name))
    np.testing.assert_array_equal(ours.picture(7), expected)
    assert ours.name == f"{name}_border2"


def test_a_border_of_one_cell_is_the_family_itself() -> None:
    assert family("tag25h9").with_border(1) is family("tag25h9")
    again = family("tag25h9_border2").with_border(1)
    assert again.layout == family("tag25h9").layout


def test_a_border_of_no_cell_is_refused() -> None:
    with pytest.raises(InputError, match="at least 1 cell wide, got 0"):
        family("tag25h9_border0")


@pytest.mark.parametrize("marker_id", [-1, 587, 10**9])
def test_an_id_that_is_not_there_is_refused(marker_id: int) -> None:
    with pytest.raises(InputError, match=f"ids 0 to 586, there is no id {marker_id}"):
        family("tag36h11").picture(marker_id)


def test_codes_of_another_length_are_refused() -> None:
    layout = family("4x4_50").layout
    with pytest.raises(InputError, match=r"codes of 16 bits, got an array of shape \(3, 15\)"):
        MarkerFamily("odd", layout, np.zeros((3, 15), bool), 0)


def test_the_chance_of_a_random_match_counts_all_that_is_within() -> None:
    layout = family("4x4_50").layout
    one = MarkerFamily("one", layout, np.zeros((1, 16), bool), 0)
    assert one.chance_of_random_match(0) == pytest.approx(4 / 2**16)
    assert one.chance_of_random_match(2) == pytest.approx(4 * (1 + 16 + 120) / 2**16)
    assert family("4x4_1000").chance_of_random_match(4) == 1.0


def test_the_chance_of_a_random_match_is_about_what_happens() -> None:
    ours = family("tag16h5")
    bits = np.random.default_rng(0).random((20_000, 16)) < 0.5
    distances = (16 - np.where(bits, 1.0, -1.0) @ np.where(ours.turned_codes, 1.0, -1.0).T) / 2
    matched = (distances.min(axis=1) <= 1).mean()
    assert matched == pytest.approx(ours.chance_of_random_match(1), rel=0.05)


def test_a_family_says_its_name_and_size() -> None:
    assert repr(family("tag25h9")) == "MarkerFamily('tag25h9', 35 ids)"

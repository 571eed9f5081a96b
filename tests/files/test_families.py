"""Marker families in the format of OpenCV's dictionaries."""

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.files import load_family, resolve_family, save_family
from tagmetry.markers import family, generate_family

SMALL = """\
%YAML:1.0
---
nmarkers: 3
markersize: 3
maxCorrectionBits: 0
marker_0: "101011111"
marker_1: "000110000"
marker_2: "110110111"
"""


def load_text(tmp_path: Path, text: str) -> object:
    path = tmp_path / "mine.yml"
    path.write_text(text)
    return load_family(path)


@pytest.mark.parametrize("name", ["4x4_50", "7x7_250", "tag16h5", "tag36h11", "aruco_original"])
@pytest.mark.parametrize("suffix", [".yml", ".json"])
def test_predefined_family_reads_back(tmp_path: Path, name: str, suffix: str) -> None:
    path = tmp_path / (name + suffix)
    save_family(family(name), path)
    found = load_family(path)
    np.testing.assert_array_equal(found.codes, family(name).codes)
    assert found.layout == family(name).layout
    assert (found.name, found.correction_bits) == (name, family(name).correction_bits)


def test_generated_family_reads_back(tmp_path: Path) -> None:
    made = generate_family("arena", 4, 20, 4, np.random.default_rng(1))
    save_family(made, tmp_path / "arena.yml")
    np.testing.assert_array_equal(load_family(tmp_path / "arena.yml").codes, made.codes)


@pytest.mark.parametrize("suffix", [".yml", ".json"])
def test_reads_what_opencv_writes(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"written{suffix}"
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_5X5_50)
    dictionary.maxCorrectionBits = 3
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    dictionary.writeDictionary(storage)
    storage.release()
    found = load_family(path)
    np.testing.assert_array_equal(found.codes, family("5x5_50").codes)
    assert (found.name, found.correction_bits) == ("written", 3)


def test_opencv_reads_what_is_written(tmp_path: Path) -> None:
    save_family(family("6x6_50"), tmp_path / "ours.yml")
    storage = cv2.FileStorage(str(tmp_path / "ours.yml"), cv2.FILE_STORAGE_READ)
    dictionary = cv2.aruco.Dictionary()
    assert dictionary.readDictionary(storage.root())
    expected = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_6X6_50).bytesList
    np.testing.assert_array_equal(dictionary.bytesList, expected)


def test_bits_go_row_by_row_and_one_is_white(tmp_path: Path) -> None:
    found = load_family(_written(tmp_path, SMALL))
    picture = found.picture(0)
    np.testing.assert_array_equal(picture[1:4, 1:4], [[1, 0, 1], [0, 1, 1], [1, 1, 1]])
    assert not picture[0].any()


def _written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "mine.yml"
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("nmarkers: 3\n", "", "nmarkers is missing"),
        ("nmarkers: 3", "nmarkers: 0", "nmarkers: expected greater than or equal to 1, found 0"),
        ("nmarkers: 3", "nmarkers: 100000", "nmarkers: expected less than or equal to 4096"),
        ("nmarkers: 3", "nmarkers: 4", "nmarkers is 4, but marker_3 is missing"),
        ("nmarkers: 3", "nmarkers: 2", "nmarkers is 2, but there is a marker_2"),
        ("markersize: 3", "markersize: 4", "marker_0: expected 16 digits .* found 9 characters"),
        ("markersize: 3", "markersize: true", "markersize: expected a valid integer, found True"),
        ("101011111", "101011112", "marker_0: expected 9 digits 0 or 1 .*101011112"),
        ('"101011111"', "101011111", "marker_0: expected 9 digits 0 or 1 in quotes"),
        ("000110000", "101011111", "marker_1 is the same as marker_0"),
        ("Bits: 0", "Bits: 2", r"maxCorrectionBits is 2, but .* as few as \d bits, .* allows 0;"),
        ("Bits: 0", "Bits: -1", "maxCorrectionBits: expected greater than or equal to 0, found -1"),
    ],
)
def test_refuses(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in SMALL
    with pytest.raises(InputError, match=rf"mine\.yml: {message}"):
        load_text(tmp_path, SMALL.replace(old, new, 1))


def test_correction_up_to_the_distance_is_accepted(tmp_path: Path) -> None:
    made = generate_family("arena", 4, 8, 5, np.random.default_rng(1))
    save_family(made, tmp_path / "a.yml")
    allowed = (made.minimum_distance() - 1) // 2
    text = (tmp_path / "a.yml").read_text()
    old = f"maxCorrectionBits: {made.correction_bits}"
    accepted = load_family(_written(tmp_path, text.replace(old, f"maxCorrectionBits: {allowed}")))
    assert accepted.correction_bits == allowed
    with pytest.raises(InputError, match=f"which allows {allowed}"):
        load_text(tmp_path, text.replace(old, f"maxCorrectionBits: {allowed + 1}"))


def test_refuses_to_write_what_cannot_be_read(tmp_path: Path) -> None:
    eager = replace(family("4x4_50"), correction_bits=9)
    with pytest.raises(InputError, match=r"a\.yml: maxCorrectionBits is 9"):
        save_family(eager, tmp_path / "a.yml")
    assert not list(tmp_path.iterdir())


def test_border_of_two_cells_has_no_place_in_the_format(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="border of one cell, tag36h11_border2 is laid out"):
        save_family(family("tag36h11_border2"), tmp_path / "a.yml")
    assert not list(tmp_path.iterdir())


def test_resolves_names_and_paths(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    save_family(family("4x4_50"), "mine")
    save_family(family("4x4_50"), "tag36h11")
    assert resolve_family("DICT_5X5_100").name == "5x5_100"
    assert len(resolve_family("mine")) == 50
    assert len(resolve_family("tag36h11")) == 587  # a predefined name goes before a file
    assert len(resolve_family("./tag36h11")) == 50
    assert len(resolve_family(tmp_path / "tag36h11")) == 50


def test_refuses_a_family_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="unknown marker family 'tag99'; there are 4x4_50"):
        resolve_family("tag99")
    with pytest.raises(InputError, match=r"mine\.yml: there is no such file"):
        resolve_family(tmp_path / "mine.yml")

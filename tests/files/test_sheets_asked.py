"""Ids, papers and margins as people write them."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sheet_shapes import TAG

from tagmetry.errors import InputError
from tagmetry.files.sheets import (
    PageSetup,
    Paper,
    format_ids,
    paper_names,
    parse_ids,
    parse_orientation,
    parse_paper,
)


@given(st.lists(st.integers(0, 586), min_size=1, max_size=40))
def test_ids_read_back(ids: list[int]) -> None:
    assert parse_ids(format_ids(ids), TAG) == tuple(ids)


def test_ids_as_promised() -> None:
    assert parse_ids("0-3,30", TAG) == (0, 1, 2, 3, 30)
    assert parse_ids(" ALL ", TAG) == tuple(range(587))
    assert format_ids([0, 1, 2, 5]) == "0-2, 5"


@pytest.mark.parametrize("text", ["", ",", "a", "1-", "-1", "1-2-3", "1.5", "1;2", "9" * 5000])
def test_refuses_what_is_no_list_of_ids(text: str) -> None:
    with pytest.raises(InputError, match="expected ids like 0-23,30 or all, found"):
        parse_ids(text, TAG)


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("3-1", "ids must rise within a range"),
        ("587", "there is no id 587"),
        ("0-999999999", "there is no id 999999999"),
    ],
)
def test_refuses_ids_that_are_not_there(text: str, match: str) -> None:
    with pytest.raises(InputError, match=match):
        parse_ids(text, TAG)


def test_papers() -> None:
    assert parse_paper(" A4 ") == Paper("a4", 0.210, 0.297)
    assert parse_paper("letter").height_m == pytest.approx(0.2794)
    assert parse_paper("100 x 50mm").width_m == pytest.approx(0.1)
    assert set(paper_names()) == {f"a{n}" for n in range(7)} | {"letter", "legal", "tabloid"}


@pytest.mark.parametrize("text", ["", "a7", "210x297", "x", "-1x2mm", "1x2x3mm", "nanxnanmm"])
def test_refuses_unknown_paper_and_lists_those_there_are(text: str) -> None:
    with pytest.raises(InputError, match=r"unknown paper .* there are a0, .* like 210x297mm"):
        parse_paper(text)


@pytest.mark.parametrize("text", ["0x297mm", "1..2x3mm"])
def test_refuses_paper_without_a_size(text: str) -> None:
    with pytest.raises(InputError, match="expected a length above 0"):
        parse_paper(text)


def test_refuses_what_no_file_can_hold() -> None:
    with pytest.raises(InputError, match="up to 5080 mm long, got 6000 mm x 100 mm"):
        parse_paper("600x10cm")


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"margin_m": -0.01}, "margin must be 0 or more"),
        ({"margin_m": float("nan")}, "margin must be 0 or more"),
        ({"quiet_cells": 0}, "quiet zone of at least 1 cell, got 0"),
    ],
)
def test_refuses_a_setup_that_cannot_be(change: dict[str, float], match: str) -> None:
    with pytest.raises(InputError, match=match):
        PageSetup(**change)  # type: ignore[arg-type]


def test_refuses_an_unknown_orientation() -> None:
    with pytest.raises(InputError, match="one of auto, portrait, landscape, got 'sideways'"):
        parse_orientation("sideways")

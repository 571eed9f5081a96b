"""Printing on the page: the same sheets as the command's, bounds, refusals in words."""

import json
from urllib.parse import urlencode

import pytest
from live_server import Served

from tagmetry.errors import InputError
from tagmetry.files.sheets import PageSetup, page_as_svg, pages_as_pdf, parse_paper, sheet_pages
from tagmetry.live.rooms.printing.kinds import KINDS, pages_of
from tagmetry.live.rooms.printing.wishes import MOST_PLACES, Wishes
from tagmetry.markers import family

PAPER = {"paper": "a4", "orientation": "auto", "margin": "10mm", "quiet": "1"}
SHEET = {"kind": "sheet", "family": "tag36h11", "ids": "0-23", "size": "60mm", **PAPER}


def asked(live: Served, path: str, **fields: str) -> tuple[int, dict[str, str], bytes]:
    return live.ask("GET", f"{path}?{urlencode(fields)}")


def wished(kind: str, **changed: str) -> Wishes:
    return Wishes({**PAPER, **KINDS[kind].usual, **changed})


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_a_sheet_before_anything_is_typed(kind: str) -> None:
    assert len(pages_of(kind, wished(kind))) == 1


def test_the_files_are_those_of_the_command(live: Served) -> None:
    pages = sheet_pages(family("tag36h11"), range(24), 0.060, PageSetup())
    assert len(pages) > 1
    status, headers, body = asked(live, "/print/sheet.pdf", **SHEET)
    assert (status, headers["content-type"]) == (200, "application/pdf")
    assert headers["content-disposition"] == 'attachment; filename="tagmetry.pdf"'
    assert body == pages_as_pdf(pages)
    status, headers, body = asked(live, "/print/sheet.svg", **SHEET, page="2")
    assert (status, body.decode()) == (200, page_as_svg(pages[1]))
    assert "tagmetry-2.svg" in headers["content-disposition"]


def test_the_preview_is_the_page_that_is_printed(live: Served) -> None:
    pages = sheet_pages(family("tag36h11"), range(24), 0.060, PageSetup(parse_paper("a3")))
    status, _, body = asked(live, "/print/preview", **{**SHEET, "paper": "a3"}, page="99")
    told = json.loads(body)
    assert (status, told["page"], told["pages"]) == (200, len(pages), len(pages))
    assert told["svg"] == page_as_svg(pages[-1])
    assert (told["width_m"], told["height_m"]) == (pages[-1].width_m, pages[-1].height_m)


def test_what_can_be_chosen_can_be_printed(live: Served) -> None:
    told = json.loads(asked(live, "/print/choices")[2])
    assert set(told["kinds"]) == set(KINDS)
    assert told["families"]["tag36h11"] == len(family("tag36h11")) == 587
    fields = {**told["paper"], **told["kinds"]["charuco"]["usual"]}
    for paper in told["papers"]:
        parse_paper(paper)
    assert asked(live, "/print/preview", kind="charuco", **fields)[0] == 200


REFUSED = [
    ("sheet", {"ids": "0-24x"}, "expected ids like"),
    ("sheet", {"ids": ",".join(["0-586"] * 3)}, f"up to {MOST_PLACES} markers at once, got 1761"),
    ("sheet", {"ids": "587"}, "587"),
    ("sheet", {"ids": "9" * 201}, "expected 1 to 200 characters"),
    ("sheet", {"family": "/etc/passwd"}, "unknown marker family"),
    ("sheet", {"size": "1 light year"}, "size: expected a length"),
    ("sheet", {"size": "-4mm"}, "size: expected a length"),
    ("sheet", {"size": "nan"}, "size: expected a length"),
    ("sheet", {"size": "300mm"}, "the largest size that fits"),
    ("sheet", {"paper": "a99"}, "unknown paper"),
    ("sheet", {"paper": "9999x9999m"}, "paper may be up to"),
    ("sheet", {"orientation": "round"}, "orientation must be one of"),
    ("sheet", {"quiet": "0"}, "quiet: expected a whole number from 1 to 20"),
    ("sheet", {"quiet": "٣"}, "quiet: expected a whole number"),
    ("chessboard", {"columns": "1"}, "columns: expected a whole number from 2 to 100"),
    ("chessboard", {"columns": "100", "rows": "16"}, f"up to {MOST_PLACES} places, got 1600"),
    ("charuco", {"columns": "1e9"}, "columns: expected a whole number"),
    ("charuco", {"size": "30mm"}, "smaller than its square"),
    ("charuco", {"first_id": "-1"}, "first id: expected a whole number from 0"),
    ("grid", {"gap": ""}, "gap: expected 1 to 200 characters"),
    ("circles", {"diameter": "1m"}, "must not touch"),
]


@pytest.mark.parametrize(("kind", "changed", "why"), REFUSED)
def test_what_cannot_be_printed_is_refused_in_words(
    kind: str, changed: dict[str, str], why: str
) -> None:
    with pytest.raises(InputError, match=why.replace("(", r"\(")):
        pages_of(kind, wished(kind, **changed))


def test_a_refusal_reaches_the_page(live: Served) -> None:
    status, headers, body = asked(live, "/print/preview", **{**SHEET, "kind": "poster"})
    assert status == 422
    assert headers["content-type"].startswith("text/plain")
    assert body.decode().startswith("expected one of sheet, charuco")
    assert asked(live, "/print/preview")[0] == 422
    assert asked(live, "/print/sheet.pdf", **{**SHEET, "page": "x"})[0] == 422

"""Answers of the printing room: what there is, what a sheet looks like, and the sheet as a file.

Nothing is kept and nothing is written: whoever may look may print. Sheets are drawn one at a time,
in a thread beside the server's.
"""

from collections.abc import Sequence

from fastapi import Request, Response
from fastapi.responses import JSONResponse

from tagmetry.files.sheets import Page, page_as_svg, pages_as_pdf, paper_names
from tagmetry.live.rooms.printing.kinds import KINDS, pages_of
from tagmetry.live.rooms.printing.wishes import Wishes
from tagmetry.live.rooms.room import Room
from tagmetry.live.rooms.turns import Turns
from tagmetry.markers import family, family_names

_MOST_WAITING = 8
_CHOICES = {
    "kinds": {name: {"label": kind.label, "usual": kind.usual} for name, kind in KINDS.items()},
    "papers": paper_names(),
    "paper": {"paper": "a4", "orientation": "auto", "margin": "10mm", "quiet": "1"},
}


def printing_room() -> Room:
    """Return the room."""
    turns = Turns(_MOST_WAITING, "other sheets are being drawn; try again in a few seconds")
    return Room(
        answers={
            "/print/choices": turns.answer(_choices),
            "/print/preview": turns.answer(_preview),
            "/print/sheet.pdf": turns.answer(_pdf),
            "/print/sheet.svg": turns.answer(_svg),
        }
    )


def _choices(_: Request) -> Response:
    counts = {name: len(family(name)) for name in family_names()}
    return JSONResponse({**_CHOICES, "families": counts})


def _preview(request: Request) -> Response:
    pages, number = _pages(request)
    page = pages[number - 1]
    shown = {"title": page.title, "page": number, "pages": len(pages), "svg": page_as_svg(page)}
    return JSONResponse({**shown, "width_m": page.width_m, "height_m": page.height_m})


def _pdf(request: Request) -> Response:
    pages, _ = _pages(request)
    return _file(pages_as_pdf(pages), "application/pdf", "tagmetry.pdf")


def _svg(request: Request) -> Response:
    pages, number = _pages(request)
    name = "tagmetry.svg" if len(pages) == 1 else f"tagmetry-{number}.svg"
    return _file(page_as_svg(pages[number - 1]).encode(), "image/svg+xml", name)


def _pages(request: Request) -> tuple[Sequence[Page], int]:
    """Return the pages, and the number of the one that is looked at; the last where it is more."""
    texts = dict(request.query_params)
    wishes = Wishes(texts)
    pages = pages_of(texts.get("kind", ""), wishes)
    number = wishes.count("page", most=10**6) if "page" in texts else 1
    return pages, min(number, len(pages))


def _file(content: bytes, kind: str, name: str) -> Response:
    disposition = {"content-disposition": f'attachment; filename="{name}"'}
    return Response(content, media_type=kind, headers=disposition)

"""Answers of the printing room: what there is, what a sheet looks like, and the sheet as a file.

Nothing is kept and nothing is written: whoever may look may print. Sheets are drawn one at a time,
in a thread beside the server's.
"""

import asyncio
from collections.abc import Callable, Sequence

from fastapi import Request, Response
from fastapi.responses import JSONResponse

from tagmetry.errors import InputError
from tagmetry.files.sheets import Page, page_as_svg, pages_as_pdf, paper_names
from tagmetry.live.rooms.printing.kinds import KINDS, pages_of
from tagmetry.live.rooms.printing.wishes import Wishes
from tagmetry.live.rooms.room import Answer, Room
from tagmetry.markers import family, family_names

_MOST_WAITING = 8
_CHOICES = {
    "kinds": {name: {"label": kind.label, "usual": kind.usual} for name, kind in KINDS.items()},
    "papers": paper_names(),
    "paper": {"paper": "a4", "orientation": "auto", "margin": "10mm", "quiet": "1"},
}


def printing_room() -> Room:
    """Return the room."""
    desk = _Desk()
    return Room(
        answers={
            "/print/choices": desk.answer(_choices),
            "/print/preview": desk.answer(_preview),
            "/print/sheet.pdf": desk.answer(_pdf),
            "/print/sheet.svg": desk.answer(_svg),
        }
    )


class _Desk:
    """Draws one sheet at a time; a few may wait."""

    def __init__(self) -> None:
        self._turn, self._waiting = asyncio.Semaphore(1), 0

    def answer(self, draw: Callable[[dict[str, str]], Response]) -> Answer:
        """Return an answer that draws when it is its turn."""

        async def drawn(request: Request) -> Response:
            if self._waiting >= _MOST_WAITING:
                return _words("other sheets are being drawn; try again in a few seconds", 503)
            self._waiting += 1
            try:
                async with self._turn:
                    return await asyncio.to_thread(draw, dict(request.query_params))
            except InputError as error:
                return _words(str(error), 422)
            finally:
                self._waiting -= 1

        return drawn


def _choices(_: dict[str, str]) -> Response:
    counts = {name: len(family(name)) for name in family_names()}
    return JSONResponse({**_CHOICES, "families": counts})


def _preview(texts: dict[str, str]) -> Response:
    pages, number = _pages(texts)
    page = pages[number - 1]
    shown = {"title": page.title, "page": number, "pages": len(pages), "svg": page_as_svg(page)}
    return JSONResponse({**shown, "width_m": page.width_m, "height_m": page.height_m})


def _pdf(texts: dict[str, str]) -> Response:
    pages, _ = _pages(texts)
    return _file(pages_as_pdf(pages), "application/pdf", "tagmetry.pdf")


def _svg(texts: dict[str, str]) -> Response:
    pages, number = _pages(texts)
    name = "tagmetry.svg" if len(pages) == 1 else f"tagmetry-{number}.svg"
    return _file(page_as_svg(pages[number - 1]).encode(), "image/svg+xml", name)


def _pages(texts: dict[str, str]) -> tuple[Sequence[Page], int]:
    """Return the pages, and the number of the one that is looked at; the last where it is more."""
    wishes = Wishes(texts)
    pages = pages_of(texts.get("kind", ""), wishes)
    number = wishes.count("page", most=10**6) if "page" in texts else 1
    return pages, min(number, len(pages))


def _file(content: bytes, kind: str, name: str) -> Response:
    disposition = {"content-disposition": f'attachment; filename="{name}"'}
    return Response(content, media_type=kind, headers=disposition)


def _words(text: str, status: int) -> Response:
    return Response(text, status, media_type="text/plain")

"""Pages into files, by the suffix of the name."""

from collections.abc import Sequence
from pathlib import Path

from tagmetry.errors import InputError
from tagmetry.files.atomic import write_atomically
from tagmetry.files.sheets.page import Page
from tagmetry.files.sheets.pdf import pages_as_pdf
from tagmetry.files.sheets.png import page_as_png
from tagmetry.files.sheets.svg import page_as_svg

_SUFFIXES = (".pdf", ".svg", ".png")


def write_pages(pages: Sequence[Page], path: Path, dpi: float = 600) -> tuple[Path, ...]:
    """Write pages and return the files that were written.

    A PDF holds all pages. SVG and PNG hold one each: with several pages the names get -1, -2, …

    Args:
        pages: At least one page.
        path: Where to; its suffix says what is written: .pdf, .svg or .png.
        dpi: Resolution of a PNG.

    Raises:
        InputError: No such file can be written.
    """
    suffix = path.suffix.lower()
    if suffix not in _SUFFIXES:
        raise InputError(f"cannot write {path.name!r}: a sheet is {', '.join(_SUFFIXES)}")
    if suffix == ".pdf":
        write_atomically(path, pages_as_pdf(pages))
        return (path,)
    paths = _numbered(path, len(pages))
    for page, page_path in zip(pages, paths, strict=True):
        write_atomically(
            page_path, page_as_svg(page) if suffix == ".svg" else page_as_png(page, dpi)
        )
    return paths


def _numbered(path: Path, count: int) -> tuple[Path, ...]:
    if count == 1:
        return (path,)
    return tuple(path.with_name(f"{path.stem}-{i}{path.suffix}") for i in range(1, count + 1))

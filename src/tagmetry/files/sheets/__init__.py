"""Markers, boards and sheets of markers at true scale, as PDF, SVG and PNG."""

from tagmetry.files.sheets.ids import format_ids, parse_ids
from tagmetry.files.sheets.page import Page
from tagmetry.files.sheets.pages import board_page, marker_page, sheet_pages
from tagmetry.files.sheets.paper import (
    PageSetup,
    Paper,
    paper_names,
    parse_orientation,
    parse_paper,
)
from tagmetry.files.sheets.pdf import pages_as_pdf
from tagmetry.files.sheets.png import page_as_png
from tagmetry.files.sheets.svg import page_as_svg
from tagmetry.files.sheets.write import write_pages

__all__ = [
    "Page",
    "PageSetup",
    "Paper",
    "board_page",
    "format_ids",
    "marker_page",
    "page_as_png",
    "page_as_svg",
    "pages_as_pdf",
    "paper_names",
    "parse_ids",
    "parse_orientation",
    "parse_paper",
    "sheet_pages",
    "write_pages",
]

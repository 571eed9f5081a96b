"""Results out and in, and pictures of them."""

from tagmetry.record.formats import open_writer, read_results
from tagmetry.record.jsonl import CutLineWarning, format_line, parse_line
from tagmetry.record.overlay import draw_overlay
from tagmetry.record.overlay_files import open_overlay
from tagmetry.record.result import ImageResult, MarkerResult
from tagmetry.record.whole import Writer

__all__ = [
    "CutLineWarning",
    "ImageResult",
    "MarkerResult",
    "Writer",
    "draw_overlay",
    "format_line",
    "open_overlay",
    "open_writer",
    "parse_line",
    "read_results",
]

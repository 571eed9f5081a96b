"""The report: every experiment's results beside the published ones, as one page."""

from tagmetry.lab.report.chapter import Chapter, chapters
from tagmetry.lab.report.page import page
from tagmetry.lab.report.text import check_lines
from tagmetry.lab.report.write import write_report

__all__ = ["Chapter", "chapters", "check_lines", "page", "write_report"]

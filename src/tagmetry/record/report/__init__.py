"""What reports are made of: figures, tables, and the page that holds them."""

from tagmetry.record.report.figure import ReportFigure
from tagmetry.record.report.table import Cell, ReportTable

__all__ = ["Cell", "ReportFigure", "ReportTable"]

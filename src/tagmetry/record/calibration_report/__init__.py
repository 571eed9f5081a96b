"""A calibration as a page that works offline, as pictures, and as tables."""

from tagmetry.record.calibration_report.facts import CalibrationFacts, NamedPoseError
from tagmetry.record.calibration_report.write import write_figures, write_report, write_tables

__all__ = [
    "CalibrationFacts",
    "NamedPoseError",
    "write_figures",
    "write_report",
    "write_tables",
]

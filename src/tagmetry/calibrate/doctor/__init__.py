"""Is the board in the pictures the one that was asked for? Answers in words, with the right one."""

from tagmetry.calibrate.doctor.advice import BoardAdvice
from tagmetry.calibrate.doctor.diagnose import diagnose_board
from tagmetry.calibrate.doctor.scale import SPANS, check_measured, check_print_aspect

__all__ = [
    "SPANS",
    "BoardAdvice",
    "check_measured",
    "check_print_aspect",
    "diagnose_board",
]

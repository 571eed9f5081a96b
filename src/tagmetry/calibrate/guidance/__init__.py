"""Which view of the board to take next, which to take at all, and when there are enough."""

from tagmetry.calibrate.guidance.candidates import HoldingLimits
from tagmetry.calibrate.guidance.evidence import Evidence, measure
from tagmetry.calibrate.guidance.gate import GateLimits
from tagmetry.calibrate.guidance.knowledge import Knowledge, rough_camera
from tagmetry.calibrate.guidance.next_view import NextView, next_view
from tagmetry.calibrate.guidance.plan import Plan
from tagmetry.calibrate.guidance.select import most_informative
from tagmetry.calibrate.guidance.session import Outcome, Session
from tagmetry.calibrate.guidance.verdict import Verdict, verdict
from tagmetry.calibrate.guidance.words import describe

__all__ = [
    "Evidence",
    "GateLimits",
    "HoldingLimits",
    "Knowledge",
    "NextView",
    "Outcome",
    "Plan",
    "Session",
    "Verdict",
    "describe",
    "measure",
    "most_informative",
    "next_view",
    "rough_camera",
    "verdict",
]

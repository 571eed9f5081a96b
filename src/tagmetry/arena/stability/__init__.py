"""How safely a robot follows another: margins of the loop, and the air left between the two."""

from tagmetry.arena.stability.ideal_drive import ideal_gaps_m
from tagmetry.arena.stability.loop import Loop, Margins
from tagmetry.arena.stability.report import (
    StabilityReport,
    seed_course,
    stability,
    stability_by_delay,
)
from tagmetry.arena.stability.setting import FollowingSetting

__all__ = [
    "FollowingSetting",
    "Loop",
    "Margins",
    "StabilityReport",
    "ideal_gaps_m",
    "seed_course",
    "stability",
    "stability_by_delay",
]

"""An arena of simulated robots that goes through the real pipeline and the real packets."""

from tagmetry.pipeline.arena_twin.eyes import CornerEye, Eye, PictureEye
from tagmetry.pipeline.arena_twin.run import Moment, TwinArena
from tagmetry.pipeline.arena_twin.scenario import Radio, Scenario, TwinRobot

__all__ = [
    "CornerEye",
    "Eye",
    "Moment",
    "PictureEye",
    "Radio",
    "Scenario",
    "TwinArena",
    "TwinRobot",
]

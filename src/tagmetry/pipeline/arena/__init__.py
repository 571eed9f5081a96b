"""The running arena: images in, the state of all robots out, to whoever takes it."""

from tagmetry.pipeline.arena.calibrate import calibrate_arena
from tagmetry.pipeline.arena.latency import Latency
from tagmetry.pipeline.arena.measurement import ArenaMeasurement, ArenaResult, Beside
from tagmetry.pipeline.arena.posted import Posted
from tagmetry.pipeline.arena.run import run_arena
from tagmetry.pipeline.arena.stage_times import StageTimes
from tagmetry.pipeline.arena.taker import Taker
from tagmetry.pipeline.arena.turning import Turn, Turning

__all__ = [
    "ArenaMeasurement",
    "ArenaResult",
    "Beside",
    "Latency",
    "Posted",
    "StageTimes",
    "Taker",
    "Turn",
    "Turning",
    "calibrate_arena",
    "run_arena",
]

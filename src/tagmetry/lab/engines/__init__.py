"""Detectors to compare: ours and the peers, behind one interface, each in its own process."""

from tagmetry.lab.engines.child import Child, Failure, Patience
from tagmetry.lab.engines.engine import Engine, EngineKind, Found
from tagmetry.lab.engines.kinds import OURS, TRACKER, chosen, engine_names, installed, missing
from tagmetry.lab.engines.worker import Answer

__all__ = [
    "OURS",
    "TRACKER",
    "Answer",
    "Child",
    "Engine",
    "EngineKind",
    "Failure",
    "Found",
    "Patience",
    "chosen",
    "engine_names",
    "installed",
    "missing",
]

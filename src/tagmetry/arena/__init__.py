"""Robots seen from above: where they are, what each may know, and when they have to stop."""

from tagmetry.arena.world_state import STATE_NAMES, RobotState, WorldState

__all__ = ["STATE_NAMES", "RobotState", "WorldState"]

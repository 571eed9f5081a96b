"""An arena's results as lines of JSON, here and on other computers."""

import json
from collections.abc import Callable

import numpy as np

from tagmetry.arena import ArenaStep, Decision, RobotState, Told
from tagmetry.link import Command
from tagmetry.link.computers import ArenaSight
from tagmetry.pipeline.arena.measurement import ArenaResult


class LineTaker:
    """Hands every result on as a line of JSON, without its end."""

    def __init__(self, write: Callable[[str], object]) -> None:
        self._write = write

    def take(self, result: ArenaResult) -> None:
        """Write one line."""
        self._write(arena_line(result))

    def close(self) -> None:
        """Nothing comes last."""


def arena_line(result: ArenaResult) -> str:
    """Return a result as JSON: robots with their standard deviations, and what happened."""
    line: dict[str, object] = {
        "sequence": result.image.sequence,
        "time_s": result.world.time_s,
        "robots": [_robot(state) for state in result.world],
        "stopped": [_decision(one) for one in result.decisions if one.must_stop],
    }
    if result.told:
        line["told"] = [_told(one) for one in result.told]
    line.update(_happened(result.step))
    return json.dumps(line, allow_nan=False, separators=(",", ":"))


def sight_line(sight: ArenaSight) -> str:
    """Return what another computer sees as JSON; times are the clock of the arena's computer."""
    line: dict[str, object] = {
        "sequence": sight.image,
        "time_s": sight.world.time_s,
        "robots": [_robot(state) for state in sight.world],
        "held": sorted(sight.held),
        "stop_for_all": sight.is_stopped,
        "commanded": [_commanded(*item) for item in sorted(sight.commanded.items())],
    }
    return json.dumps(line, allow_nan=False, separators=(",", ":"))


def _robot(state: RobotState) -> dict[str, object]:
    deviations = np.sqrt(np.maximum(np.diag(state.covariance), 0.0))
    return {
        "id": state.id,
        "name": state.name,
        "x_m": _short(state.x_m),
        "y_m": _short(state.y_m),
        "heading_rad": _short(state.heading_rad),
        "speed_mps": _short(state.speed_mps),
        "turn_rate_radps": _short(state.turn_rate_radps),
        "deviations": [_short(value) for value in deviations.tolist()],
        "age_s": _short(state.age_s),
        "seen": state.seen,
    }


def _commanded(robot_id: int, one: Command) -> dict[str, object]:
    return {
        "id": robot_id,
        "forward_mps": _short(one.forward_mps),
        "turn_radps": _short(one.turn_radps),
        "valid_for_ms": one.valid_for_ms,
    }


def _told(one: Told) -> dict[str, object]:
    neighbours = [
        {
            "id": near.id,
            "range_m": _short(near.range_m),
            "bearing_rad": _short(near.bearing_rad),
            "relative_heading_rad": _short(near.relative_heading_rad),
        }
        for near in one.neighbours
    ]
    obstacles = [
        {
            "name": near.name,
            "range_m": _short(near.range_m),
            "bearing_rad": _short(near.bearing_rad),
        }
        for near in one.obstacles
    ]
    return {"id": one.robot_id, "neighbours": neighbours, "obstacles": obstacles}


def _decision(one: Decision) -> dict[str, object]:
    return {"id": one.robot_id, "reasons": list(one.reasons)}


def _happened(step: ArenaStep) -> dict[str, object]:
    """Return what only some images have to tell."""
    told: dict[str, object] = {}
    if step.events:
        told["events"] = [
            {"kind": one.kind, "id": one.robot_id, "told": one.told} for one in step.events
        ]
    if step.bump is not None and (step.bump.is_moved or step.bump.moved_markers):
        told["floor"] = step.bump.told
    if step.strangers:
        told["strangers"] = [{"family": key.family, "id": key.id} for key in step.strangers]
    return told


def _short(value: float) -> float:
    """Return a number to a micrometre or a microradian."""
    return round(value, 6)

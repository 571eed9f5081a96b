"""Where all robots are, as a recording holds it."""

import numpy as np

from tagmetry.arena import RobotState, WorldState
from tagmetry.errors import InputError
from tagmetry.record.line import printable
from tagmetry.record.mcap.plain_json import json_text, parse_object

_NUMBERS = ("x_m", "y_m", "heading_rad", "speed_mps", "turn_rate_radps", "age_s")


def state_text(state: WorldState) -> bytes:
    """Return where all robots are, as it is recorded."""
    return json_text({"time_s": state.time_s, "robots": [_robot(robot) for robot in state.robots]})


def parse_state(text: bytes) -> WorldState:
    """Return where all robots were.

    Raises:
        InputError: It is no state.
    """
    told = parse_object(text)
    try:
        time_s = float(told["time_s"])
        return WorldState(time_s, tuple(_state(robot, time_s) for robot in told["robots"]))
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"expected a recorded state, got something else: {error}") from None


def _robot(robot: RobotState) -> dict[str, object]:
    return {
        "id": robot.id,
        "name": printable(robot.name),
        "x_m": robot.x_m,
        "y_m": robot.y_m,
        "heading_rad": robot.heading_rad,
        "speed_mps": robot.speed_mps,
        "turn_rate_radps": robot.turn_rate_radps,
        "covariance": np.asarray(robot.covariance).tolist(),
        "age_s": robot.age_s,
        "seen": robot.seen,
    }


def _state(told: dict[str, object], time_s: float) -> RobotState:
    covariance = np.asarray(told["covariance"], dtype=float)
    if covariance.shape != (5, 5):
        raise ValueError(f"a covariance of shape {covariance.shape}")
    return RobotState(
        id=int(str(told["id"])),
        name=str(told["name"]),
        covariance=covariance,
        seen=bool(told["seen"]),
        time_s=time_s,
        **{name: _number(told[name]) for name in _NUMBERS},
    )


def _number(told: object) -> float:
    return float("nan") if told is None else float(str(told))

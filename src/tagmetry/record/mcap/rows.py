"""Flat rows, for tables: robots' states and packets."""

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.record.mcap.packets import parse_packet
from tagmetry.record.mcap.states import parse_state

Cell = str | int | float | bool
ColumnType = Literal["float64", "int64", "string", "bool"]

_SD = ("sd_x_m", "sd_y_m", "sd_heading_rad", "sd_speed_mps", "sd_turn_rate_radps")


@dataclass(frozen=True)
class RowKind:
    """One kind of rows.

    Attributes:
        columns: Their names and types.
        parse: Gives the rows of one recorded message.
    """

    columns: Mapping[str, ColumnType]
    parse: Callable[[bytes], Iterator[list[Cell]]]


def _state_rows(text: bytes) -> Iterator[list[Cell]]:
    state = parse_state(text)
    for robot in state.robots:
        numbers: list[Cell] = [robot.x_m, robot.y_m, robot.heading_rad]
        numbers += [robot.speed_mps, robot.turn_rate_radps]
        numbers += np.sqrt(robot.covariance.diagonal().clip(0.0)).tolist()
        yield [state.time_s, robot.id, robot.name, *numbers, robot.age_s, robot.seen]


def _packet_rows(text: bytes) -> Iterator[list[Cell]]:
    packet = parse_packet(text)
    says = json.dumps(packet.says, separators=(",", ":")) if packet.says is not None else ""
    direction = "in" if packet.is_incoming else "out"
    yield [
        packet.time_s,
        packet.robot_id,
        packet.kind,
        direction,
        len(packet.content),
        says,
        packet.content.hex(),
    ]


STATE_ROWS = RowKind(
    {
        "time_s": "float64",
        "robot": "int64",
        "name": "string",
        "x_m": "float64",
        "y_m": "float64",
        "heading_rad": "float64",
        "speed_mps": "float64",
        "turn_rate_radps": "float64",
        **dict.fromkeys(_SD, "float64"),
        "age_s": "float64",
        "seen": "bool",
    },
    _state_rows,
)
PACKET_ROWS = RowKind(
    {
        "time_s": "float64",
        "robot": "int64",
        "kind": "string",
        "direction": "string",
        "size_bytes": "int64",
        "says": "string",
        "content": "string",
    },
    _packet_rows,
)

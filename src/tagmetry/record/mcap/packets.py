"""A packet between host and robot, as a recording holds it."""

import base64
import binascii
from collections.abc import Mapping
from dataclasses import dataclass

from tagmetry.errors import InputError
from tagmetry.record.mcap.plain_json import json_text, parse_object


@dataclass(frozen=True)
class PacketRecord:
    """One packet between host and robot.

    Attributes:
        time_s: When it was sent or accepted, in the host's clock.
        robot_id: To or from which robot.
        kind: What it is about.
        is_incoming: From the robot.
        content: The packet as it went over the wire.
        says: What it says, by name; None where that is not known.
    """

    time_s: float
    robot_id: int
    kind: str
    is_incoming: bool
    content: bytes
    says: Mapping[str, object] | None = None


def packet_text(packet: PacketRecord) -> bytes:
    """Return a packet as it is recorded."""
    return json_text(
        {
            "time_s": packet.time_s,
            "robot": packet.robot_id,
            "kind": packet.kind,
            "incoming": packet.is_incoming,
            "data": base64.b64encode(packet.content).decode("ascii"),
            "says": packet.says,
        }
    )


def parse_packet(text: bytes) -> PacketRecord:
    """Return a packet that was recorded.

    Raises:
        InputError: It is none.
    """
    told = parse_object(text)
    try:
        return PacketRecord(
            float(told["time_s"]),
            int(told["robot"]),
            str(told["kind"]),
            bool(told["incoming"]),
            base64.b64decode(told["data"], validate=True),
            told["says"],
        )
    except (KeyError, TypeError, ValueError, binascii.Error) as error:
        raise InputError(f"expected a recorded packet, got something else: {error}") from None

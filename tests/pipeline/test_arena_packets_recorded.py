"""A recorded packet says in words what its bytes say, made out in the recorder's thread."""

from dataclasses import asdict
from pathlib import Path

import pytest

from tagmetry.link import (
    Command,
    Message,
    Neighbour,
    Neighbours,
    Packet,
    Pose,
    Telemetry,
    packet_message,
)
from tagmetry.link.bodies import pack_body
from tagmetry.link.packet import Header, seal
from tagmetry.record.mcap import PACKETS, Recorder, read_entries
from tagmetry.record.mcap.packets import parse_packet
from tagmetry.record.mcap.plain_json import json_text, parse_object

pytest.importorskip("mcap", reason="recordings need the part arena")

from tagmetry.pipeline.arena.recorded import record_packet

MESSAGES: tuple[Message, ...] = (
    Command(0.5, valid_for_ms=100),
    Pose(1_000_000, 0.25, -0.5, 1.5),
    Neighbours(7, 0.5, (Neighbour(3, 0.25, 1.0, -1.0), Neighbour(4, 0.5, 0.5, 2.0, 0.01))),
    Telemetry(9, (("battery_v", 3.75), ("broken", float("nan")))),
)


@pytest.mark.parametrize("message", MESSAGES, ids=lambda one: type(one).__name__)
def test_a_packet_is_recorded_with_what_it_says(message: Message, tmp_path: Path) -> None:
    kind, body = pack_body(message)
    packet = Packet(1.5, 3, kind, False, seal(bytes(32), Header(kind, 3, 5, 6, 7), body))
    with Recorder(tmp_path / "run.mcap") as recorder:
        record_packet(recorder, packet)
    (entry,) = read_entries(tmp_path / "run.mcap", PACKETS)
    found, said = parse_packet(entry.content), packet_message(packet)
    assert (found.robot_id, found.kind, found.content) == (3, kind.name, packet.content)
    assert said is not None
    assert found.says == parse_object(json_text(asdict(said)))

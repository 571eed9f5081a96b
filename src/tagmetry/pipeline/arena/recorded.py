"""An arena's run into a recording: images, markers, states, and every packet."""

from dataclasses import asdict

from tagmetry.link import Packet, packet_message
from tagmetry.pipeline.arena.measurement import ArenaResult
from tagmetry.record import ImageResult
from tagmetry.record.mcap import PacketRecord, Recorder

LATENCY = "/latency"


class RecorderTaker:
    """Hands results to a recorder; it has a queue and a thread of its own, and never waits."""

    def __init__(self, recorder: Recorder) -> None:
        """Record nothing yet.

        Args:
            recorder: The recorder, which is open; whoever opened it closes it.
        """
        self._recorder = recorder

    def take(self, result: ArenaResult) -> None:
        """Record one image and all that came of it."""
        self._recorder.image(result.image)
        self._recorder.detections(ImageResult.from_image(result.image, result.detections))
        self._recorder.state(result.world)
        self._recorder.note(LATENCY, result.world.time_s, {"image_to_result_s": result.latency_s})

    def close(self) -> None:
        """Nothing comes last."""


def packet_record(packet: Packet) -> PacketRecord:
    """Return a packet as it is recorded, with what it says."""
    message = packet_message(packet)
    says = asdict(message) if message is not None else None
    return PacketRecord(
        packet.time_s, packet.robot_id, packet.kind.name, packet.is_incoming, packet.content, says
    )

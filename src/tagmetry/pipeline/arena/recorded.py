"""An arena's run into a recording: images, markers, states, and every packet."""

from tagmetry.link import Message, Neighbours, Packet, packet_message
from tagmetry.pipeline.arena.measurement import ArenaResult
from tagmetry.record import ImageResult
from tagmetry.record.mcap import PACKETS, PacketRecord, Recorder
from tagmetry.record.mcap.packets import packet_text

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


def record_packet(recorder: Recorder, packet: Packet) -> None:
    """Record a packet and what it says, which is made out in the recorder's thread."""
    recorder.line(PACKETS, packet.time_s, lambda: packet_text(_packet_record(packet)))


def _packet_record(packet: Packet) -> PacketRecord:
    message = packet_message(packet)
    says = _says(message) if message is not None else None
    return PacketRecord(
        packet.time_s, packet.robot_id, packet.kind.name, packet.is_incoming, packet.content, says
    )


def _says(message: Message) -> dict[str, object]:
    """Return a message's numbers by name."""
    numbers: dict[str, object] = dict(vars(message))
    if isinstance(message, Neighbours):
        numbers["seen"] = [vars(one) for one in message.seen]
    return numbers

"""A whole run in one MCAP file: images, detections, states and packets; replayed and exported."""

from tagmetry.record.mcap.export import export_recording
from tagmetry.record.mcap.packets import PacketRecord
from tagmetry.record.mcap.pieces import Entry
from tagmetry.record.mcap.reading import DamagedRecordingWarning, read_entries
from tagmetry.record.mcap.recorder import Recorder
from tagmetry.record.mcap.replay import Replay
from tagmetry.record.mcap.timeline import Timeline
from tagmetry.record.mcap.topics import DETECTIONS, IMAGES, PACKETS, STATES

__all__ = [
    "DETECTIONS",
    "IMAGES",
    "PACKETS",
    "STATES",
    "DamagedRecordingWarning",
    "Entry",
    "PacketRecord",
    "Recorder",
    "Replay",
    "Timeline",
    "export_recording",
    "read_entries",
]

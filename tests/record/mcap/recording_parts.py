"""What the tests record, and what a recording holds."""

import warnings
from pathlib import Path

import numpy as np

from tagmetry.arena import RobotState, WorldState
from tagmetry.camera import Image
from tagmetry.detect import Detection
from tagmetry.record.mcap import (
    DamagedRecordingWarning,
    Entry,
    PacketRecord,
    read_entries,
)

RNG = np.random.default_rng(4)
IMAGE = Image(RNG.integers(0, 255, (48, 64), dtype=np.uint8), 1 / 3, "capture", 7, "cam")
ROBOT = RobotState(3, "blue", 0.1, -0.2, 0.3, 0.4, -0.5, np.diag([1.0, 2, 3, 4, 5]), 0.6, True, 2.5)
STATE = WorldState(2.5, (ROBOT,))
PACKET = PacketRecord(1.25, 3, "POSE", True, bytes(range(256)), {"x_m": 1.0})
SEEN = Detection("tag36h11", 5, np.arange(8.0).reshape(4, 2), np.eye(8), 0, 1.0)


def entries_of(path: Path, *topics: str) -> list[Entry]:
    return list(read_entries(path, *topics))


def contents_of(path: Path, topic: str) -> list[bytes]:
    return [entry.content for entry in read_entries(path, topic)]


def read_damaged(path: Path) -> list[Entry]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DamagedRecordingWarning)
        return entries_of(path)

"""A slow disk delays nobody, and a full one is told."""

import os
import threading
import time
from dataclasses import replace
from pathlib import Path
from typing import BinaryIO

import pytest

from tagmetry.errors import InputError
from tagmetry.record.mcap import (
    Entry,
    Recorder,
    Replay,
)
from tagmetry.record.mcap.pieces import PieceWriter

pytest.importorskip("mcap", reason="recordings need the part arena")

from recording_parts import IMAGE, STATE, read_damaged


class SlowPieces:
    """A disk that takes no piece before it is told to."""

    def __init__(self) -> None:
        self.may_go_on = threading.Event()

    def write(self, _: list[Entry]) -> None:
        self.may_go_on.wait(30.0)

    def finish(self) -> None:
        pass


def test_a_slow_disk_delays_nobody_and_drops_the_oldest(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    disk = SlowPieces()
    monkeypatch.setattr("tagmetry.record.mcap.recorder.PieceWriter", lambda _: disk)
    with Recorder(tmp_path / "run.mcap") as recorder:
        recorder.state(STATE)
        time.sleep(0.5)  # now it writes
        start_s = time.thread_time()
        for n in range(100):
            recorder.image(replace(IMAGE, sequence=n))
        assert time.thread_time() - start_s < 0.05
        assert recorder.dropped_count >= 60
        assert recorder._images[-1][1].sequence == 99
        disk.may_go_on.set()


def test_of_files_nothing_is_dropped(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    with Recorder(path, may_drop=False) as recorder:
        for n in range(200):
            recorder.image(replace(IMAGE, sequence=n))
    assert recorder.dropped_count == 0
    assert [image.sequence for image in Replay(path)] == list(range(200))


class FullDisk:
    """A file on a disk that is full after so many bytes."""

    def __init__(self, file: BinaryIO, room_bytes: int) -> None:
        self._file, self._room_bytes = file, room_bytes

    def write(self, content: bytes) -> int:
        self._room_bytes -= len(content)
        if self._room_bytes < 0:
            self._file.write(content[: len(content) // 2])
            raise OSError(28, "No space left on device")
        return self._file.write(content)

    def __getattr__(self, name: str) -> object:
        return getattr(self._file, name)


def test_a_full_disk_is_told_and_what_was_written_stays_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "run.mcap"
    real = PieceWriter
    monkeypatch.setattr(
        "tagmetry.record.mcap.recorder.PieceWriter", lambda file: real(FullDisk(file, 3000))
    )
    recorder = Recorder(path)
    recorder.__enter__()
    end_s = time.monotonic() + 10
    while recorder.failure is None and time.monotonic() < end_s:
        recorder.note("/noise", 0.0, {"text": os.urandom(40).hex()})
        time.sleep(0.005)
    assert "No space left on device" in str(recorder.failure)
    with pytest.raises(InputError, match=r"recording to .* ended: No space left on device"):
        recorder.__exit__(None, None, None)
    assert path.stat().st_size <= 3000
    assert all(entry.topic == "/noise" for entry in read_damaged(path))


def test_a_disk_that_is_full_from_the_beginning_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = PieceWriter
    monkeypatch.setattr(
        "tagmetry.record.mcap.recorder.PieceWriter", lambda file: real(FullDisk(file, 4))
    )
    with pytest.raises(InputError, match="No space left on device"):
        Recorder(tmp_path / "run.mcap").__enter__()

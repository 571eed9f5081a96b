"""What was recorded is read again, whatever happened to the file; and recording delays nobody."""

import base64
import json
import os
import signal
import subprocess
import sys
import threading
import time
import warnings
from dataclasses import replace
from pathlib import Path
from typing import BinaryIO

import numpy as np
import pytest

from tagmetry.arena import RobotState, WorldState
from tagmetry.camera import Camera, Image, Source
from tagmetry.detect import Detection
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.record import ImageResult, parse_line
from tagmetry.record.mcap import (
    DETECTIONS,
    IMAGES,
    PACKETS,
    STATES,
    DamagedRecordingWarning,
    Entry,
    PacketRecord,
    Recorder,
    Replay,
    read_entries,
)
from tagmetry.record.mcap.packets import parse_packet
from tagmetry.record.mcap.pieces import PieceWriter
from tagmetry.record.mcap.states import parse_state

pytest.importorskip("mcap", reason="recordings need the part arena")

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


def test_all_that_was_taken_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    result = ImageResult.from_image(IMAGE, [SEEN])
    with Recorder(path) as recorder:
        recorder.image(IMAGE)
        recorder.detections(result)
        recorder.state(STATE)
        recorder.packet(PACKET)
        recorder.note("/latency", 0.5, {"total_s": np.float64(0.012), "none": float("nan")})
    assert {entry.topic for entry in entries_of(path)} == {
        *(IMAGES, DETECTIONS, STATES, PACKETS, "/latency")
    }
    (line,) = contents_of(path, DETECTIONS)
    assert parse_line(line).markers[0].detection.corners_px.tolist() == SEEN.corners_px.tolist()
    (told,) = contents_of(path, STATES)
    found = parse_state(told)
    np.testing.assert_array_equal(found.robots[0].covariance, ROBOT.covariance)
    assert vars(replace(found.robots[0], covariance=None)) == vars(replace(ROBOT, covariance=None))
    assert parse_packet(contents_of(path, PACKETS)[0]) == PACKET
    assert json.loads(contents_of(path, "/latency")[0]) == {"total_s": 0.012, "none": None}


@pytest.mark.parametrize("shape", [(1, 1), (48, 64), (48, 64, 3)])
@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_a_lossless_recording_replays_bit_by_bit(
    tmp_path: Path, shape: tuple[int, ...], dtype: type
) -> None:
    path = tmp_path / "run.mcap"
    pixels = [RNG.integers(0, np.iinfo(dtype).max, shape, dtype=dtype) for _ in range(5)]
    images = [Image(p, 0.1 + n / 7, "capture", 2 * n, "cam") for n, p in enumerate(pixels)]
    with Recorder(path, jpeg_quality=None) as recorder:
        for image in images:
            recorder.image(image)
    with Replay(path) as source:
        assert isinstance(source, Source)
        replayed = list(source)
    for sent, got in zip(images, replayed, strict=True):
        np.testing.assert_array_equal(got.pixels, sent.pixels)
        assert got.pixels.dtype == sent.pixels.dtype
        assert replace(got, pixels=None) == replace(sent, pixels=None)


def test_two_replays_of_a_jpeg_recording_are_equal(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    with Recorder(path, jpeg_quality=80) as recorder:
        recorder.image(IMAGE)
    (first,), (second,) = list(Replay(path)), list(Replay(path))
    np.testing.assert_array_equal(first.pixels, second.pixels)
    assert first.time_s == IMAGE.time_s


def test_a_replay_checks_its_camera(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    with Recorder(path) as recorder:
        recorder.image(IMAGE)
    camera = Camera(64, 48, (60.0, 60.0), (31.5, 23.5))
    assert next(iter(Replay(path, camera=camera))).camera is camera
    with pytest.raises(InputError, match="cam: "):
        next(iter(Replay(path, camera=replace(camera, width_px=63))))


def test_the_official_reader_reads_it(tmp_path: Path) -> None:
    from mcap.reader import make_reader

    path = tmp_path / "run.mcap"
    with Recorder(path) as recorder:
        for n in range(40):
            recorder.image(replace(IMAGE, sequence=n))
            recorder.state(STATE)
            time.sleep(0.01)
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        messages = list(reader.iter_messages(topics=[IMAGES]))
    assert summary.statistics.message_count == 80
    assert len(messages) == 40
    schema, channel, message = messages[0]
    assert (schema.name, schema.encoding) == ("foxglove.CompressedImage", "jsonschema")
    assert channel.message_encoding == "json"
    told = json.loads(message.data)
    assert told["timestamp"] == {"sec": 0, "nsec": 333333333}
    assert base64.b64decode(told["data"])[:2] == b"\xff\xd8"
    assert summary.statistics.chunk_count >= 2


def whole_file(path: Path, pieces: int = 4, each: int = 5) -> list[Entry]:
    """Write a file of so many pieces, and return its entries."""
    entries = [Entry("/note", n, n, b'{"n":%d}' % n) for n in range(pieces * each)]
    with path.open("wb") as file:
        writer = PieceWriter(file)
        for start in range(0, len(entries), each):
            writer.write(entries[start : start + each])
        writer.finish()
    return entries


def read_damaged(path: Path) -> list[Entry]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DamagedRecordingWarning)
        return entries_of(path)


def test_a_file_that_is_cut_anywhere_gives_all_whole_pieces(tmp_path: Path) -> None:
    whole, cut = tmp_path / "whole.mcap", tmp_path / "cut.mcap"
    entries = whole_file(whole)
    content = whole.read_bytes()
    read_before = 0
    for size in range(8, len(content), 3):
        cut.write_bytes(content[:size])
        found = read_damaged(cut)
        assert found == entries[: len(found)]
        assert len(found) % 5 == 0
        assert len(found) >= read_before
        read_before = len(found)
    assert read_before == len(entries)


def test_a_cut_file_says_so(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    whole_file(path)
    path.write_bytes(path.read_bytes()[:-1000])
    with pytest.warns(DamagedRecordingWarning, match="cut off or damaged"):
        entries_of(path)


def test_no_flipped_bit_is_taken_for_the_truth(tmp_path: Path) -> None:
    whole, flipped = tmp_path / "whole.mcap", tmp_path / "flipped.mcap"
    entries = whole_file(whole)
    content = bytearray(whole.read_bytes())
    lost = 0
    for place in range(8, len(content), 3):
        content[place] ^= 1 << place % 8
        flipped.write_bytes(content)
        content[place] ^= 1 << place % 8
        found = read_damaged(flipped)
        assert all(entry in entries for entry in found)
        lost += len(found) < len(entries)
    assert lost > len(content) / 9


def test_noise_is_no_recording_and_no_crash(tmp_path: Path) -> None:
    path = tmp_path / "noise.mcap"
    head = b"\x89MCAP0\r\n"
    for size in (0, 1, 9, 100, 3000):
        for _ in range(20):
            path.write_bytes(head + b"\x06" + size.to_bytes(8, "little") + RNG.bytes(size))
            assert read_damaged(path) == []
    path.write_bytes(head + b"\x06" + (2**60).to_bytes(8, "little"))
    with pytest.warns(DamagedRecordingWarning, match="cut off or damaged"):
        assert entries_of(path) == []


def test_a_piece_that_says_it_is_huge_is_not_unpacked(tmp_path: Path) -> None:
    import struct

    import zstandard

    packed = zstandard.ZstdCompressor().compress(bytes(300 * 2**20))
    chunk = struct.pack("<QQQII", 0, 0, 300 * 2**20, 0, 4) + b"zstd"
    body = chunk + len(packed).to_bytes(8, "little") + packed
    path = tmp_path / "bomb.mcap"
    path.write_bytes(b"\x89MCAP0\r\n\x06" + len(body).to_bytes(8, "little") + body)
    assert read_damaged(path) == []


RUNS = """
import os, sys, time
import numpy as np
from tagmetry.camera import Image
from tagmetry.record.mcap import Recorder
pixels = np.random.default_rng(0).integers(0, 255, (48, 64), dtype=np.uint8)
for line in sys.stdin:
    run = os.fork()
    if run:
        print(run, flush=True)
        os.waitpid(run, 0)
        continue
    with Recorder(line.strip()) as recorder:
        for n in range(10**9):
            recorder.image(Image(pixels, time.monotonic(), "arrival", n, "cam"))
            for k in range(5):
                recorder.note("/n", time.monotonic(), {"n": 5 * n + k})
            time.sleep(0.01)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="runs are forked and killed")
@pytest.mark.parametrize(
    "times", [3, pytest.param(200, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_a_killed_run_loses_less_than_a_second(tmp_path: Path, times: int) -> None:
    runs = subprocess.Popen(
        [sys.executable, "-c", RUNS], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    with runs:
        paths = [tmp_path / f"{n}.mcap" for n in range(times)]
        lost_s = [killed(runs, path, RNG.uniform(0.4, 1.0)) for path in paths]
        runs.kill()
    print(f"{times} kills: lost median {np.median(lost_s):.2f} s, most {max(lost_s):.2f} s")
    assert max(lost_s) < 1.0


def killed(runs: subprocess.Popen[str], path: Path, after_s: float) -> float:
    """Kill a run that records, and return how much of its end is missing."""
    assert runs.stdin is not None
    assert runs.stdout is not None
    runs.stdin.write(f"{path}\n")
    runs.stdin.flush()
    number = int(runs.stdout.readline())
    time.sleep(after_s)
    os.kill(number, signal.SIGKILL)
    killed_s = time.monotonic()
    entries = read_damaged(path)
    notes = [json.loads(entry.content)["n"] for entry in entries if entry.topic == "/n"]
    assert notes == list(range(len(notes)))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DamagedRecordingWarning)
        sequences = [image.sequence for image in Replay(path)]
    assert sequences == list(range(len(sequences)))
    return killed_s - max((entry.stamped_ns for entry in entries), default=0) / 1e9


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


def test_what_json_cannot_hold_is_counted_and_passed_over(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    with Recorder(path) as recorder:
        recorder.note("/odd", 0.0, {"object": object()})
        recorder.state(STATE)
    assert recorder.dropped_count == 1
    assert len(entries_of(path)) == 1


def test_an_image_that_is_none_is_passed_over(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    with path.open("wb") as file:
        writer = PieceWriter(file)
        texts = [
            b"",
            b"[]",
            b"{}",
            b'{"data":1}',
            b'{"data":"","tagmetry":{}}',
            b"\xff",
            b"[" * 9999,
        ]
        writer.write([Entry(IMAGES, 1, 1, text) for text in texts])
        writer.finish()
    with pytest.warns(DamagedRecordingWarning, match="passed over an image"):
        assert list(Replay(path)) == []


@pytest.fixture
def without_mcap(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mcap.records", None)


@pytest.mark.usefixtures("without_mcap")
def test_without_the_part_arena_it_says_what_to_install(tmp_path: Path) -> None:
    for attempt in (Recorder, Replay, lambda path: next(read_entries(path))):
        with pytest.raises(MissingExtraError, match=r"pip install 'tagmetry\[arena\]'"):
            attempt(tmp_path / "run.mcap")


def test_refusals(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"ends in .mcap"):
        Recorder(tmp_path / "run.bag")
    with pytest.raises(InputError, match="expected a JPEG quality, 1 to 100, got 0"):
        Recorder(tmp_path / "run.mcap", jpeg_quality=0)
    with pytest.raises(InputError, match="cannot write"), Recorder(tmp_path / "no" / "run.mcap"):
        pass
    with pytest.raises(InputError, match="No such file"):
        Replay(tmp_path / "run.mcap")
    (tmp_path / "text.mcap").write_text("hello")
    with pytest.raises(InputError, match="expected an MCAP file, found something else"):
        Replay(tmp_path / "text.mcap")
    with pytest.raises(InputError, match="expected an MCAP file, found something else"):
        next(read_entries(tmp_path / "text.mcap"))

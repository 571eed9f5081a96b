"""A recording that was cut, flipped or killed still gives all its whole pieces."""

import json
import os
import signal
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.record.mcap import (
    DamagedRecordingWarning,
    Entry,
    Replay,
)
from tagmetry.record.mcap.pieces import PieceWriter

pytest.importorskip("mcap", reason="recordings need the part arena")

from recording_parts import RNG, entries_of, read_damaged


def whole_file(path: Path, pieces: int = 4, each: int = 5) -> list[Entry]:
    """Write a file of so many pieces, and return its entries."""
    entries = [Entry("/note", n, n, b'{"n":%d}' % n) for n in range(pieces * each)]
    with path.open("wb") as file:
        writer = PieceWriter(file)
        for start in range(0, len(entries), each):
            writer.write(entries[start : start + each])
        writer.finish()
    return entries


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
    while not path.exists():  # a run that has not begun records nothing
        time.sleep(0.01)
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


def test_a_recording_without_an_image_is_no_source_of_images(tmp_path: Path) -> None:
    whole_file(tmp_path / "run.mcap")
    with pytest.raises(InputError, match=r"run.mcap: there is no whole image in this recording"):
        list(Replay(tmp_path / "run.mcap"))

"""A recording by its time line: the newest at a moment, as reading it all would find it."""

from pathlib import Path

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.record.mcap import Entry, Timeline, read_entries
from tagmetry.record.mcap.pieces import PieceWriter

pytest.importorskip("mcap", reason="recordings need the part arena")

START_NS = 1_700_000_000_000_000_000
STEP_S = 0.1


def written(path: Path, entries: list[Entry], each: int = 7) -> Path:
    with path.open("wb") as file:
        writer = PieceWriter(file)
        for start in range(0, len(entries), each):
            writer.write(entries[start : start + each])
        writer.finish()
    return path


def steps(count: int) -> list[Entry]:
    """Return entries of two topics in turn, a tenth of a second apart; their own clock restarts."""
    return [
        Entry("/a" if n % 2 else "/b", START_NS + round(1e9 * STEP_S * n), n % 10, b'{"n":%d}' % n)
        for n in range(count)
    ]


def test_finds_what_reading_everything_finds(tmp_path: Path) -> None:
    path = written(tmp_path / "run.mcap", steps(100))
    timeline = Timeline(path)
    assert timeline.length_s == pytest.approx(9.9)
    whole = list(read_entries(path))
    for at_s in np.random.default_rng(0).uniform(-1, 12, 60):
        for topic in ("/a", "/b"):
            before = [
                one
                for one in whole
                if one.topic == topic and one.logged_ns <= START_NS + 1e9 * min(max(at_s, 0), 9.9)
            ]
            assert timeline.newest(topic, at_s) == (before[-1] if before else None)


def test_an_entry_is_found_at_its_own_moment(tmp_path: Path) -> None:
    timeline = Timeline(written(tmp_path / "run.mcap", steps(30)))
    entry = timeline.newest("/a", 1.23)
    assert entry is not None
    assert timeline.seconds(entry) == pytest.approx(1.1)
    assert timeline.newest("/a", timeline.seconds(entry)) == entry
    assert timeline.newest("/nothing", 1.0) is None


def test_what_was_written_a_piece_late_is_found(tmp_path: Path) -> None:
    entries = steps(20)
    late = entries.pop(5)  # logged before the second piece begins, written into it
    entries.insert(9, late)
    timeline = Timeline(written(tmp_path / "run.mcap", entries))
    assert timeline.newest("/a", 0.55) == late


def test_a_cut_file_gives_its_whole_pieces(tmp_path: Path) -> None:
    path = written(tmp_path / "run.mcap", steps(100))
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    timeline = Timeline(path)
    assert 1.0 < timeline.length_s < 9.0
    assert timeline.newest("/a", timeline.length_s) is not None


def test_a_damaged_piece_is_passed_over(tmp_path: Path) -> None:
    path = written(tmp_path / "run.mcap", steps(21))
    content = bytearray(path.read_bytes())
    whole = Timeline(path)
    middle = whole._pieces[1].at + 80  # into the second piece
    content[middle] ^= 0xFF
    path.write_bytes(content)
    timeline = Timeline(path)
    found = timeline.newest("/a", 1.3)
    assert found is not None
    assert timeline.seconds(found) == pytest.approx(0.5)


@pytest.mark.parametrize("content", [b"", b"no recording", b"\x89MCAP0\r\n", b"\x89MCAP0\r\n\x06"])
def test_refuses_what_is_no_recording(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "run.mcap"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"expected an MCAP file|nothing was recorded"):
        Timeline(path)
    with pytest.raises(InputError, match="No such file"):
        Timeline(tmp_path / "other.mcap")


def test_hostile_sizes_are_not_believed(tmp_path: Path) -> None:
    path = written(tmp_path / "run.mcap", steps(21))
    content = path.read_bytes()
    huge = b"\x06" + (2**63 - 1).to_bytes(8, "little")
    path.write_bytes(content[:8] + huge + content[8:])
    with pytest.raises(InputError, match="nothing was recorded"):
        Timeline(path)

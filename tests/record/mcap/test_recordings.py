"""What was recorded is read again, replayed, and refused where it is none."""

import base64
import json
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tagmetry.camera import Camera, Image, Source
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.record import ImageResult, parse_line
from tagmetry.record.mcap import (
    DETECTIONS,
    IMAGES,
    PACKETS,
    STATES,
    DamagedRecordingWarning,
    Entry,
    Recorder,
    Replay,
    read_entries,
)
from tagmetry.record.mcap.images import image_text, parse_image
from tagmetry.record.mcap.packets import parse_packet
from tagmetry.record.mcap.pieces import PieceWriter
from tagmetry.record.mcap.states import parse_state

pytest.importorskip("mcap", reason="recordings need the part arena")

from recording_parts import IMAGE, PACKET, RNG, ROBOT, SEEN, STATE, contents_of, entries_of


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
    assert found.robots[0]._replace(covariance=None) == ROBOT._replace(covariance=None)
    assert parse_packet(contents_of(path, PACKETS)[0]) == PACKET
    assert json.loads(contents_of(path, "/latency")[0]) == {"total_s": 0.012, "none": None}


@pytest.mark.parametrize("source", ["", 'a "quoted" one', '"data":""', "\n\\ü"])
def test_an_image_is_json_whatever_its_source_is_called(source: str) -> None:
    told = json.loads(image_text(replace(IMAGE, source=source), None))
    assert told["tagmetry"]["source"] == source
    assert base64.b64decode(told["data"]).startswith(b"\x89PNG")
    np.testing.assert_array_equal(parse_image(json.dumps(told).encode()).pixels, IMAGE.pixels)


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
    with (
        pytest.warns(DamagedRecordingWarning, match="passed over an image"),
        pytest.raises(InputError, match="no whole image"),
    ):
        list(Replay(path))


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

"""A recording as tables and pictures: every number again, in files that other programs read."""

import csv
import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.arena import RobotState, WorldState
from tagmetry.camera import Image
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.record import ImageResult, read_results
from tagmetry.record.mcap import (
    STATES,
    DamagedRecordingWarning,
    Entry,
    PacketRecord,
    Recorder,
    export_recording,
)
from tagmetry.record.mcap.pieces import PieceWriter

pytest.importorskip("mcap", reason="recordings need the part arena")

PIXELS = np.random.default_rng(1).integers(0, 255, (8, 12), dtype=np.uint8)
SEEN = Detection("tag36h11", 5, np.arange(8.0).reshape(4, 2) / 3, np.eye(8), 0, 1.0)


def robot(number: int, time_s: float) -> RobotState:
    sd = np.diag([0.01, 0.04, 0.09, 0.16, 0.25])
    return RobotState(
        number, f"robot {number}", 0.1, -0.2, 1 / 3, 0.4, -0.5, sd, float("nan"), False, time_s
    )


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("run") / "run.mcap"
    with Recorder(path, jpeg_quality=None) as recorder:
        for n in range(3):
            image = Image(PIXELS, n / 7, "capture", 10 * n, "cam")
            recorder.image(image)
            recorder.detections(ImageResult.from_image(image, [SEEN, SEEN]))
            recorder.state(WorldState(n / 7, (robot(1, n / 7), robot(2, n / 7))))
            recorder.packet(PacketRecord(n / 7, 2, "POSE", n == 1, b"\x00\xff", {"x_m": 0.1}))
    return path


def rows_of(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_tables_in_csv(recording: Path, tmp_path: Path) -> None:
    written = export_recording(recording, tmp_path / "new" / "folder")
    folder = tmp_path / "new" / "folder"
    assert written == {"detections.csv": 3, "states.csv": 3, "packets.csv": 3}
    assert {path.name for path in folder.iterdir()} == set(written)
    states = rows_of(folder / "states.csv")
    assert [(row["robot"], float(row["time_s"])) for row in states] == [
        (str(number), n / 7) for n in range(3) for number in (1, 2)
    ]
    assert [float(states[0][name]) for name in ("x_m", "heading_rad", "sd_y_m")] == [
        0.1,
        1 / 3,
        0.2,
    ]
    assert (states[0]["age_s"], states[0]["seen"], states[0]["name"]) == ("", "0", "robot 1")
    packets = rows_of(folder / "packets.csv")
    assert [row["direction"] for row in packets] == ["out", "in", "out"]
    assert json.loads(packets[0]["says"]) == {"x_m": 0.1}
    assert packets[0]["content"] == "00ff"
    assert len(rows_of(folder / "detections.csv")) == 6


def test_tables_in_parquet(recording: Path, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="Parquet needs its part")
    export_recording(recording, tmp_path, "parquet")
    states = parquet.read_table(tmp_path / "states.parquet").to_pylist()
    assert states[3]["time_s"] == 1 / 7
    assert states[3]["sd_turn_rate_radps"] == 0.5
    assert np.isnan(states[3]["age_s"])
    assert parquet.read_table(tmp_path / "packets.parquet").num_rows == 3
    results = list(read_results(tmp_path / "detections.parquet"))
    np.testing.assert_array_equal(results[1].markers[0].detection.corners_px, SEEN.corners_px)


def test_pictures_by_their_numbers(recording: Path, tmp_path: Path) -> None:
    assert export_recording(recording, tmp_path, images=True)["images"] == 3
    names = sorted(path.name for path in (tmp_path / "images").iterdir())
    assert names == ["00000000.png", "00000010.png", "00000020.png"]
    found = cv2.imread(str(tmp_path / "images" / names[1]), cv2.IMREAD_UNCHANGED)
    np.testing.assert_array_equal(found, PIXELS)


def test_what_is_no_state_is_passed_over(tmp_path: Path) -> None:
    path = tmp_path / "odd.mcap"
    texts = [b"{}", b'{"time_s":0,"robots":[{}]}', b'{"time_s":0,"robots":3}', b'{"time_s":null}']
    with path.open("wb") as file:
        writer = PieceWriter(file)
        writer.write([Entry(STATES, 1, 1, text) for text in texts])
        writer.finish()
    with pytest.warns(DamagedRecordingWarning, match="expected a recorded state"):
        assert export_recording(path, tmp_path) == {"states.csv": 0}


def test_refusals(recording: Path, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file"):
        export_recording(tmp_path / "none.mcap", tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot write"):
        export_recording(recording, tmp_path / "file")

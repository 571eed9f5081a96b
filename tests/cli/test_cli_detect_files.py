"""`tagmetry detect`: what it writes: lines, tables, trajectories, overlays, videos."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from cli_command import Scene
from detect_command import lines_of, measured

from tagmetry.cli.main import run
from tagmetry.record import CutLineWarning, read_results
from tagmetry.twin import showcase


@pytest.mark.parametrize("suffix", [".jsonl", ".parquet"])
def test_files_hold_what_json_says(
    suffix: str, scene: Scene, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    out = tmp_path / f"out{suffix}"
    assert run(measured(scene, "--size", "0.12", "--out", str(out))) == 0
    (line,) = lines_of(capsys)
    (result,) = read_results(out)
    for marker, told in zip(result.markers, line["markers"], strict=True):
        np.testing.assert_array_equal(marker.detection.corners_px, told["corners_px"])
        translation_m = marker.pose.best.T_camera_marker.translation
        np.testing.assert_allclose(translation_m, told["poses"][0]["translation_m"], rtol=1e-15)
    assert [path.name for path in tmp_path.iterdir()] == [out.name]


def test_a_table_has_a_row_for_every_marker(scene: Scene, tmp_path: Path) -> None:
    out = tmp_path / "out.csv"
    assert run(measured(scene, "--size", "0.12", "--out", str(out))) == 0
    header, *rows = out.read_text().splitlines()
    column = header.split(",").index("id")
    assert [int(row.split(",")[column]) for row in rows] == list(scene.ids)


def test_a_trajectory_is_of_the_chosen_marker(scene: Scene, tmp_path: Path) -> None:
    out = tmp_path / "out.tum"
    options = ["--size", "0.12", "--out", str(out), "--marker", "tag36h11:3"]
    assert run([*measured(scene, *options)]) == 0
    comment, line = out.read_text().splitlines()
    assert comment.startswith("# T_camera_marker")
    (marker,) = (m for m in showcase.markers() if m.id == 3)
    T_camera_marker = showcase.T_camera_wall * marker.T_body_marker
    np.testing.assert_allclose(
        [float(x) for x in line.split()[1:4]], T_camera_marker.translation, atol=1e-3
    )


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ([], "choose one of tag36h11 0, tag36h11 1"),
        (["--marker", "3"], "expected a marker like tag36h11:7, found '3'"),
        (["--marker", "tag36h11:²"], "expected a marker like tag36h11:7"),
        (["--marker", "tag36h11:99"], "no pose of tag36h11 99 in any image"),
    ],
)
def test_a_trajectory_of_no_one_marker_is_refused(
    options: list[str], text: str, scene: Scene, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    out = ["--out", str(tmp_path / "out.tum")]
    assert run(measured(scene, "--size", "0.12", *out, *options)) == 2
    assert text in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", [".png", ".jpg"])
def test_an_overlay_is_drawn_over_the_picture(suffix: str, scene: Scene, tmp_path: Path) -> None:
    path = tmp_path / f"overlay{suffix}"
    assert run(measured(scene, "--size", "0.12", "--overlay", str(path), "--cube")) == 0
    before, after = cv2.imread(scene.picture), cv2.imread(str(path))
    assert after.shape == before.shape
    coloured = np.ptp(after.astype(int), axis=2) > 60
    assert 0.002 < coloured.mean() < 0.2
    assert np.abs(after.astype(int) - before)[~coloured].mean() < 5


def write_video(path: Path, picture: str, count: int) -> None:
    """Write a moving picture at 25 images a second."""
    pixels = cv2.imread(picture)[: 2 * 180, : 2 * 320]
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"mp4v"), 25.0, (640, 360))
    for shift in range(count):
        writer.write(np.roll(pixels, shift, axis=1))
    writer.release()


def test_a_video_goes_in_and_out(
    scene: Scene, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    video, overlay = tmp_path / "in.mp4", tmp_path / "out.mp4"
    write_video(video, scene.picture, 6)
    assert run(["detect", str(video), "--json", "--overlay", str(overlay)]) == 0
    lines = lines_of(capsys)
    np.testing.assert_allclose([line["time_s"] for line in lines], np.arange(6) / 25, atol=1e-4)
    left = [line["markers"][0]["corners_px"][0][0] for line in lines]
    np.testing.assert_allclose(np.diff(left), 1.0, atol=0.1)
    capture = cv2.VideoCapture(str(overlay))
    assert capture.get(cv2.CAP_PROP_FRAME_COUNT) == 6
    assert capture.read()[1].shape == (360, 640, 3)


def test_half_a_line_is_never_written(scene: Scene, tmp_path: Path) -> None:
    out = tmp_path / "out.jsonl"
    missing = str(tmp_path / "missing.png")
    assert run(["detect", scene.picture, missing, "--out", str(out)]) == 2
    assert len(list(read_results(out))) == 1  # what was measured before is kept; no warning
    out.write_bytes(out.read_bytes()[:-50])
    with pytest.warns(CutLineWarning):
        assert list(read_results(out)) == []

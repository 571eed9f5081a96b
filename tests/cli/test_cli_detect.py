"""`tagmetry detect`: the contract that other programs rely on."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from cli_command import Scene, tagmetry
from detect_command import lines_of, measured

from tagmetry.cli.main import run
from tagmetry.geometry import mahalanobis_squared, pose_difference
from tagmetry.geometry.transforms import RigidTransform, Rotation
from tagmetry.twin import showcase

IMAGE_KEYS = {"source", "sequence", "time_s", "width", "height", "markers"}
MARKER_KEYS = {"family", "id", "corners_px", "corners_cov_px2", "hamming"}
POSE_KEYS = {"rotation_xyzw", "translation_m", "covariance", "reprojection_rms_px", "probability"}
MORE_KEYS = {"time_kind", "confidence", "is_inverted", "touches_border", "is_duplicate", "size_m"}


def test_a_line_has_the_keys_and_shapes_of_the_contract(
    scene: Scene, capsys: pytest.CaptureFixture
) -> None:
    assert run(measured(scene, "--size", "0.12")) == 0
    (line,) = lines_of(capsys)
    assert set(line) - MORE_KEYS == IMAGE_KEYS
    assert (line["source"], line["sequence"], line["time_s"]) == (scene.picture, 0, 0.0)
    assert (line["width"], line["height"]) == (1280, 720)
    assert [marker["id"] for marker in line["markers"]] == list(scene.ids)
    for marker in line["markers"]:
        assert set(marker) - MORE_KEYS == {*MARKER_KEYS, "poses"}
        assert marker["family"] == "tag36h11"
        assert np.shape(marker["corners_px"]) == (4, 2)
        covariance = np.array(marker["corners_cov_px2"])
        assert covariance.shape == (8, 8)
        assert np.linalg.eigvalsh(covariance).min() > 0
        for pose in marker["poses"]:
            assert set(pose) - {"chi2"} == POSE_KEYS
            assert np.shape(pose["covariance"]) == (6, 6)


def test_poses_are_where_the_markers_are(scene: Scene, capsys: pytest.CaptureFixture) -> None:
    assert run(measured(scene, "--size", "120mm")) == 0
    (line,) = lines_of(capsys)
    truth = {m.id: showcase.T_camera_wall * m.T_body_marker for m in showcase.markers()}
    for marker in line["markers"]:
        best = marker["poses"][0]
        rotation = Rotation.from_quat(best["rotation_xyzw"])
        T_camera_marker = RigidTransform.from_components(best["translation_m"], rotation)
        error = pose_difference(T_camera_marker, truth[marker["id"]])
        assert np.linalg.norm(error[:3]) < 0.001
        assert mahalanobis_squared(error, np.array(best["covariance"])) < 4.5**2
        probabilities = [pose["probability"] for pose in marker["poses"]]
        assert probabilities == sorted(probabilities, reverse=True)
        assert sum(probabilities) == pytest.approx(1)


def test_sizes_by_id_give_poses_to_those_ids_only(
    scene: Scene, capsys: pytest.CaptureFixture
) -> None:
    assert run(measured(scene, "--size", "0=0.12,3=24cm")) == 0
    markers = {marker["id"]: marker for marker in lines_of(capsys)[0]["markers"]}
    assert {number for number, marker in markers.items() if "poses" in marker} == {0, 3}
    T = {m.id: showcase.T_camera_wall * m.T_body_marker for m in showcase.markers()}
    np.testing.assert_allclose(markers[0]["poses"][0]["translation_m"], T[0].translation, atol=1e-3)
    np.testing.assert_allclose(
        markers[3]["poses"][0]["translation_m"], 2 * T[3].translation, atol=2e-3
    )


@pytest.mark.parametrize(
    ("given", "lacking"), [(["--size", "0.12"], "camera"), (["--camera"], "size")]
)
def test_a_size_or_camera_alone_is_hinted_at(
    given: list[str], lacking: str, scene: Scene, capsys: pytest.CaptureFixture
) -> None:
    options = given if lacking == "camera" else [*given, scene.camera]
    assert run(["detect", scene.picture, "--json", *options]) == 0
    out, err = capsys.readouterr()
    assert all("poses" not in marker for marker in json.loads(out)["markers"])
    assert err == "tagmetry: no poses: they need both --size and --camera\n"


def test_several_families_in_one_pass(scene: Scene, capsys: pytest.CaptureFixture) -> None:
    families = ["--family", "aruco_mip_36h12", "--family", "tag36h11", "--family", "5x5_100"]
    assert run(["detect", scene.picture, "--json", *families]) == 0
    assert [m["id"] for m in lines_of(capsys)[0]["markers"]] == list(scene.ids)
    assert run(["detect", scene.picture, "--json", *families[:2]]) == 0
    assert lines_of(capsys)[0]["markers"] == []


def test_sources_are_numbered_through(small_picture: Path, capsys: pytest.CaptureFixture) -> None:
    pictures = [str(small_picture)] * 3
    assert run(["detect", *pictures, str(small_picture.parent), "--json"]) == 0
    assert [line["sequence"] for line in lines_of(capsys)] == [0, 1, 2, 3]
    assert run(["detect", *pictures, "--json", "--limit", "2"]) == 0
    assert [line["sequence"] for line in lines_of(capsys)] == [0, 1]


@pytest.mark.parametrize("options", [["--json"], ["--out", "-"], ["--out", "-", "--json"]])
def test_standard_output_is_json_lines_and_nothing_else(
    options: list[str], small_picture: Path
) -> None:
    done = tagmetry("detect", small_picture, small_picture, "--size", "1", *options)
    assert done.returncode == 0
    lines = done.stdout.splitlines()
    assert [json.loads(line)["sequence"] for line in lines] == [0, 1]
    assert done.stderr.startswith(b"tagmetry: no poses")


def test_explains_what_was_turned_down(scene: Scene, capsys: pytest.CaptureFixture) -> None:
    wrong = ["detect", scene.picture, "--family", "tag25h9", "--explain"]
    assert run(wrong) == 0
    told = [row for row in capsys.readouterr().out.splitlines() if "rejected at" in row]
    assert len(told) >= 7
    assert run([*wrong, "--json"]) == 0
    rejected = lines_of(capsys)[0]["rejected"]
    assert len(rejected) == len(told)
    for row, rejection in zip(told, rejected, strict=True):
        assert row.endswith(rejection["reason"])
        assert np.shape(rejection["corners_px"]) == (4, 2)
        assert rejection["reason"]


def test_without_explain_there_is_no_rejected_list(
    scene: Scene, capsys: pytest.CaptureFixture
) -> None:
    assert run(["detect", scene.picture, "--json"]) == 0
    assert "rejected" not in lines_of(capsys)[0]


def test_min_side_and_forgive_bits_reach_the_detector(
    scene: Scene, capsys: pytest.CaptureFixture
) -> None:
    assert run(["detect", scene.picture, "--json", "--min-side", "120"]) == 0
    ids = {m["id"] for m in lines_of(capsys)[0]["markers"]}
    assert 0 in ids
    assert 2 not in ids
    assert run(["detect", scene.picture, "--json", "--forgive-bits", "0"]) == 0
    assert {m["hamming"] for m in lines_of(capsys)[0]["markers"]} == {0}


def test_inverted_markers_are_found_when_asked_for(
    small_picture: Path, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    path = str(tmp_path / "inverted.png")
    cv2.imwrite(path, 255 - cv2.imread(str(small_picture)))
    assert run(["detect", path, "--json"]) == 0
    assert lines_of(capsys)[0]["markers"] == []
    assert run(["detect", path, "--json", "--inverted"]) == 0
    assert [m["is_inverted"] for m in lines_of(capsys)[0]["markers"]] == [True]


def test_text_says_what_was_found(scene: Scene, capsys: pytest.CaptureFixture) -> None:
    assert run(["detect", scene.picture, "--size", "0.12", "--camera", scene.camera]) == 0
    head, *rows = capsys.readouterr().out.splitlines()
    assert head == f"{scene.picture} [0] 1280x720: 7 markers"
    assert [int(row.split()[1]) for row in rows] == list(scene.ids)
    assert ", z 1005.0" in rows[0]
    assert rows[0].count(" ± ") == 3


@pytest.mark.parametrize("options", [[], ["--json"]])
def test_names_and_signs_that_the_terminal_cannot_show_are_no_fault(
    options: list[str], scene: Scene, small_picture: Path, tmp_path: Path
) -> None:
    odd = tmp_path / "ü\udcff.png"
    odd.write_bytes(small_picture.read_bytes())
    done = tagmetry("detect", odd, *options, PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr) == (0, b"")
    if options:
        assert json.loads(done.stdout)["source"].endswith("ü\\udcff.png")


def test_a_simulated_camera_is_measured_as_a_real_one(capsys: pytest.CaptureFixture) -> None:
    assert run(["detect", "twin:webcam", "--limit", "1", "--json"]) == 0
    (line,) = lines_of(capsys)
    assert [(one["family"], one["id"]) for one in line["markers"]] == [("tag36h11", 7)]


def test_the_file_of_a_scene_is_a_source(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    path = tmp_path / "scene.yaml"
    path.write_text(
        "camera:\n  size_px: [320, 240]\n  field_of_view_deg: 60\n"
        "  at: {translation_m: [0.05, -0.1, 0.3], looking_at_m: [0, 0, 0]}\n"
        "things: [{marker: tag36h11, ids: [7], size: 80mm}]\nimages: 2\n",
        "utf-8",
    )
    assert run(["detect", f"twin:{path}", "--json"]) == 0
    assert [[one["id"] for one in line["markers"]] for line in lines_of(capsys)] == [[7], [7]]


def test_no_limit_is_too_large(small_picture: Path, capsys: pytest.CaptureFixture) -> None:
    assert run(["detect", str(small_picture), f"--limit={10**20}"]) == 0
    assert "[0] 320x240" in capsys.readouterr().out

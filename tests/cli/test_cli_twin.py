"""`tagmetry twin`: pictures and truth as files, whole or not at all."""

import json
import signal
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from cli_command import arguments_of, tagmetry

from tagmetry.cli.main import run
from tagmetry.files import load_camera

SCENE = """\
camera:
  size_px: [160, 120]
  field_of_view_deg: 60
  at: {translation_m: [0, -1, 1], looking_at_m: [0, 0, 1]}
things:
  - {marker: 4x4_50, ids: [3], size: 300mm, at: {translation_m: [0, 0, 1], euler_deg: [90, 0, 0]}}
images: 3
"""


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to be in, with a scene file."""
    monkeypatch.chdir(tmp_path)
    Path("scene.yaml").write_text(SCENE)
    return tmp_path


def lines_of(path: str) -> list[dict]:
    return [json.loads(line) for line in Path(path).read_text().splitlines()]


def test_a_folder_of_pictures_with_their_truth(place: Path, capsys) -> None:
    assert run(["twin", "render", "scene.yaml", "--out", "made"]) == 0
    assert "wrote 3 pictures -> made, made/truth.jsonl, made/camera.yaml" in capsys.readouterr().out
    names = [f"00000{number}.png" for number in range(3)]
    assert sorted(path.name for path in Path("made").iterdir()) == [
        *names, "camera.yaml", "truth.jsonl",
    ]  # fmt: skip
    truth = lines_of("made/truth.jsonl")
    assert [line["source"] for line in truth] == names
    assert truth[1]["time_s"] == pytest.approx(1 / 30)
    assert load_camera("made/camera.yaml").focal_px[0] == truth[0]["camera"]["focal_px"][0]
    (marker,) = truth[2]["markers"]
    half_px = 0.15 * 80 / np.tan(np.radians(30))
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half_px + [79.5, 59.5]
    np.testing.assert_allclose(marker["corners_px"], square, atol=1e-9)


def test_what_is_rendered_is_found_at_the_truth(place: Path, capsys) -> None:
    assert run(["twin", "render", "scene.yaml", "--out=one.png", "--images=1"]) == 0
    assert run(["detect", "one.png", "--family=4x4_50", "--out=found.jsonl"]) == 0
    (found,) = lines_of("found.jsonl")[0]["markers"]
    (true,) = lines_of("one.truth.jsonl")[0]["markers"]
    error_px = np.subtract(found["corners_px"], true["corners_px"])
    assert np.linalg.norm(error_px, axis=1).max() < 0.05


def test_a_video_with_truth_as_one_document(place: Path) -> None:
    assert run(["twin", "render", "scene.yaml", "--out=made.mp4", "--truth=t.json"]) == 0
    assert cv2.VideoCapture("made.mp4").get(cv2.CAP_PROP_FRAME_COUNT) == 3
    assert [one["sequence"] for one in json.loads(Path("t.json").read_text())["images"]] == [
        0,
        1,
        2,
    ]


def test_more_than_8_bits_fill_16(place: Path) -> None:
    deep = SCENE.replace("things:", "  sensor: {bits: 12}\nthings:")
    Path("deep.yaml").write_text(deep)
    assert run(["twin", "render", "deep.yaml", "--out=deep.png", "--images=1"]) == 0
    pixels = cv2.imread("deep.png", cv2.IMREAD_UNCHANGED)
    assert pixels.dtype == np.uint16
    assert pixels.max() > 30_000
    assert (pixels % 16 == 0).all()


def test_a_seed_decides_the_noise_and_jobs_do_not(place: Path) -> None:
    for out, *options in (["a"], ["b", "--jobs=2"], ["c", "--seed=1"]):
        assert run(["twin", "render", "scene.yaml", "--out", out, *options]) == 0
    a, b, c = (Path(name, "000002.png").read_bytes() for name in "abc")
    assert a == b != c
    assert Path("a/truth.jsonl").read_bytes() == Path("b/truth.jsonl").read_bytes()


def test_the_list_names_the_ready_made_scenes(capsys) -> None:
    assert run(["twin", "list"]) == 0
    told = capsys.readouterr().out
    for name in ("floor", "wall", "arena", "corridor", "room", "board-sweep", "backlit-window"):
        assert f"{name}: " in told


BAD = {
    ("missing.yaml", "--out=o"): "missing.yaml: there is no such file",
    ("attic", "--out=o"): "there is no ready-made scene 'attic'; there are floor, ",
    ("wall", "--out=o", "--set=color=red"): "wall has no parameter 'color'",
    ("wall", "--out=o", "--set=columns"): "expected --set NAME=VALUE like robots=20",
    ("wall", "--out=o", "--set=columns=x"): "columns: expected a whole number, found 'x'",
    ("scene.yaml", "--out=o", "--set=columns=1"): "--set is for ready-made scenes",
    ("scene.yaml", "--out=o.gif"): "expected a folder, or a file ending in .png or .mp4",
    ("scene.yaml", "--out=o.png"): "o.png holds one picture and the scene has 3",
    ("scene.yaml", "--out=scene.yaml"): "expected a folder, or a file ending in",
    ("scene.yaml", "--out=no/o.mp4"): "cannot write no/o.truth.jsonl",
    ("scene.yaml", "--out=/proc/o"): "cannot write /proc/o",
    ("scene.yaml", "--out=o.mp4", "--truth=t.txt"): "expected a file ending in .json or .jsonl",
    ("scene.yaml", "--out=o.png", "--images=1", "--truth=no/t.jsonl"): "cannot write no/t.jsonl",
    ("scene.yaml", "--out=o.png", "--images=1", "--truth=no/t.json"): "cannot write no/t.json",
    ("scene.yaml", "--out=o", "--images=0"): "'--images'",
    ("scene.yaml", "--out=o", "--jobs=0"): "'--jobs'",
    ("scene.yaml", "--out=o", "--images=1000000"): "expected 1 to 100000 images",
    ("scene.yaml",): "Missing option '--out'",
}


@pytest.mark.parametrize("arguments", BAD)
def test_bad_input_is_told_in_one_line_and_leaves_nothing(
    arguments: tuple[str, ...], place: Path, capsys
) -> None:
    assert run(["twin", "render", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("tagmetry: ")
    assert err.count("\n") == 1
    assert BAD[arguments] in err
    assert [path.name for path in place.iterdir()] == ["scene.yaml"]


def test_pictures_of_another_run_are_not_mixed_with_new_ones(place: Path, capsys) -> None:
    assert run(["twin", "render", "scene.yaml", "--out=made"]) == 0
    assert run(["twin", "render", "scene.yaml", "--out=made"]) == 0  # the same ones anew
    assert run(["twin", "render", "scene.yaml", "--out=made", "--images=2"]) == 2
    assert "made holds 000002.png, which is none of these 2 pictures" in capsys.readouterr().err


@pytest.mark.skipif(sys.platform == "win32", reason="sends a signal")
def test_ctrl_c_keeps_what_is_finished(place: Path) -> None:
    python, *rest = arguments_of("twin", "render", "scene.yaml", "--out=made", "--images=5000")
    process = subprocess.Popen([python, *rest], stderr=subprocess.PIPE, stdout=subprocess.PIPE)
    while not Path("made/000002.png").exists():
        assert process.poll() is None
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (130, b"", b"tagmetry: interrupted\n")
    truth = lines_of("made/truth.jsonl")
    pictures = sorted(path.name for path in Path("made").glob("*.png"))
    assert 2 < len(truth) < 5000
    assert [line["source"] for line in truth] == pictures
    assert all(cv2.imread(f"made/{name}") is not None for name in pictures)
    assert not list(Path("made").glob(".*"))


def test_a_process_of_its_own_says_the_same(place: Path) -> None:
    done = tagmetry("twin", "render", "attic", "--out=o")
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr.startswith(b"tagmetry: there is no ready-made scene")

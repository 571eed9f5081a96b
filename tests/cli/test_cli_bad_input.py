"""What cannot be used: one line on standard error, exit code 2, and no file left behind."""

import itertools
import struct
import zlib
from pathlib import Path

import cv2
import numpy as np
import pytest
from cli_command import Scene, tagmetry, usage_of

from tagmetry.cli.main import run


def huge_png() -> bytes:
    """A PNG that declares 50,000 x 50,000 pixels."""
    parts = [
        (b"IHDR", struct.pack(">IIBBBBB", 50_000, 50_000, 8, 0, 0, 0, 0)),
        (b"IDAT", zlib.compress(bytes(1000))),
        (b"IEND", b""),
    ]
    chunks = [
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        for kind, body in parts
    ]
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)


def cut_jpeg() -> bytes:
    noise = np.random.default_rng(0).integers(0, 255, (90, 120), dtype=np.uint8)
    content = cv2.imencode(".jpg", noise)[1].tobytes()
    return content[: len(content) // 2]


def black(height: int, width: int) -> bytes:
    return cv2.imencode(".png", np.zeros((height, width), np.uint8))[1].tobytes()


PICTURES = {
    "empty.png": (b"", "found an empty file"),
    "cut.jpg": (cut_jpeg(), "a JPEG that is cut off"),
    "text.png": (b"no picture\nat all\n", "found text"),
    "one.png": (black(1, 1), "1x1 pixels is too small"),
    "flat.png": (black(1, 640), "640x1 pixels is too small"),
    "tall.png": (black(640, 1), "1x640 pixels is too small"),
    "huge.png": (huge_png(), "50000x50000 pixels is too large"),
    "junk.mp4": (np.random.default_rng(1).bytes(5000), "junk.mp4"),
}
CAMERAS = {
    "cycle.yaml": (b"a: &a\n  b: *a\n", "anchors"),
    "list.yaml": (b"&a [*a]\n", "anchors"),
    "deep.yaml": (b"[" * 100_000, "nested deeper"),
    "deep_map.yaml": (b"{a: " * 100_000 + b"}" * 100_000, "nested deeper"),
    "deep.json": (b"[" * 100_000 + b"]" * 100_000, "nested deeper"),
    "tag.yaml": (b'!!python/object/apply:os.system ["echo taken over"]\n', "is not allowed"),
    "junk.yaml": (b"\xff" + np.random.default_rng(2).bytes(4000), "expected UTF-8 text"),
    "zeros.yaml": (bytes(1000), "NUL"),
    "empty.yaml": (b"", "the file is empty"),
}
SIZES = ["0", "-1", "nan", "inf", "-inf", "7=0", "7=0.1,7=0.2", "", "wide", "7=", "=1", "1e400"]
OPTIONS = {
    "--family=tag99": "unknown marker family 'tag99'; there are 4x4_50, ",
    "--out=out.txt": "expected a file ending in .jsonl, .csv, .parquet, .tum, found .txt",
    "--out=out": "found no suffix",
    "--overlay=out.gif": "expected a file ending in .png, .jpg, .jpeg, .mp4, found .gif",
    "--out=missing/out.jsonl": "cannot write missing/out.jsonl",
    "--out=missing/out.csv": "cannot write missing/out.csv",
    "--out=missing/out.parquet": "cannot write missing/out.parquet",
    "--overlay=missing/out.png": "cannot write missing/out.png",
    "--overlay=missing/out.mp4": "cannot write missing/out.mp4",
    "--out=/proc/out.jsonl": "cannot write /proc/out.jsonl",
    "--overlay=/proc/out.png": "cannot write /proc/out.png",
    "--forgive-bits=-1": "forgive_bits must be 0 or more, got -1",
    "--forgive-bits=9": "forgive_bits must be 0 to 5, which is what tag36h11 can correct",
    "--forgive-bits=few": "'--forgive-bits'",
    "--min-side=nan": "min_side_px must be at least 4, got nan",
    "--min-side=-inf": "min_side_px must be at least 4",
    "--limit=0": "'--limit'",
    "--nonsense": "No such option: --nonsense",
    "--camera=missing.yaml": "missing.yaml",
    "--camera=.": "this is a folder",
}
SOURCES = {
    "missing.png": "no such file, folder or camera: 'missing.png'",
    "missing*.png": "missing*.png",
    "": "got an empty name",
    "a\nb.png": r"'a\nb.png'",
    "99": "camera 99: the camera cannot be opened",
    "999": "expected a camera's number, 0 to 255",
    "/dev/null": "/dev/null: the camera cannot be opened",
    "http://127.0.0.1:9/stream": "http://127.0.0.1:9/stream: cannot be opened: Connection refused",
    "ftp://127.0.0.1/x": "streams of ftp:// are not understood",
    "x" * 5000: "xxx",
}


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to be in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def assert_refused(
    arguments: list[str], text: str, capsys: pytest.CaptureFixture, *left: str
) -> None:
    """Run it here: nothing printed, one line that names the cause, no file but those given."""
    assert run(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("tagmetry: ")
    assert err.endswith("\n")
    assert err.count("\n") == 1
    assert text in err
    assert sorted(path.name for path in Path().iterdir()) == sorted(left)


@pytest.mark.parametrize("name", PICTURES)
@pytest.mark.parametrize("out", ["out.csv", "out.parquet"])
def test_pictures(name: str, out: str, place: Path, capsys: pytest.CaptureFixture) -> None:
    content, text = PICTURES[name]
    Path(name).write_bytes(content)
    assert_refused(["detect", name, "--out", out, "--overlay=o.mp4"], text, capsys, name)


@pytest.mark.parametrize("name", PICTURES)
def test_the_line_names_the_picture(
    name: str, place: Path, small_picture: Path, capsys: pytest.CaptureFixture
) -> None:
    Path(name).write_bytes(PICTURES[name][0])
    assert run(["detect", str(small_picture), name]) == 2
    assert f"tagmetry: {name}" in capsys.readouterr().err


@pytest.mark.parametrize("name", CAMERAS)
def test_camera_files(
    name: str, place: Path, small_picture: Path, capsys: pytest.CaptureFixture
) -> None:
    content, text = CAMERAS[name]
    Path(name).write_bytes(content)
    arguments = ["detect", str(small_picture), "--size=0.1", "--camera", name]
    assert_refused([*arguments, "--out=out.csv"], text, capsys, name)
    assert_refused(["camera", "show", name], text, capsys, name)


def test_a_camera_of_another_resolution(
    scene: Scene, small_picture: Path, place: Path, capsys: pytest.CaptureFixture
) -> None:
    arguments = ["detect", str(small_picture), "--size=0.1", "--camera", scene.camera]
    text = "belong to 1280x720 images, this one is 320x240"
    assert_refused([*arguments, "--out=out.csv"], text, capsys)


@pytest.mark.parametrize("size", SIZES)
def test_sizes(size: str, scene: Scene, place: Path, capsys: pytest.CaptureFixture) -> None:
    arguments = ["detect", scene.picture, "--camera", scene.camera, f"--size={size}"]
    text = "two sizes" if "7=0.2" in size else "expected"
    assert_refused([*arguments, "--out=out.jsonl"], text, capsys)


@pytest.mark.parametrize("option", OPTIONS)
def test_options(
    option: str, small_picture: Path, place: Path, capsys: pytest.CaptureFixture
) -> None:
    assert_refused(["detect", str(small_picture), option], OPTIONS[option], capsys)


@pytest.mark.parametrize("source", SOURCES)
def test_sources(source: str, place: Path, capsys: pytest.CaptureFixture) -> None:
    assert_refused(["detect", source, "--out=out.csv"], SOURCES[source], capsys)


def test_a_folder_without_pictures(place: Path, capsys: pytest.CaptureFixture) -> None:
    Path("empty").mkdir()
    assert_refused(["detect", "empty"], "no pictures in the folder 'empty'", capsys, "empty")


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["detect"], "Missing argument 'SOURCE'"),
        (["camera", "show"], "Missing argument 'CAMERA'"),
        (["frobnicate"], "No such command 'frobnicate'"),
        (["demo", "--seed=-1"], "'--seed'"),
        (["demo", "--out=/proc/demo"], "/proc/demo"),
        (["demo", "--image=missing.png"], "no such file"),
    ],
)
def test_usage(arguments: list[str], text: str, place: Path, capsys: pytest.CaptureFixture) -> None:
    assert_refused(arguments, text, capsys)


@pytest.mark.parametrize("arguments", [[], ["camera"], ["print"], ["print", "board"]])
def test_without_a_command_the_help_is_shown(
    arguments: list[str], capsys: pytest.CaptureFixture
) -> None:
    assert run(arguments) == 2
    out, err = capsys.readouterr()
    assert "Usage: tagmetry" in out
    assert err == ""


@pytest.mark.parametrize(
    "case", [("one.png",), ("text.png",), ("missing.png", "--" + "long" * 60), ("0", "--limit=0")]
)
def test_a_process_of_its_own_says_the_same(case: tuple[str, ...], place: Path) -> None:
    """Nothing is broken into lines for a narrow terminal, and no library adds its own."""
    for name in {"one.png", "text.png"} & set(case):
        Path(name).write_bytes(PICTURES[name][0])
    done = tagmetry("detect", *case, COLUMNS="40", FORCE_COLOR="1")
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr.startswith(b"tagmetry: ")
    assert done.stderr.count(b"\n") == 1
    assert b"\x1b" not in done.stderr


def test_a_huge_picture_is_refused_before_it_is_decoded(place: Path) -> None:
    Path("huge.png").write_bytes(huge_png())
    usage = usage_of("detect", "huge.png")
    assert usage.code == 2
    assert usage.memory_kib < 600 * 1024
    assert usage.cpu_s < 2


def test_no_option_lets_a_random_text_through(
    small_picture: Path, place: Path, capsys: pytest.CaptureFixture
) -> None:
    texts = ["\x00", "\n", "💡", "--", "nan", "1e999", "a" * 3000, "../..", "%s{}"]
    options = ["--family", "--size", "--camera", "--out", "--overlay", "--marker", "--min-side"]
    for option, text in itertools.product(options, texts):
        code = run(["detect", str(small_picture), f"{option}={text}"])
        err = capsys.readouterr().err
        if code == 0:  # a marker without a trajectory to write
            assert option == "--marker"
        else:
            assert code == 2
            assert err.startswith("tagmetry: ")
            assert err.count("\n") == 1
    assert list(place.iterdir()) == []


def test_an_unforeseen_fault_is_shown_as_it_is(
    small_picture: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise ZeroDivisionError("a fault of the program")

    monkeypatch.setattr("tagmetry.cli.report.result_lines", fail)
    with pytest.raises(ZeroDivisionError, match="a fault of the program"):
        run(["detect", str(small_picture)])

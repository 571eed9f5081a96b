"""`tagmetry print`: every subcommand writes its file, refusals are one line and exit code 2."""

import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.cli.main import run
from tagmetry.files import save_family
from tagmetry.markers import generate_family

CHARUCO = ["board", "charuco", "--columns=5", "--rows=6", "--square=30mm", "--size=22mm"]
COMMANDS = {
    "tag36h11, id 7, 120 mm": ["marker", "--id=7", "--size=120mm"],
    "4x4_50, ids 0-23, 30, 40 mm": ["sheet", "--family=4x4_50", "--ids=0-23,30", "--size=4cm"],
    "Grid 3x2, size 50 mm, gap 10 mm, tag36h11 ids 4-9": [
        "board", "grid", "--columns=3", "--rows=2", "--size=0.05", "--gap=1cm", "--first-id=4",
    ],
    "AprilGrid 3x2, size 40 mm, spacing 0.3, tag36h11_border2 ids 0-5": [
        "board", "aprilgrid", "--columns=3", "--rows=2", "--size=40mm",
    ],
    "Chessboard 9x6 inner corners, square 20 mm": [
        "board", "chessboard", "--columns=9", "--rows=6", "--square=20mm",
    ],
    "Asymmetric circles 4x7, pitch 20 mm, diameter 14 mm": [
        "board", "circles", "--columns=4", "--rows=7", "--pitch=20mm", "--diameter=14mm",
        "--asymmetric",
    ],
    "ChArUco 5x6, square 30 mm, size 22 mm, 5x5_250 ids 0-14": CHARUCO,
    "ChArUco 5x6 legacy, square 30 mm, size 22 mm, 5x5_250 ids 0-14": [*CHARUCO, "--legacy"],
}  # fmt: skip


@pytest.mark.parametrize("title", COMMANDS)
def test_writes_what_it_says(title: str, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    out = tmp_path / "sheet.pdf"
    assert run(["print", *COMMANDS[title], "--out", str(out)]) == 0
    pages = 3 if "0-23" in title else 1
    count = "1 page" if pages == 1 else f"{pages} pages"
    assert capsys.readouterr().out == f"wrote {count}: {title} -> {out}\n"
    assert out.read_bytes().count(b"/Type /Page\n") == pages


def test_options_reach_the_page(tmp_path: Path) -> None:
    plain, changed = tmp_path / "plain.png", tmp_path / "changed.png"
    command = ["print", "marker", "--id=7", "--size=30mm", "--dpi=100"]
    assert run([*command, "--out", str(plain)]) == 0
    setup = ["--paper=a5", "--orientation=landscape", "--margin=5mm", "--quiet=3", "--inverted"]
    assert run([*command, *setup, "--out", str(changed)]) == 0
    assert cv2.imread(str(plain)).shape == (1169, 827, 3)
    turned = cv2.imread(str(changed), cv2.IMREAD_GRAYSCALE)
    assert turned.shape == (583, 827)
    assert (turned == 0).sum() > (14 / 8 * 30 / 25.4 * 100) ** 2 * 0.5  # the black quiet zone
    assert (turned[:, :30] < 128).any()  # within the usual margin


def test_many_drawings_are_numbered(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    out = tmp_path / "sheet.svg"
    assert run(["print", "sheet", "--ids=0-29", "--size=40mm", "--out", str(out)]) == 0
    assert f"{tmp_path / 'sheet-1.svg'} to sheet-3.svg" in capsys.readouterr().out
    assert {p.name for p in tmp_path.iterdir()} == {f"sheet-{i}.svg" for i in (1, 2, 3)}


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"--size": "300mm"}, "the largest size that fits is 148 mm"),
        ({"--size": "0"}, "expected a length above 0"),
        ({"--size": "-5mm"}, "expected a length above 0"),
        ({"--size": "nan"}, "expected a length above 0"),
        ({"--size": "big"}, "found 'big'"),
        ({"--id": "587"}, "ids 0 to 586, there is no id 587"),
        ({"--id": "-1"}, "there is no id -1"),
        ({"--family": "tag37"}, "unknown marker family 'tag37'; there are 4x4_50"),
        ({"--paper": "a9"}, "unknown paper 'a9'; there are a0"),
        ({"--orientation": "up"}, "one of auto, portrait, landscape"),
        ({"--quiet": "0"}, "at least 1 cell"),
        ({"--margin": "10cm", "--paper": "a6"}, "too little for the ruler"),
        ({"--out": "marker.gif"}, "a sheet is .pdf, .svg, .png"),
        ({"--out": "none/marker.pdf"}, "there is no folder"),
        ({"--out": "marker.png", "--dpi": "nan"}, "dpi must be 10 to 10000"),
    ],
)
def test_refuses_in_one_line(
    changes: dict[str, str],
    text: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture,
) -> None:
    monkeypatch.chdir(tmp_path)
    options = {"--id": "7", "--size": "50mm", "--out": "marker.pdf", **changes}
    assert run(["print", "marker", *(part for pair in options.items() for part in pair)]) == 2
    said = capsys.readouterr()
    assert text in said.err
    assert said.err.count("\n") == 1
    assert not said.out
    assert not list(tmp_path.iterdir())


def test_help_loads_nothing_heavy() -> None:
    program = (
        "import sys; from tagmetry.cli.main import run; run(['print', 'marker', '--help']);"
        "print(sorted({'cv2', 'numpy', 'scipy', 'reportlab'} & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout.endswith("[]\n")
    assert "--inverted" in done.stdout


def test_prints_a_family_of_ones_own_from_its_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own = generate_family("own", 4, 3, 4, np.random.default_rng(0))
    save_family(own, tmp_path / "own.yaml")
    dictionary, out = str(tmp_path / "own.yaml"), str(tmp_path / "sheet.svg")
    options = ["--family", dictionary, "--ids", "all", "--size", "40mm", "--out", out]
    assert run(["print", "sheet", *options]) == 0
    assert "own, ids 0-2, 40 mm" in capsys.readouterr().out

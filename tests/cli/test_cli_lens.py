"""`tagmetry lens` on the simulated webcam."""

import json
from pathlib import Path

import pytest

from tagmetry.cli.main import run
from tagmetry.files import save_bank
from tagmetry.files.lens import LensFile, law_line, load_lens, save_lens
from tagmetry.lens import DioptreLaw, LogLaw, SplineLaw
from tagmetry.pipeline.lens.twin import webcam_lens


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to be in, with the files of the webcam's lens."""
    monkeypatch.chdir(tmp_path)
    bank = webcam_lens(30.0).bank
    save_bank(bank, "bank.yaml")
    save_lens(LensFile(bank, "bank.yaml", LogLaw(), 0.0016, 0.05, 1.1, 200.0), "lens.yaml")
    return tmp_path


def test_a_marker_is_scanned_for_and_every_image_told(place: Path, capsys) -> None:
    arguments = ["lens", "scan", "twin:webcam", "--lens=lens.yaml", "--size=10mm"]
    assert run([*arguments, "--out=trace.jsonl"]) == 0
    told = capsys.readouterr()
    lines = [json.loads(line) for line in Path("trace.jsonl").read_text().splitlines()]
    assert len(lines) == len(told.out.splitlines())
    assert lines[-1]["is_final"]
    assert lines[-1]["marker"]["depth_m"] == pytest.approx(0.15, rel=2e-3)
    assert "final" in told.out.splitlines()[-1]
    assert "no calibration between focus 0 and 30" in told.err  # the bank's holes


def test_tracking_ends_after_the_images_asked_for(place: Path, capsys) -> None:
    arguments = ["lens", "track", "twin:webcam", "--lens=lens.yaml", "--size=10mm", "--json"]
    assert run([*arguments, "--images=3"]) == 0
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [line["sequence"] for line in lines] == [0, 1, 2]


@pytest.mark.slow
def test_a_focus_curve_grows_by_a_pair_each_time(place: Path, capsys) -> None:
    Path("curve.csv").write_text("depth_m,focus,sd\n0.05,130.1,0.2\n1.0,4.1,0.2\n0.4,42.6,0.2\n")
    arguments = ["lens", "focus-curve", "twin:webcam", "--depth=15cm", "--pairs=curve.csv"]
    assert run([*arguments, "--plot=curve.png"]) == 0
    told = capsys.readouterr().out
    depth_m, focus, _ = Path("curve.csv").read_text().splitlines()[-1].split(",")
    assert float(depth_m) == 0.15
    assert float(focus) == pytest.approx(4 - 42.11 * -1.897, abs=2.0)
    assert "log      rms" in told
    assert "law: {kind: log, numbers: [42." in told  # as the lens file wants it
    assert Path("curve.png").stat().st_size > 5000


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["scan", "twin:overhead", "--lens=lens.yaml", "--size=10mm"], "no control 'zoom'"),
        (
            ["scan", "twin:webcam", "--lens=none.yaml", "--size=10mm"],
            "tagmetry: none.yaml: there is",
        ),
        (["scan", "twin:webcam", "--lens=bank.yaml", "--size=10mm"], "bank.yaml"),
        (["scan", "twin:webcam", "--lens=lens.yaml", "--size=0mm"], "length above 0"),
        (["scan", "twin:room", "--lens=lens.yaml", "--size=10mm"], "has no controls"),
        (["demo", "--depth=100m"], "expected a depth"),
        (["focus-curve", "twin:webcam", "--depth=-1m", "--pairs=c.csv"], ""),
        (["bank", "twin:webcam", "--board=nothing", "--out=b.yaml"], "board"),
    ],
)
def test_what_cannot_be_done_is_told_in_one_line(place: Path, arguments, words, capsys) -> None:
    assert run(["lens", *arguments]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert words in told.err
    assert told.err.count("\n") == 1


@pytest.mark.parametrize("content", [b"tagmetry: camera\n", b"\x89PNG", b""])
def test_another_file_is_no_file_of_pairs_and_stays(content: bytes, place: Path, capsys) -> None:
    Path("other").write_bytes(content)
    assert run(["lens", "focus-curve", "twin:webcam", "--depth=0.2m", "--pairs=other"]) == 2
    told = capsys.readouterr()
    assert told.out == ""  # before the focus is swept
    assert told.err.startswith("tagmetry: other: ")
    assert Path("other").read_bytes() == content


def test_the_line_for_the_lens_file_reads_back(place: Path) -> None:
    for law in (LogLaw(42.11, 4.0), DioptreLaw(7.0, 1.0), SplineLaw((-1.0, 0.0), (50.0, 4.0))):
        text = Path("lens.yaml").read_text()
        lines = [line for line in text.splitlines() if not line.startswith(("law", "  "))]
        Path("other.yaml").write_text("\n".join([*lines, law_line(law)]))
        assert load_lens("other.yaml").law == law

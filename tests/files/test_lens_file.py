"""The file of a lens reads back as it was written."""

from pathlib import Path

import numpy as np
import pytest

from tagmetry.camera import BankNode, Camera, CameraBank
from tagmetry.camera.controls import Control
from tagmetry.errors import InputError
from tagmetry.files import save_bank
from tagmetry.files.lens import LensFile, load_lens, save_lens
from tagmetry.lens import DioptreLaw, Lag, LogLaw, SplineLaw

BANK = CameraBank(
    tuple(
        BankNode(Camera(1920, 1080, (1100.0 + focus, 1100.0), (960.0, 540.0), focus=focus))
        for focus in (0.0, 75.0, 150.0)
    ),
    zoom_is_digital=True,
)
LAWS = [LogLaw(40.0, 3.0), DioptreLaw(7.0, 1.0), SplineLaw((-3.0, -1.0, 0.0), (130.0, 50.0, 4.0))]
RANGES = {
    "zoom": Control("zoom", 100, 500, 1, 100, "percent"),
    "focus": Control("focus", 0, 150, 1, 0),
}


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_it_reads_back(law, tmp_path: Path) -> None:
    save_bank(BANK, tmp_path / "bank.yaml")
    written = LensFile(BANK, "bank.yaml", law, 0.0016, 0.05, 1.1, 200.0, Lag(2, 25.0))
    save_lens(written, tmp_path / "lens.yaml")
    found = load_lens(tmp_path / "lens.yaml")
    assert (found.law, found.lag, found.native_percent) == (law, Lag(2, 25.0), 200.0)
    lens = found.lens(RANGES)
    assert lens.law.value(0.2) == law.value(0.2)
    assert [gap.high_focus for gap in lens.gaps] == [75.0, 150.0]
    assert np.isfinite(lens.focal_px())


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("tagmetry: camera bank\n", "tagmetry"),
        ("tagmetry: zoom lens\nversion: 1\n", "bank"),
        (
            (
                "tagmetry: zoom lens\nversion: 1\nbank: b.yaml\nlaw: {kind: log, numbers: [1]}\n"
                "aperture_m: 0.001\nnearest_m: 0.1\nfarthest_m: 1\n"
            ),
            "expected two",
        ),
    ],
)
def test_broken_files_are_refused(text: str, match: str, tmp_path: Path) -> None:
    path = tmp_path / "lens.yaml"
    path.write_text(text)
    with pytest.raises(InputError, match=match):
        load_lens(path)


def test_a_camera_without_focus_is_refused() -> None:
    with pytest.raises(InputError, match="no control 'focus'"):
        LensFile(BANK, "b.yaml", LogLaw(), 0.0016, 0.05, 1.1).lens({"zoom": RANGES["zoom"]})

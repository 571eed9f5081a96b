"""The file of a bank: reads back exactly, and says in one line what is wrong with a broken one."""

import contextlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tagmetry.camera import BankNode, BrownLens, Camera, CameraBank, FisheyeLens, Lens
from tagmetry.errors import InputError
from tagmetry.files import load_bank, save_bank
from tagmetry.files.bank import bank_from
from tagmetry.files.tables import parse_table

RNG = np.random.default_rng(0)


def node(focus: float, lens: Lens, *, known: bool = True) -> BankNode:
    root = RNG.normal(size=(4 + len(lens.coefficients),) * 2)
    camera = Camera(
        1920,
        1080,
        (1400.1 + focus / 3, 1401.2),
        (959.3, 1e-7),
        lens,
        covariance=root @ root.T if known else None,
        zoom=100.0,
        focus=focus,
        name="webcam: é",
        provenance="35 views,\n'by hand'",
    )
    return BankNode(camera, "from near" if known else None)


BROWN = CameraBank(
    (
        node(0.1, BrownLens((-0.1, 0.2, 1e-5, 1 / 3)), known=False),
        node(30.0, BrownLens((0.1,) * 14)),
    ),
    zoom_is_digital=True,
    may_scale=True,
)
FISHEYE = CameraBank((node(5.0, FisheyeLens((0.1, 0.2, 1 / 3, 1e-300))),))

TEXT = """\
tagmetry: camera bank
version: 1
name: webcam
lens: brown
zoom_is_digital: true
may_scale: false
nodes:
  - width_px: 640
    height_px: 480
    zoom: 100
    focus: 35
    focal_px: [500.5, 501]
    center_px: [320, 240]
    coefficients: []
    approach: from far
    covariance: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
"""


@pytest.mark.parametrize("bank", [BROWN, FISHEYE], ids=["brown", "fisheye"])
def test_reads_back_exactly(bank: CameraBank, tmp_path: Path) -> None:
    save_bank(bank, tmp_path / "bank.yaml")
    found = load_bank(tmp_path / "bank.yaml")
    assert (found.zoom_is_digital, found.may_scale) == (bank.zoom_is_digital, bank.may_scale)
    for one, other in zip(found.nodes, bank.nodes, strict=True):
        assert one.approach == other.approach
        for field in ("size_px", "focal_px", "center_px", "lens", "zoom", "focus", "name"):
            assert getattr(one.camera, field) == getattr(other.camera, field)
        assert one.camera.provenance == other.camera.provenance
        if other.camera.covariance is None:
            assert one.camera.covariance is None
        else:
            np.testing.assert_array_equal(one.camera.covariance, other.camera.covariance)


def test_a_file_written_by_hand() -> None:
    bank = bank_from(parse_table(TEXT))
    (found,) = bank.nodes
    assert (found.focus, found.zoom, found.approach) == (35.0, 100.0, "from far")
    assert found.camera.size_px == (640, 480)
    assert (found.camera.focal_px, found.camera.center_px) == ((500.5, 501.0), (320.0, 240.0))
    assert bank.zoom_is_digital
    assert not bank.may_scale


def test_31_calibrations_with_covariance_fit_easily(tmp_path: Path) -> None:
    nodes = tuple(node(5.0 * k, BrownLens((0.1, 0.2, 0.3, 0.4, 0.5))) for k in range(31))
    save_bank(CameraBank(nodes), tmp_path / "bank.yaml")
    assert (tmp_path / "bank.yaml").stat().st_size < 100_000
    assert len(load_bank(tmp_path / "bank.yaml").nodes) == 31


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("camera bank", "camera", r"expected a bank of calibrations \(tagmetry: camera bank\)"),
        ("version: 1", "version: 2", "expected version 1 of a camera bank, found 2"),
        ("version: 1\n", "", "expected version 1 of a camera bank, found None"),
        ("may_scale: false\n", "may_scale: false\nfoo: 1\n", "there is no key 'foo'"),
        ("    zoom: 100\n", "    zoom: 100\n    zom: 1\n", "nodes.0: there is no key 'zom'"),
        ("lens: brown", "lens: omni", "lens: expected 'brown' or 'fisheye', found 'omni'"),
        ("    focus: 35\n", "", "nodes.0.focus is missing"),
        ("zoom: 100", "zoom: 0", "nodes.0: zoom must be positive"),
        ("500.5, 501", "500.5", "nodes.0.focal_px: .* at least 2 items"),
        ("500.5", "-1", "nodes.0: focal_px must be positive"),
        ("500.5", ".nan", "nodes.0.focal_px.0: expected a valid number"),
        ("coefficients: []", "coefficients: [1]", "nodes.0: expected 0, 4, 5, 8, 12 or 14"),
        ("from far", "sideways", "nodes.0.approach: expected 'from near' or 'from far'"),
        ("[[1, 0, 0, 0]", "[[-1, 0, 0, 0]", "nodes.0: .*variances of at least 0"),
        ("[[1, 0, 0, 0], ", "[", "nodes.0: .*expected a square"),
        (TEXT[TEXT.index("  - width") :], "  []\n", "at least one calibration, found none"),
    ],
)
def test_refuses(old: str, new: str, message: str, tmp_path: Path) -> None:
    assert old in TEXT
    (tmp_path / "bank.yaml").write_text(TEXT.replace(old, new, 1))
    with pytest.raises(InputError, match=rf"bank\.yaml: .*{message}") as caught:
        load_bank(tmp_path / "bank.yaml")
    assert "\n" not in str(caught.value)


def test_what_cannot_be_read_again_is_not_written(tmp_path: Path) -> None:
    path = tmp_path / "bank.yaml"
    save_bank(FISHEYE, path)
    before = path.read_text()
    camera = replace(FISHEYE.nodes[0].camera, covariance=-np.eye(8))
    with pytest.raises(InputError, match="variances of at least 0"):
        save_bank(CameraBank((BankNode(camera),)), path)
    assert path.read_text() == before
    assert list(tmp_path.iterdir()) == [path]


@st.composite
def damaged(draw: st.DrawFn) -> str:
    text = TEXT
    for _ in range(draw(st.integers(1, 3))):
        start = draw(st.integers(0, len(text)))
        patch = draw(st.text(max_size=4) | st.sampled_from(["[", "}", "- ", "1e999", "-", "null"]))
        text = text[:start] + patch + text[start + draw(st.integers(0, 12)) :]
    return text


@given(damaged())
@settings(max_examples=200)
def test_a_damaged_file_is_read_or_refused(text: str) -> None:
    with contextlib.suppress(InputError):
        assert bank_from(parse_table(text)).nodes

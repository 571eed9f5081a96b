"""`tagmetry info`: versions, parts and families."""

import json
import tomllib
from pathlib import Path

import pytest

import tagmetry
from tagmetry.cli.main import run
from tagmetry.markers import family, family_names

ROOT = Path(__file__).parents[2]


def test_json_holds_every_family(capsys: pytest.CaptureFixture) -> None:
    assert run(["info", "--json"]) == 0
    table = json.loads(capsys.readouterr().out)
    assert table["versions"]["tagmetry"] == tagmetry.__version__
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert set(table["parts"]) == set(declared["optional-dependencies"]) - {"all"}
    assert list(table["families"]) == list(family_names())
    one = family("tag36h11")
    assert table["families"]["tag36h11"] == {
        "ids": 587, "bits": 36, "corrects": 5, "forgives": one.forgiven_bits,
    }  # fmt: skip


def test_text_has_a_row_for_every_family(capsys: pytest.CaptureFixture) -> None:
    assert run(["info"]) == 0
    rows = {row.split()[0]: row.split()[1:] for row in capsys.readouterr().out.splitlines() if row}
    assert rows["tag36h11"][:3] == ["587", "36", "5"]
    assert set(family_names()) <= set(rows)


def test_a_missing_part_is_named_with_its_command(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.setattr("tagmetry.cli.info._PARTS", {"video": "no-such-package"})
    assert run(["info"]) == 0
    assert "pip install 'tagmetry[video]'" in capsys.readouterr().out

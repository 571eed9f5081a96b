"""`tagmetry detect --stages`: pictures of the first image's stages."""

from pathlib import Path

import pytest

from tagmetry.cli.main import run


def test_stages_of_the_first_image_are_written(
    small_picture: Path, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    folder = tmp_path / "out"
    twice = [str(small_picture), str(small_picture)]
    assert run(["detect", *twice, "--stages", str(folder)]) == 0
    assert capsys.readouterr().out.count("1 marker") == 2
    names = sorted(path.name for path in folder.iterdir())
    assert names[0] == "01-grey.png"
    assert names[-1] == "index.html"
    assert len(names) == 22


def test_a_folder_that_is_a_file_is_one_line_and_code_2(
    small_picture: Path, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    (tmp_path / "out").write_text("mine")
    assert run(["detect", str(small_picture), "--stages", str(tmp_path / "out")]) == 2
    error = capsys.readouterr().err
    assert "cannot make the folder" in error
    assert error.count("\n") == 1

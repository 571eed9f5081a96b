"""A file is replaced whole or not at all."""

import os
import stat
from pathlib import Path

import pytest

from tagmetry.errors import InputError
from tagmetry.files import replace_file, write_atomically
from tagmetry.files.atomic import check_destinations


def _names(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir()]


def _write_half(path: Path, error: type[BaseException]) -> None:
    with replace_file(path) as file:
        file.write(b"half")
        raise error


@pytest.mark.parametrize("content", [b"", b"\x00\xff", "µm\n", "x" * 100_000])
def test_what_is_written_is_read(tmp_path: Path, content: bytes | str) -> None:
    path = tmp_path / "out"
    write_atomically(path, content)
    assert path.read_bytes() == (content.encode() if isinstance(content, str) else content)
    assert _names(tmp_path) == ["out"]


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_failing_writer_leaves_the_old_file(tmp_path: Path, error: type[BaseException]) -> None:
    path = tmp_path / "out"
    path.write_text("old")
    with pytest.raises(error):
        _write_half(path, error)
    assert path.read_text() == "old"
    assert _names(tmp_path) == ["out"]


def test_failing_writer_leaves_no_new_file(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError), replace_file(tmp_path / "out"):
        raise RuntimeError
    assert _names(tmp_path) == []


def test_old_file_stands_until_the_new_one_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "out"
    path.write_text("old")
    with replace_file(path) as file:
        file.write(b"new")
        assert path.read_text() == "old"
    assert path.read_text() == "new"


def test_keeps_permissions_of_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "out"
    path.write_text("old")
    path.chmod(0o640)
    write_atomically(path, "new")
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_new_file_has_ordinary_permissions(tmp_path: Path) -> None:
    plain, ours = tmp_path / "plain", tmp_path / "ours"
    plain.write_text("")
    write_atomically(ours, "")
    assert ours.stat().st_mode == plain.stat().st_mode


def test_writes_through_a_link(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to("real")
    write_atomically(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "new"


def test_device_is_written_and_stays_a_device() -> None:
    write_atomically(Path(os.devnull), "gone")
    assert Path(os.devnull).is_char_device()


def test_refuses_a_missing_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"cannot write .*out: there is no folder .*nowhere"):
        write_atomically(tmp_path / "nowhere" / "out", "")


def test_refuses_a_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"cannot write .*: Is a directory"):
        write_atomically(tmp_path, "")


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("none/out", "there is no folder .*none; create it first"),
        ("folder", "Is a directory"),
        ("file/out", "Not a directory"),
    ],
)
def test_says_before_the_work_what_cannot_be_written(tmp_path: Path, name: str, why: str) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("old")
    check_destinations(None, tmp_path / "new", tmp_path / "file")
    with pytest.raises(InputError, match=f"cannot write .*{name}: {why}"):
        check_destinations(tmp_path / name)


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="a folder of Linux")
def test_a_folder_that_takes_no_file_is_not_said_to_be_missing() -> None:
    with pytest.raises(InputError, match=r"cannot write /proc/out\.txt: No such file"):
        write_atomically(Path("/proc/out.txt"), "")


def test_refuses_a_file_as_a_folder(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("old")
    with pytest.raises(InputError, match=r"cannot write .*: Not a directory"):
        write_atomically(tmp_path / "file" / "out", "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device of Linux")
def test_a_full_disk_is_named_with_the_file(tmp_path: Path) -> None:
    path = tmp_path / "out.png"
    path.symlink_to("/dev/full")
    with pytest.raises(InputError, match=r"cannot write .*out.png: No space.*; make room or"):
        write_atomically(path, b"x")

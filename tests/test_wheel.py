"""What the wheel carries: the package, its types, its licence, its command; and nothing else."""

import subprocess
import sys
from email import message_from_bytes
from pathlib import Path
from zipfile import ZipFile

import pytest

pytest.importorskip("hatchling", reason="the wheel is built with hatchling")
ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> ZipFile:
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True, timeout=60)
    (path,) = folder.glob("*.whl")
    return ZipFile(path)


def read_metadata(wheel: ZipFile) -> dict[str, list[str]]:
    (name,) = (name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
    message = message_from_bytes(wheel.read(name))
    return {key: message.get_all(key, []) for key in set(message)}


def test_carries_every_module_and_the_marker_of_types(wheel: ZipFile) -> None:
    source = ROOT / "src"
    modules = {path.relative_to(source).as_posix() for path in source.rglob("*.py")}
    packed = {name for name in wheel.namelist() if name.endswith(".py")}
    assert packed == modules
    assert "tagmetry/py.typed" in wheel.namelist()


def test_carries_nothing_but_the_package_and_its_metadata(wheel: ZipFile) -> None:
    tops = {name.split("/")[0] for name in wheel.namelist()}
    assert {top.split("-")[0] for top in tops} == {"tagmetry"}
    assert any(name.endswith("licenses/LICENSE") for name in wheel.namelist())


def test_carries_the_robots_client_in_c(wheel: ZipFile) -> None:
    folder = "tagmetry/link/client"
    assert {f"{folder}/tagmetry_link.h", f"{folder}/tagmetry_link.c"} <= set(wheel.namelist())


def test_carries_the_live_page(wheel: ZipFile) -> None:
    folder = "tagmetry/live/page"
    assert {f"{folder}/{name}" for name in ("index.html", "app.js", "style.css")} <= set(
        wheel.namelist()
    )


def test_installs_the_command(wheel: ZipFile) -> None:
    (name,) = (name for name in wheel.namelist() if name.endswith("entry_points.txt"))
    assert "tagmetry = tagmetry.cli.main:main" in wheel.read(name).decode()


def test_says_what_it_needs(wheel: ZipFile) -> None:
    metadata = read_metadata(wheel)
    assert metadata["Requires-Python"] == [">=3.11"]
    assert metadata["License-Expression"] == ["Apache-2.0 AND BSD-2-Clause"]
    extras = {"all", "arena", "bench", "cluster", "live", "parquet", "print", "report"}
    extras |= {"robots", "video", "zenoh"}
    assert set(metadata["Provides-Extra"]) == extras


def test_every_requirement_of_the_wheel_is_pinned(wheel: ZipFile) -> None:
    for requirement in read_metadata(wheel)["Requires-Dist"]:
        only_dev = any(f"extra == '{extra}'" in requirement for extra in ("bench", "cluster"))
        file = "dev.txt" if only_dev else "run.txt"
        pinned = (ROOT / "requirements" / file).read_text()
        name = requirement.split(">=")[0].split("[")[0].lower()
        assert name == "tagmetry" or f"\n{name}==" in pinned, f"{name}: run `make requirements`"


@pytest.mark.parametrize("name", ["run", "dev", "build"])
def test_pinned_requirements_name_no_address(name: str) -> None:
    text = (ROOT / "requirements" / f"{name}.txt").read_text()
    assert "--hash=sha256:" in text
    for forbidden in ("http:", "https:", "index-url", "find-links", "file:", "/"):
        assert forbidden not in text

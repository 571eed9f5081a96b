"""The clients that the tutorial shows run as they stand, and talk to a host."""

import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from compiled import SOURCES, build

from tagmetry.cli.main import run
from tagmetry.link import Host, Neighbour, Neighbours, Odometry, new_key, now_us, parse_key

SHOWN = Path(__file__).parents[2] / "docs" / "clients"


def robot_command(language: str, folder: Path) -> list[str]:
    if language == "python":
        return [sys.executable, str(SHOWN / "robot.py")]
    sources = [SOURCES / "tagmetry_link.c", SOURCES / "tagmetry_posix.c", SHOWN / "robot.c"]
    flags = ("-Wno-conversion", "-Wno-missing-field-initializers")
    return [str(build(folder / "robot", *sources, flags=flags))]


@pytest.mark.skipif(sys.platform == "win32", reason="the C client's port is for POSIX")
@pytest.mark.parametrize("language", ["python", "c"])
def test_the_shown_client_talks_to_a_host(language: str, tmp_path: Path) -> None:
    key = new_key()
    with Host({3: parse_key(key)}, port=0) as host:
        command = [*robot_command(language, tmp_path), "127.0.0.1", str(host.address[1]), key]
        with (tmp_path / "said").open("wb") as said:
            robot = subprocess.Popen(command, stdout=said)
        try:
            taken = exchange(host, limit_s=10.0)
        finally:
            robot.kill()
            robot.wait()
    assert Odometry in taken


def exchange(host: Host, limit_s: float) -> set[type]:
    """Tell of a neighbour until the robot has said something, and return what it said."""
    taken: set[type] = set()
    end_s = time.monotonic() + limit_s
    while Odometry not in taken and time.monotonic() < end_s:
        host.send(3, Neighbours(now_us(), 0.5, (Neighbour(7, 0.3, 0.0, 0.0),)))
        taken |= {type(one.message) for one in host.take()}
        time.sleep(0.02)
    return taken


def test_the_sketch_is_good_c_plus_plus(tmp_path: Path) -> None:
    if shutil.which("g++") is None:
        pytest.skip("needs g++")
    stubs = Path(__file__).parent / "arduino"
    sketch = tmp_path / "sketch.cpp"
    sketch.write_bytes((SHOWN / "robot_esp32.ino").read_bytes())
    command = ["g++", "-Wall", "-Wextra", "-Wno-unused-parameter", "-Werror", "-fsyntax-only"]
    command += [f"-I{SOURCES}", f"-I{stubs}", str(sketch)]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr


def test_the_command_writes_the_sources(tmp_path: Path) -> None:
    assert run(["arena", "client", str(tmp_path / "robot")]) == 0
    written = {path.name: path.read_bytes() for path in (tmp_path / "robot").iterdir()}
    assert sorted(written) == [
        *("tagmetry_link.c", "tagmetry_link.h", "tagmetry_posix.c", "tagmetry_posix.h"),
        *("tagmetry_twin.c", "tagmetry_twin.h"),
    ]
    assert all(content == (SOURCES / name).read_bytes() for name, content in written.items())


def test_the_command_makes_a_key(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["arena", "key"]) == 0
    assert len(parse_key(capsys.readouterr().out.strip())) == 32


def test_a_robot_s_program_imports_nothing_heavy() -> None:
    source = "import sys, tagmetry.link; print(*{name.split('.')[0] for name in sys.modules})"
    ran = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=True)
    assert not {"numpy", "scipy", "cv2", "numba", "pydantic"} & set(ran.stdout.split())

"""`tagmetry arena run` and `watch` between computers; what cannot be is one line."""

import json
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import cv2
import numpy as np
import pytest
from small_table import CAMERA, SENSOR, T_CAMERA_WORLD, TABLE

from tagmetry.arena import RobotState
from tagmetry.cli.main import run
from tagmetry.files import save_camera
from tagmetry.geometry import RigidTransform
from tagmetry.link import Command, now_us
from tagmetry.link.computers import ArenaBridge, state_message
from tagmetry.link.computers.net import Net
from tagmetry.link.messages import ArenaState
from tagmetry.markers import MountedMarker
from tagmetry.twin import render

pytest.importorskip("zenoh", reason="needs the part zenoh")

KEY = "cd" * 32
ARENA = TABLE + SENSOR


def free_endpoint() -> str:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{found.getsockname()[1]}"


@pytest.fixture(scope="module")
def table(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with an arena, its world and a picture."""
    folder = tmp_path_factory.mktemp("table")
    save_camera(CAMERA, folder / "ceiling.yaml")
    markers = [
        MountedMarker("tag36h11", number, size_m, RigidTransform.from_translation([x_m, 0, z_m]))
        for number, size_m, x_m, z_m in ((100, 0.1, -0.4, 0), (101, 0.1, 0.4, 0), (1, 0.08, 0, 0.1))
    ]
    shown = render(markers, T_CAMERA_WORLD, CAMERA, np.random.default_rng(0))
    cv2.imwrite(str(folder / "floor.png"), shown)
    (folder / "arena.yaml").write_text(ARENA, "utf-8")
    assert run(["arena", "calibrate", str(folder / "floor.png"), str(folder / "arena.yaml")]) == 0
    return folder


def run_shared(table: Path, zenoh: str) -> int:
    """Run the arena with these words about other computers in its file."""
    (table / "shared.yaml").write_text(
        ARENA + f"world: arena.world.yaml\nzenoh: {zenoh}\n", "utf-8"
    )
    return run(["arena", "run", str(table / "floor.png"), str(table / "shared.yaml"), "--quiet"])


def test_a_run_tells_other_computers_what_it_sees(table: Path) -> None:
    endpoint, topics = free_endpoint(), set()
    with Net(listen=endpoint) as net:
        net.hear(["tagmetry/table/**"], lambda topic, _packet: topics.add(topic))
        assert run_shared(table, f"{{connect: {endpoint}, view_key: '{KEY}'}}") == 0
    assert topics >= {
        "tagmetry/table/state",
        "tagmetry/table/robots/ada/pose",
        "tagmetry/table/robots/ada/neighbours",
    }
    assert not any(topic.endswith(("/answer", "/commanded")) for topic in topics)


@pytest.mark.parametrize(
    ("zenoh", "said"),
    [
        ("{listen: 'tcp/0:x'}", "expected an endpoint like tcp/192.168.1.5:7447, got 'tcp/0:x'"),
        ("{listen: tcp/192.0.2.1:7447}", "cannot listen at tcp/192.0.2.1:7447: Cannot assign"),
        ("{connect: ENDPOINT}", "nobody answers at tcp/127.0.0.1:"),
        ("{}", "zenoh: expected listen: tcp/192.168.1.5:7447, or connect: with a router"),
        ("{listen: ENDPOINT, view_key: ab}", "zenoh.view_key: expected a key of 64 hexadecimal"),
        (f"{{listen: ENDPOINT, view_key: '{KEY}', command_key: '{KEY}'}}", "are the same"),
        ("{endpoint: ENDPOINT}", "there is no key 'endpoint'; there are listen, connect"),
    ],
)
def test_what_cannot_be_is_one_line(
    table: Path, capsys: pytest.CaptureFixture[str], zenoh: str, said: str
) -> None:
    assert run_shared(table, zenoh.replace("ENDPOINT", free_endpoint())) == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert said in line


def test_a_port_that_is_taken_is_one_line(table: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        endpoint = f"tcp/127.0.0.1:{taken.getsockname()[1]}"
        assert run_shared(table, f"{{listen: {endpoint}}}") == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert f"cannot listen at {endpoint}: Address already in use; end the other program" in line


@contextmanager
def told(endpoint: str, **keys: bytes) -> Iterator[None]:
    """Tell of an arena with one robot, fifty times a second."""
    done = threading.Event()

    def tell() -> None:
        for image in range(10**6):
            if done.wait(0.02):
                return
            moment_us = now_us()
            ada = RobotState(7, "ada", 0.5, 0.25, 0.0, 0.0, 0.0, np.eye(5), 0.0, True, 0.0)
            bridge.tell(7, Command(0.125, turn_radps=0.5))
            bridge.tell(7, state_message(ada, moment_us, must_stand=True))
            bridge.tell_image(ArenaState(moment_us, image, 1, 1, 1))

    with ArenaBridge("table", {7: "ada"}, listen=endpoint, **keys) as bridge:
        thread = threading.Thread(target=tell)
        thread.start()
        try:
            yield
        finally:
            done.set()
            thread.join()


def test_another_computer_watches(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    endpoint, key_file = free_endpoint(), tmp_path / "view.key"
    key_file.write_text(f"{KEY}\n", "utf-8")
    options = ["--name", "table", "--key-file", str(key_file), "--limit", "3"]
    with told(endpoint, view_key=bytes.fromhex(KEY)):
        assert run(["arena", "watch", endpoint, *options]) == 0
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert len(lines) == 3
    assert lines[0]["sequence"] < lines[1]["sequence"] < lines[2]["sequence"]
    (ada,) = lines[0]["robots"]
    assert (ada["id"], ada["name"], ada["x_m"], ada["y_m"]) == (7, "ada", 0.5, 0.25)
    assert ada["deviations"] == [1.0] * 5
    assert (lines[0]["held"], lines[0]["stop_for_all"]) == ([7], True)
    commanded = {"id": 7, "forward_mps": 0.125, "turn_radps": 0.5, "valid_for_ms": 200}
    assert lines[0]["commanded"] == [commanded]


@pytest.mark.parametrize(
    ("options", "refused"), [(["--name", "other"], "0 packets"), (["--name", "table"], "packets")]
)
def test_an_arena_that_is_not_heard_is_one_line(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    options: list[str],
    refused: str,
) -> None:
    monkeypatch.setattr("tagmetry.cli.arena_watch._PATIENCE_S", 0.5)
    endpoint = free_endpoint()
    with told(endpoint, view_key=bytes.fromhex(KEY)):
        assert run(["arena", "watch", endpoint, *options]) == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert f"no arena '{options[1]}' is heard there (" in line
    assert f"{refused} were refused" in line


def test_nobody_to_watch_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["arena", "watch", free_endpoint()]) == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert "nobody answers at tcp/127.0.0.1:" in line


def test_a_host_that_dies_is_told_once(capsys: pytest.CaptureFixture[str]) -> None:
    endpoint, codes = free_endpoint(), []

    def watch() -> None:
        codes.append(run(["arena", "watch", endpoint, "--name", "table", "--limit", "150"]))

    thread = threading.Thread(target=watch)
    with told(endpoint):
        thread.start()
        time.sleep(2.0)  # a hundred images at most
    time.sleep(1.5)
    with told(endpoint):
        thread.join(30)
    assert codes == [0]
    said = capsys.readouterr()
    assert len(said.out.splitlines()) == 150
    assert said.err.splitlines()[:2] == [
        "tagmetry: the arena has fallen silent; waiting for it",
        "tagmetry: the arena is heard again",
    ]

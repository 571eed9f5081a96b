"""Controls taken over by hand, and given back: after the end, an error, and Ctrl-C."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tagmetry.camera import ControlMisreadError, ControlRefusedError, VerifiedControls
from tagmetry.sources.controls import by_hand
from tagmetry.twin.camera import Faults, TwinCamera, marker_before_camera, webcam

NAMES = ("zoom", "focus", "exposure", "gain", "auto_focus", "auto_exposure")
CHILD = """
import json, sys, time
from pathlib import Path
from tagmetry.sources.controls import by_hand
from tagmetry.twin.camera import TwinCamera, marker_before_camera, webcam

class Slow:
    def __init__(self, controls):
        self.available, self.read, self._write = controls.available, controls.read, controls.write

    def write(self, name, value):
        time.sleep(0.1)  # as a USB camera may take
        return self._write(name, value)

controls = Slow(TwinCamera(marker_before_camera(0.01, 0.2), webcam()).controls)
found = {name: controls.read(name) for name in controls.available}
try:
    with by_hand(controls):
        controls.write("focus", 99)
        controls.write("zoom", 450)
        print("ready", flush=True)
        time.sleep(30)
except KeyboardInterrupt:
    left = {name: controls.read(name) for name in controls.available}
    Path(sys.argv[1]).write_text(json.dumps({"found": found, "left": left}))
    sys.exit(130)
"""


def controls(**faults: object) -> VerifiedControls:
    twin = TwinCamera(marker_before_camera(0.01, 0.2), webcam(), faults=Faults(**faults))
    return VerifiedControls(twin.controls)


def values(own: VerifiedControls) -> dict[str, float]:
    return {name: own.read(name) for name in NAMES}


def test_auto_modes_are_off_within_and_on_again_after() -> None:
    own = controls()
    before = values(own)
    with by_hand(own) as given:
        assert given is own
        assert (own.read("auto_focus"), own.read("auto_exposure")) == (0, 0)
        for name, value in (("zoom", 300), ("focus", 80), ("exposure", 5e-3), ("gain", 2)):
            own.write(name, value)
    assert values(own) == before


def test_an_error_goes_on_after_everything_is_given_back() -> None:
    own = controls()
    before = values(own)
    with pytest.raises(RuntimeError, match="the marker left"):
        lost(own)
    assert values(own) == before


def lost(own: VerifiedControls) -> None:
    with by_hand(own):
        own.write("zoom", 300)
        raise RuntimeError("the marker left")


def test_an_auto_mode_that_cannot_be_switched_off_is_named_and_the_rest_given_back() -> None:
    own = controls(refused=frozenset({"auto_exposure"}))
    before = values(own)
    with (
        pytest.raises(ControlRefusedError, match="not set back as it was: auto_exposure"),
        by_hand(own),
    ):
        pass
    assert values(own) == before


def test_a_control_that_reads_back_another_value_is_named() -> None:
    own = controls(misread={"zoom": 25.0})
    own.write("auto_focus", 0)
    with pytest.raises(ControlMisreadError, match="zoom: 300 was sent, the camera reads back 325"):
        own.write("zoom", 300)


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to a child")
@pytest.mark.parametrize("times", [1, 3])
def test_after_ctrl_c_a_camera_is_as_it_was_found(tmp_path: Path, times: int) -> None:
    """Once while it waits, and again while it gives back: nothing is left half done."""
    report = tmp_path / "report.json"
    child = subprocess.Popen([sys.executable, "-c", CHILD, report], stdout=subprocess.PIPE)
    assert child.stdout is not None
    assert child.stdout.readline() == b"ready\n"
    for _ in range(times):
        child.send_signal(signal.SIGINT)
        time.sleep(0.12)
    assert child.wait(20) == 130
    child.stdout.close()
    told = json.loads(report.read_text("utf-8"))
    assert told["left"] == told["found"]

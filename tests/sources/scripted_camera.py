"""A fake camera with a script of images, silences and faults."""

import threading
from dataclasses import dataclass, field

import numpy as np

from tagmetry.sources import ConnectionLostError, LiveSource, LiveTiming

TIMING = LiveTiming(hang_s=0.25, frozen_s=0.05, first_pause_s=0.02, longest_pause_s=0.08)
FOREVER_S = 30.0


def image(value, size=(4, 6)):
    return np.full((*size, 3), value % 256, np.uint8)


@dataclass
class FakeCamera:
    """Plays scripts, one per connection: images, seconds to sleep, or errors to raise."""

    scripts: list
    opened: int = 0
    closed: int = 0
    freed: threading.Event = field(default_factory=threading.Event)

    def __call__(self):
        script = self.scripts[min(self.opened, len(self.scripts) - 1)]
        self.opened += 1
        if isinstance(script, Exception):
            raise script
        return FakeConnection(self, iter(script))


@dataclass
class FakeConnection:
    camera: FakeCamera
    script: object

    def read(self):
        for step in self.script:
            if isinstance(step, Exception):
                raise step
            if not isinstance(step, float):
                return step
            self.camera.freed.wait(step)
        raise ConnectionLostError("unplugged")

    def close(self):
        self.camera.closed += 1


def paced(values, pause_s=0.01):
    return [step for value in values for step in (pause_s, image(value))]


def states_of(scripts, wanted, timing=TIMING, timeout_s=5.0):
    """Run until the wanted state was reported so often as it stands in `wanted`."""
    seen, done = [], threading.Event()

    def on_state(state):
        seen.append(state)
        if [each.kind for each in seen][: len(wanted)] == wanted:
            done.set()

    camera = FakeCamera(scripts)
    with LiveSource("fake", camera, on_state=on_state, timing=timing) as source:
        assert done.wait(timeout_s), [state.kind for state in seen]
        state = source.state
    camera.freed.set()
    return seen, state, camera

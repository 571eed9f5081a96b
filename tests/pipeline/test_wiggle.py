"""The built-in test of latency finds the delay of a robot that has one, over a link of its own."""

from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tagmetry.arena import wiggle
from tagmetry.errors import InputError
from tagmetry.link import Command
from tagmetry.pipeline.arena.wiggled import WiggleTaker


@dataclass
class SlowRobot:
    """Takes commands and obeys them later; time passes when the test says so.

    Attributes:
        delay_s: From the command to the motion.
        now_s: The clock.
        is_linked: Whether it takes commands.
    """

    delay_s: float
    now_s: float = 100.0
    is_linked: bool = True
    told: list[tuple[float, float]] = field(default_factory=list)
    heading_rad: float = 3.0

    def send(self, robot_id: int, command: Command) -> bool:
        assert robot_id == 7
        if self.is_linked:
            self.told.append((self.now_s + self.delay_s, command.turn_radps))
        return self.is_linked

    def wait(self, duration_s: float) -> None:
        for _ in range(round(duration_s / 1e-4)):
            self.now_s += 1e-4
            due = (rate for start_s, rate in reversed(self.told) if start_s <= self.now_s)
            self.heading_rad += 1e-4 * next(due, 0.0)

    def picture(self, *, seen: bool = True) -> Any:
        """Return what an image of now shows: another robot, and this one."""
        rows = [0, 1] if seen else [0]
        places = [[0, 0, 9.0], [0, 0, np.angle(np.exp(1j * self.heading_rad))]]
        sightings = SimpleNamespace(rows=np.array(rows), places=np.array(places[: len(rows)]))
        return SimpleNamespace(step=SimpleNamespace(seen=sightings), taken_s=self.now_s)


def watched(robot: SlowRobot, taker: WiggleTaker, *, seen: bool = True) -> None:
    """Let images come 30 times a second, each ready 12 ms after it was taken."""
    for _ in range(600):
        picture = robot.picture(seen=seen)
        robot.wait(0.012)
        taker.take(picture)
        if taker.is_done:
            return
        robot.wait(1 / 30 - 0.012)


def taker_for(robot: SlowRobot) -> WiggleTaker:
    schedule = wiggle(np.random.default_rng(1), count=4)
    host: Any = robot
    return WiggleTaker(host, 7, 1, schedule, clock=lambda: robot.now_s)


@pytest.mark.parametrize("delay_s", [0.02, 0.083])
def test_finds_the_delay_of_a_robot(delay_s: float) -> None:
    robot = SlowRobot(delay_s)
    taker = taker_for(robot)
    watched(robot, taker)
    assert taker.is_done
    found = taker.reaction()
    assert found.delay_s == pytest.approx(delay_s, abs=3e-4)
    assert found.gain == pytest.approx(1.0, abs=1e-3)
    assert robot.told[-1][1] == 0.0


def test_a_robot_that_is_not_linked_or_not_seen_is_told_apart() -> None:
    away = SlowRobot(0.02, is_linked=False)
    taker = taker_for(away)
    taker.take(away.picture())
    assert not taker.is_done
    with pytest.raises(InputError, match="robot 7 was never linked"):
        taker.reaction()
    hidden = SlowRobot(0.02)
    taker = taker_for(hidden)
    for _ in range(20):
        taker.take(hidden.picture(seen=False))
        hidden.wait(0.03)
    with pytest.raises(InputError, match="robot 7 was seen in 0 images"):
        taker.reaction()

"""The built-in test of latency: one robot is told to turn to and fro, and the camera watches it.

command -> radio -> motor -> camera: how long until the image shows what was commanded. It is the
time that a state must be predicted further ahead for what is told to act in time (`lead_s`).
"""

import math
import time
from collections.abc import Callable

import numpy as np

from tagmetry.arena import Reaction, estimate_reaction, expected_heading
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.link import Command, Host
from tagmetry.pipeline.arena.measurement import ArenaResult

_COMMAND_MS = 250
_REST_S = 0.5  # before and after, in which the robot stands still


class WiggleTaker:
    """Sends turn rates to one robot by a schedule, with every image, and gathers its headings."""

    def __init__(
        self,
        host: Host,
        robot_id: int,
        row: int,
        schedule: tuple[Array, Array],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Send nothing yet.

        Args:
            host: The link, which is open.
            robot_id: Which robot.
            row: Its place in the arena's roster.
            schedule: When each turn rate begins, from 0, and the rates, as `wiggle` gives them.
            clock: The clock of the images' `taken_s`, s.
        """
        self._host, self._robot_id, self._row, self._clock = host, robot_id, row, clock
        self._times_s, self._rates_radps = schedule
        self._begun_s: float | None = None
        self._sent: list[tuple[float, float]] = []
        self._seen: list[tuple[float, float]] = []

    @property
    def is_done(self) -> bool:
        """Whether all was commanded, and a rest after it has passed."""
        if self._begun_s is None:
            return False
        end_s = self._begun_s + float(self._times_s[-1]) + 2 * _REST_S
        return self._clock() > end_s

    def take(self, result: ArenaResult) -> None:
        """Command what is due, and keep the heading that the image shows."""
        now_s = self._clock()
        rate_radps = self._rate_radps(now_s)
        command = Command(turn_radps=rate_radps, valid_for_ms=_COMMAND_MS)
        if self._host.send(self._robot_id, command):
            self._begun_s = now_s if self._begun_s is None else self._begun_s
            if not self._sent or self._sent[-1][1] != rate_radps:
                self._sent.append((now_s, rate_radps))
        seen = result.step.seen
        headings = seen.places[seen.rows == self._row, 2]
        if len(headings) == 1 and self._begun_s is not None:
            self._seen.append((result.taken_s, float(headings[0])))

    def close(self) -> None:
        """The robot stands still by itself."""

    def reaction(self) -> Reaction:
        """Return the delay from command to image.

        Raises:
            InputError: The robot was not linked, or hardly seen.
        """
        if not self._sent:
            raise InputError(f"robot {self._robot_id} was never linked; is its program running?")
        if len(self._seen) < 10:
            raise InputError(
                f"robot {self._robot_id} was seen in {len(self._seen)} images; expected it in view"
            )
        sent, seen = np.array(self._sent), np.array(self._seen)
        return estimate_reaction(expected_heading(sent[:, 0], sent[:, 1]), seen[:, 0], seen[:, 1])

    def _rate_radps(self, now_s: float) -> float:
        if self._begun_s is None:
            return 0.0
        due = math.nextafter(now_s - self._begun_s - _REST_S, math.inf)
        index = int(np.searchsorted(self._times_s, due, side="right")) - 1
        return float(self._rates_radps[index]) if index >= 0 else 0.0

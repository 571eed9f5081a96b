"""What the follower's loop does in one image period, along the line to its leader and across it."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tagmetry.arena.stability.setting import FollowingSetting
from tagmetry.arena.stability.wheels import Lateness, Wheels
from tagmetry.geometry import Array


@dataclass(frozen=True)
class Period(ABC):
    """One image period; the state is the robot's, commands sent, own motions, and what is known."""

    setting: FollowingSetting

    @property
    def outside(self) -> int:
        """How many numbers come from the leader."""
        return 2

    @property
    def size(self) -> int:
        """Length of the state."""
        return int(self._ends[-1]) + self._known

    @abstractmethod
    def __call__(self, state: Array, command: Array, outside: Array) -> tuple[Array, Array]:
        """Return the next state, and the controller's command."""

    @property
    @abstractmethod
    def _known(self) -> int:
        """How many numbers the controller keeps, its last command among them."""

    @property
    @abstractmethod
    def _moved(self) -> Array:
        """How places change with the places and, last, with the wheels' speed."""

    @cached_property
    def _ends(self) -> Array:
        """Where the robot's state, the commands sent and its own motions end."""
        return np.cumsum([len(self._wheels.push), self._acting.whole + 1, self._told.whole + 1])

    @cached_property
    def _wheels(self) -> Wheels:
        return Wheels.of(self._moved, self.setting.motor_s, self.setting.hold_s)

    @property
    def _acting(self) -> Lateness:
        return Lateness.of(self.setting.delay_s + self.setting.untold_s, self.setting.image_s)

    @property
    def _told(self) -> Lateness:
        return Lateness.of(self.setting.delay_s, self.setting.image_s)

    def _own(self, motions: Array, last: Array) -> Array:
        """Return its own motions with the newest: its last command, after the motors' lag."""
        left = np.exp(-self.setting.image_s / self.setting.told_motor_s)
        return np.concatenate([[last + left * (motions[0] - last)], motions[:-1]])

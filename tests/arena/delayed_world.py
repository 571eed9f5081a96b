"""A follower behind a leader that goes straight, integrated in small steps with a history.

The wheels' delayed differential equations T dv/dt = f c(t - delay) - v + H and, where their servo
has an integral, K dH/dt = f c(t - delay) - v, and the same for turning, by Euler's rule with 1 ms
steps: nothing of the stability report's matrices.
"""

from dataclasses import dataclass, field

import numpy as np

from tagmetry.arena.controllers import Spring, SpringFollower, View
from tagmetry.arena.drive import Twist
from tagmetry.arena.own_motion import OwnMotion
from tagmetry.arena.place import Place
from tagmetry.arena.told import Neighbour

STEP_S = 0.001
LEADER_MPS = 0.2
HERE = Place(0.0, 0.0, 0.0)


@dataclass
class DelayedWorld:
    """Its controller believes in `delay_s`; commands of speed and of turn act `untold_s` later."""

    delay_s: float
    untold_s: tuple[float, float] = (0.0, 0.0)
    gains: tuple[float, float] = (1.0, 1.0)
    image_s: float = 0.03
    motor_s: float = 0.05
    hold_s: float = float("inf")
    start: Place = HERE
    noise_m: float = 0.0
    length_m: float = 0.20
    speed_mps: float = LEADER_MPS
    rng: np.random.Generator = field(default_factory=lambda: np.random.default_rng(0))

    def __post_init__(self) -> None:
        self.follower = SpringFollower(0, Spring(length_m=self.length_m))
        self.own = OwnMotion(self.motor_s)
        self.x_m, self.y_m, self.heading_rad = vars(self.start).values()
        self.twist, self.held = Twist(self.speed_mps, 0.0), [0.0, 0.0]
        self.gaps_m, self.aside_m = [], []
        self.own._moving = self.own._wanted = self.twist
        self.follower._speed_mps = self.speed_mps
        self.follower._motion._twist = self.twist
        self.wanted = [[(-1.0, speed)] for speed in vars(self.twist).values()]

    def run(self, duration_s: float) -> "DelayedWorld":
        every = round(self.image_s / STEP_S)
        for _ in range(round(duration_s / STEP_S)):
            n = len(self.gaps_m)
            leader = Place(0.20 + self.speed_mps * n * STEP_S, 0.0, 0.0)
            here = Place(self.x_m, self.y_m, self.heading_rad)
            self.gaps_m.append(leader.distance_m(here))
            self.aside_m.append(self.y_m)
            if n % every == 0:
                self._look(n * STEP_S, leader.seen_from(here))
            self._move(n * STEP_S)
        return self

    def _look(self, time_s: float, leader: Place) -> None:
        acts_s = time_s + self.delay_s
        gap_m = float(np.hypot(leader.x_m, leader.y_m)) + self.noise_m * self.rng.standard_normal()
        seen = Neighbour(0, gap_m, leader.bearing_rad, leader.heading_rad, self.delay_s)
        view = View(1, acts_s, self.own.at(acts_s), (seen,), sensed_s=time_s)
        wish = self.follower(view)
        self.own.command(wish, acts_s)
        for n, value in enumerate(vars(wish).values()):
            self.wanted[n].append((acts_s + self.untold_s[n], value))

    def _move(self, time_s: float) -> None:
        for line in self.wanted:
            while len(line) > 1 and line[1][0] <= time_s + 1e-9:
                line.pop(0)
        speed, turn = vars(self.twist).values()
        self.x_m += STEP_S * speed * np.cos(self.heading_rad)
        self.y_m += STEP_S * speed * np.sin(self.heading_rad)
        self.heading_rad += STEP_S * turn
        self.twist = Twist(self._followed(0, speed), self._followed(1, turn))

    def _followed(self, n: int, rate: float) -> float:
        """Return the speed or the turn rate a step later."""
        missing = self.gains[n] * self.wanted[n][0][1] - rate
        rate += STEP_S / self.motor_s * (missing + self.held[n])
        self.held[n] += STEP_S / self.hold_s * missing
        return rate


def swing(values, first_s, last_s):
    """Return from the least to the largest value of a time."""
    part = np.array(values[round(first_s / STEP_S) : round(last_s / STEP_S)])
    return float(part.max() - part.min())

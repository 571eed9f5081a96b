"""Robots that follow their wishes after a motor's lag, for controllers: no physics, no images."""

from collections import deque
from collections.abc import Sequence

import numpy as np

from tagmetry.arena.controllers import Controller, View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import Place
from tagmetry.arena.told import Neighbour

STEP_S = 0.02


class SmallWorld:
    """All robots see all others within a range, `delay_s` late; commands act at once."""

    def __init__(
        self,
        starts: Sequence[Place],
        controllers: Sequence[Controller],
        delay_s: float = 0.0,
        lag_s: float = 0.05,
        range_m: float = 10.0,
    ) -> None:
        self.places, self.controllers = list(starts), controllers
        self.twists = [STILL] * len(starts)
        self.time_s, self.lag_s, self.range_m = 0.0, lag_s, range_m
        self._late = round(delay_s / STEP_S)
        self._seen: deque[list[Place]] = deque(maxlen=self._late + 1)
        self.least_m: list[float] = []

    def run(self, duration_s: float) -> "SmallWorld":
        for _ in range(round(duration_s / STEP_S)):
            self._seen.append(list(self.places))
            wishes = [control(self._view(n)) for n, control in enumerate(self.controllers)]
            share = STEP_S / (self.lag_s + STEP_S)
            self.twists = [
                Twist(
                    old.speed_mps + share * (new.speed_mps - old.speed_mps),
                    old.turn_rate_radps + share * (new.turn_rate_radps - old.turn_rate_radps),
                )
                for old, new in zip(self.twists, wishes, strict=True)
            ]
            self.places = [
                place.moved(twist.speed_mps * STEP_S, twist.turn_rate_radps * STEP_S)
                for place, twist in zip(self.places, self.twists, strict=True)
            ]
            self.time_s += STEP_S
            self.least_m.append(self._least_m())
        return self

    def gap_m(self, one: int, other: int) -> float:
        return self.places[one].distance_m(self.places[other])

    def _least_m(self) -> float:
        xy = np.array([(place.x_m, place.y_m) for place in self.places])
        away = np.linalg.norm(xy[:, None] - xy[None], axis=-1) + 1e3 * np.eye(len(xy))
        return float(away.min())

    def _view(self, robot: int) -> View:
        late_s = (len(self._seen) - 1) * STEP_S
        then = self._seen[0]
        neighbours = [
            self._neighbour(other, then[robot], then[other], late_s)
            for other in range(len(then))
            if other != robot and then[robot].distance_m(then[other]) < self.range_m
        ]
        place = self.places[robot]
        return View(
            robot,
            self.time_s,
            self.twists[robot],
            tuple(neighbours),
            place=place,
            sensed_s=self.time_s - late_s,
        )

    @staticmethod
    def _neighbour(other: int, own: Place, there: Place, late_s: float) -> Neighbour:
        seen = there.seen_from(own)
        range_m = float(np.hypot(seen.x_m, seen.y_m))
        return Neighbour(other, range_m, seen.bearing_rad, seen.heading_rad, late_s)

"""What a run of the simulated arena came to, in a few numbers."""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array
from tagmetry.pipeline.arena_twin.run import Moment


@dataclass(frozen=True)
class Summary:
    """A run.

    Attributes:
        duration_s: Simulated time.
        images: How many were measured.
        driven_m: By all robots together.
        nearest_m: Least distance between two robots' centres; infinite for a single one.
        touched: Pairs of ids that ever touched.
        place_rms_m: How far the arena's places were off the truth.
        stopped: What stood still at the end, and why, in words.
    """

    duration_s: float
    images: int
    driven_m: float
    nearest_m: float
    touched: frozenset[tuple[int, int]]
    place_rms_m: float
    stopped: tuple[str, ...]


class Summing:
    """Takes moments and tells what they came to."""

    def __init__(self) -> None:
        self._images = 0
        self._driven_m = 0.0
        self._nearest_m = float("inf")
        self._touched: frozenset[tuple[int, int]] = frozenset()
        self._squares_m2: list[float] = []
        self._before: Array | None = None
        self._last: Moment | None = None

    def take(self, moment: Moment) -> None:
        """Take one more."""
        places = np.array([place.xy_m for place in moment.places.values()])
        if self._before is not None:
            self._driven_m += float(np.linalg.norm(places - self._before, axis=1).sum())
        apart_m = np.linalg.norm(places[:, None] - places[None], axis=-1)
        apart_m[np.diag_indices(len(places))] = np.inf
        self._nearest_m = min(self._nearest_m, float(apart_m.min()))
        self._touched |= moment.touching
        self._squares_m2 += _squares_m2(moment)
        self._before, self._last = places, moment
        self._images += 1

    def summary(self) -> Summary:
        """Return what all moments so far came to."""
        last = self._last
        decisions = last.turn.decisions if last is not None else ()
        faults = last.faults if last is not None else {}
        return Summary(
            last.time_s if last is not None else 0.0,
            self._images,
            self._driven_m,
            self._nearest_m,
            self._touched,
            float(np.sqrt(np.mean(self._squares_m2))) if self._squares_m2 else float("nan"),
            tuple(f"robot {one.robot_id}: {one.told}" for one in decisions if one.must_stop)
            + tuple(f"robot {key}: {told}" for key, told in faults.items()),
        )


def _squares_m2(moment: Moment) -> list[float]:
    """Return squared errors of places as of now, those of robots that the image showed."""
    late_s = moment.time_s - moment.image_s
    squares = []
    for state in moment.turn.step.world:
        twist = moment.twists[state.id]
        then = moment.places[state.id].moved(
            -twist.speed_mps * late_s, -twist.turn_rate_radps * late_s
        )
        if state.seen:
            squares.append((state.x_m - then.x_m) ** 2 + (state.y_m - then.y_m) ** 2)
    return squares

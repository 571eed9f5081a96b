"""A thousand faults: robots vanish or leave the fence, and each is told to stop in time."""

import numpy as np
import pytest
from overhead import robot

from tagmetry.arena import Fence, Roster, SafetyRules, Sightings, StopForAll, Tracks, decide

ROBOTS = tuple(robot(number) for number in range(50))
FENCE = Fence(((-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0)))
RULES = SafetyRules(unseen_s=0.2, fence=FENCE)
SD = np.array([5e-4, 5e-4, 2e-3])
RATE = 30.0


def images(places: np.ndarray, rows: np.ndarray, rng: np.random.Generator) -> Sightings:
    count = len(rows)
    return Sightings(
        rows,
        places[rows] + SD * rng.standard_normal((count, 3)),
        np.broadcast_to(np.diag(SD**2), (count, 3, 3)),
        np.zeros((count, 3, 3)),
        np.full(count, 5.0),
    )


@pytest.mark.parametrize("seed", range(10))
def test_robots_that_vanish_are_stopped_in_time_and_no_others(seed: int) -> None:
    rng = np.random.default_rng(seed)
    vanish_s = rng.uniform(0.2, 0.6, len(ROBOTS))
    places = np.column_stack(
        [rng.uniform(-1, 1, (len(ROBOTS), 2)), rng.uniform(-3, 3, len(ROBOTS))]
    )
    tracks, time_s = Tracks(Roster(ROBOTS)), 0.0
    seen_s = np.zeros(len(ROBOTS))
    while time_s < 1.0:
        time_s += rng.uniform(0.5, 1.5) / RATE
        rows = np.flatnonzero(time_s < vanish_s)
        seen_s[rows] = time_s
        tracks.take(images(places, rows, rng), time_s)
        decisions = decide(tracks.world(), ROBOTS, RULES, StopForAll())
        must_stop = np.array([one.must_stop for one in decisions])
        np.testing.assert_array_equal(must_stop, time_s - seen_s > RULES.unseen_s)


@pytest.mark.parametrize("seed", range(10))
def test_robots_that_leave_the_fence_are_stopped_at_once(seed: int) -> None:
    """Of what one image shows: within five deviations of it, either answer is right."""
    rng = np.random.default_rng(100 + seed)
    headings = rng.uniform(-np.pi, np.pi, len(ROBOTS))
    ways = 0.8 * np.column_stack([np.cos(headings), np.sin(headings)])
    tracks, stopped_s = Tracks(Roster(ROBOTS)), np.full(len(ROBOTS), np.inf)
    for k in range(int(2.0 * RATE), int(3.8 * RATE)):
        time_s = k / RATE
        places = np.column_stack([ways * time_s, headings])
        tracks.take(images(places, np.arange(len(ROBOTS)), rng), time_s)
        decisions = decide(tracks.world(), ROBOTS, RULES, StopForAll())
        left_m = 2.0 - np.abs(places[:, :2]).max(axis=1) - ROBOTS[0].radius_m
        must_stop = np.array([one.must_stop for one in decisions])
        is_clear = np.abs(left_m) > 5e-3
        np.testing.assert_array_equal(must_stop[is_clear], left_m[is_clear] < 0)
        stopped_s[must_stop & np.isinf(stopped_s)] = time_s
    assert np.isfinite(stopped_s).all()

"""Seed 001, figures 13 and 14: a robot that follows another at 20 cm, at several delays.

The leader drives a line, a loop and a line; its wheels slip once where the floor is slippery. Both
go through the whole twin: physics, camera, arena, controllers and packets.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import hypot

from tagmetry.arena.place import Place, turned_rad
from tagmetry.lab.beside.seed001_following import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rows import FollowingMoment
from tagmetry.pipeline.arena_twin import Moment, Radio, Scenario, TwinArena
from tagmetry.pipeline.arena_twin.ready import ready_scenario
from tagmetry.twin.robots import SlipperyPatch

_DURATION_S = 22.0
_SLIPPERY = SlipperyPatch(
    0.45, -0.065, 0.06, 0.01
)  # below the leader's right wheel, after the loop


@dataclass(frozen=True)
class Case:
    """One drive.

    Attributes:
        delay_s: From the middle of an exposure until a command acts.
        slippery: One of the leader's wheels slips once.
        repeat: Which.
    """

    delay_s: float
    slippery: bool
    repeat: int


def cases(quick: bool) -> tuple[Case, ...]:
    """Return the delays, on a clean and on a slippery floor."""
    return tuple(
        Case(delay_s, slippery, repeat)
        for delay_s in ((0.05, 0.1) if quick else (0.02, 0.05, 0.1, 0.15))
        for slippery in (False, True)
        for repeat in range(1 if quick else 5)
    )


def measure(case: Case, seed: int) -> Sequence[FollowingMoment]:
    """Return where both robots are in every image, and what is said of that."""
    arena = TwinArena(_scenario(case, seed))
    rows = list(_rows(case, arena.run(_DURATION_S)))
    arena.close()
    return rows


def _scenario(case: Case, seed: int) -> Scenario:
    scenario = ready_scenario("leader_follower", 2, seed)
    return replace(
        scenario,
        camera_delay_s=0.7 * case.delay_s,
        radio=Radio(0.3 * case.delay_s, 0.0),
        patches=(_SLIPPERY,) if case.slippery else (),
    )


def _rows(case: Case, moments: Iterator[Moment]) -> Iterator[FollowingMoment]:
    started: float | None = None
    for moment in moments:
        leader, follower = moment.places[0], moment.places[1]
        seen = [moment.turn.step.world.robot(robot) for robot in (0, 1)]
        odometry = moment.odometry.get(0)
        if seen[0] is None or seen[1] is None or odometry is None:
            continue
        if started is None:  # odometry's own frame begins anywhere
            started = seen[0].heading_rad - odometry.heading_rad
        yield FollowingMoment(
            case.delay_s,
            case.slippery,
            case.repeat,
            moment.time_s,
            leader.x_m,
            leader.y_m,
            follower.x_m,
            follower.y_m,
            leader.distance_m(follower),
            hypot(seen[0].x_m - seen[1].x_m, seen[0].y_m - seen[1].y_m),
            seen[0].heading_rad,
            turned_rad(odometry.heading_rad + started),
            _truth_of_the_image(moment, leader),
            bool(moment.touching),
        )


def _truth_of_the_image(moment: Moment, leader: Place) -> float:
    """Return the leader's true heading when the image was taken."""
    late_s = moment.time_s - moment.image_s
    return leader.moved(0.0, -moment.twists[0].turn_rate_radps * late_s).heading_rad


EXPERIMENT = Experiment(
    name="seed001-following",
    title="How well does a robot follow another at 20 cm?",
    source="seed 001, figures 13 and 14",
    row=FollowingMoment,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

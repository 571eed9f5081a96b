"""Robots are stopped for every reason, and for no other."""

import numpy as np
import pytest
from overhead import robot

from tagmetry.arena import Fence, RobotState, SafetyRules, StopForAll, WorldState, decide
from tagmetry.errors import InputError

FENCE = Fence(((-1.0, -0.5), (1.0, -0.5), (1.0, 0.5), (-1.0, 0.5)))
ONE = robot(1)
HERE = RobotState(1, "robot 1", 0.0, 0.0, 0.0, 0.0, 0.0, np.eye(5), 0.0, True, 5.0)


def reasons(state: RobotState | None, stop: StopForAll, rules: SafetyRules) -> tuple[str, ...]:
    world = WorldState(5.0, () if state is None else (state,))
    (found,) = decide(world, [ONE], rules, stop)
    assert found.must_stop is bool(found.reasons)
    assert bool(found.told) is found.must_stop
    return found.reasons


@pytest.mark.parametrize(
    ("state", "expected"),
    [
        (HERE, ()),
        (None, ("never seen",)),
        (HERE._replace(age_s=0.5), ()),
        (HERE._replace(age_s=0.501), ("not seen",)),
        (HERE._replace(age_s=float("nan")), ("not seen",)),
        (HERE._replace(x_m=0.919), ()),
        (HERE._replace(x_m=0.921), ("outside the fence",)),
        (HERE._replace(y_m=-3.0), ("outside the fence",)),
        (HERE._replace(x_m=float("nan")), ("outside the fence",)),
        (HERE._replace(y_m=-3.0, age_s=9.0), ("not seen", "outside the fence")),
    ],
)
def test_reasons_to_stop(state: RobotState | None, expected: tuple[str, ...]) -> None:
    assert reasons(state, StopForAll(), SafetyRules(0.5, FENCE)) == expected
    pressed = StopForAll().pressed("button", 3.0)
    assert reasons(state, pressed, SafetyRules(0.5, FENCE)) == ("stop for all", *expected)


def test_a_margin_stops_earlier() -> None:
    state = HERE._replace(x_m=0.9)
    assert reasons(state, StopForAll(), SafetyRules(0.5, FENCE, 0.05)) == ("outside the fence",)


def test_the_stop_for_all_is_latched_with_its_first_reason() -> None:
    stop = StopForAll().pressed("space bar", 3.0).pressed("camera bumped", 4.0)
    assert (stop.is_pressed, stop.why, stop.time_s) == (True, "space bar", 3.0)
    assert not stop.reset().is_pressed


def test_depth_inside_a_fence_that_is_not_convex() -> None:
    corner = Fence(((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)))
    for place, inside_m in (
        ((0.5, 0.5), 0.5),
        ((1.5, 0.9), 0.1),
        ((1.5, 1.5), -0.5),
        ((0.2, 1.9), 0.1),
        ((-3.0, 0.5), -3.0),
        ((3.0, -1.0), -np.sqrt(2)),
    ):
        assert corner.inside_m(np.array(place)) == pytest.approx(inside_m)


@pytest.mark.parametrize(
    "corners",
    [((0, 0), (1, 1)), ((0, 0), (1, 1), (2, 2)), ((0, 0), (1, 0), (1, float("nan")))],
)
def test_refuses_a_fence_round_nothing(corners: tuple[tuple[float, float], ...]) -> None:
    with pytest.raises(InputError, match="fence"):
        Fence(corners)


def test_refuses_rules_that_cannot_be() -> None:
    with pytest.raises(InputError, match="unseen_s must be positive"):
        SafetyRules(0.0)
    with pytest.raises(InputError, match="margin_m must be finite"):
        SafetyRules(margin_m=float("inf"))

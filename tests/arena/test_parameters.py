"""Parameters: every one can be set within its range, acts, and nothing else changes."""

import pytest

from tagmetry.arena.controllers import (
    Aggregate,
    Arc,
    Controller,
    Course,
    Disperse,
    Formation,
    PathFollower,
    Shielded,
    SpringFollower,
    View,
    parameters_of,
    tuned,
)
from tagmetry.arena.drive import STILL
from tagmetry.arena.place import Place
from tagmetry.arena.told import Neighbour
from tagmetry.errors import InputError

START = Place(0.0, 0.0, 0.0)
CONTROLLERS: list[Controller] = [
    Aggregate(),
    Disperse(),
    Formation({0: START, 1: Place(-0.3, 0.0, 0.0)}, leader=0),
    PathFollower(Course(START, (Arc(1.0),))),
    SpringFollower(1),
    Shielded(Disperse()),
    Shielded(Shielded(Aggregate())),
]


def values(controller: Controller) -> dict[str, float]:
    return {one.name: one.value for one in parameters_of(controller)}


@pytest.mark.parametrize("controller", CONTROLLERS, ids=lambda one: type(one).__name__)
def test_each_can_be_set_to_its_ends_and_no_other_changes(controller: Controller) -> None:
    before = values(controller)
    assert before
    for one in parameters_of(controller):
        assert one.least <= one.value <= one.most
        for end in (one.least, one.most):
            assert values(tuned(controller, one.name, end)) == before | {one.name: end}
    assert values(controller) == before


@pytest.mark.parametrize("controller", CONTROLLERS, ids=lambda one: type(one).__name__)
@pytest.mark.parametrize("value", [-1e9, 1e9, float("nan"), float("inf")])
def test_refuses_what_is_out_of_range(controller: Controller, value: float) -> None:
    for one in parameters_of(controller):
        with pytest.raises(InputError, match=f"{one.name} is {one.least:g} to {one.most:g}"):
            tuned(controller, one.name, value)


def test_what_has_no_such_parameter_stays_as_it_is() -> None:
    def control(_: View) -> object:
        return STILL

    assert parameters_of(control) == ()
    assert tuned(control, "gap_m", 0.1) is control
    disperse = Disperse()
    assert tuned(disperse, "gap_m", 0.1) is disperse


def test_a_wider_distance_drives_robots_apart() -> None:
    near = View(0, 0.0, STILL, (Neighbour(1, 0.6, 3.14, 0.0, 0.0),))
    narrow, wide = Disperse(0.5), tuned(Disperse(0.5), "distance_m", 0.8)
    assert narrow(near) == STILL
    assert wide(near).speed_mps > 0.05


def test_a_spring_keeps_what_it_knows_when_it_is_lengthened() -> None:
    follower: Controller = SpringFollower(1)
    for n in range(30):
        follower(View(0, n / 30, STILL, (Neighbour(1, 0.2, 0.0, 0.0, 0.0),)))
    now = View(0, 1.0, STILL, (Neighbour(1, 0.2, 0.0, 0.0, 0.0),))
    assert tuned(follower, "length_m", 0.3)(now).speed_mps < -0.05

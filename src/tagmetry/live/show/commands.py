"""What operators ask of robots, checked against the floor and the robots that there are."""

from collections.abc import Collection, Mapping, Sequence
from math import isfinite

from tagmetry.arena.controllers.parameters import check_range
from tagmetry.errors import InputError
from tagmetry.live.messages import MOST_POINTS, FollowPath, GoTo, Halt, Resume, SetParameter
from tagmetry.live.show.errands import Errand, Visit, Wait, Walk
from tagmetry.live.show.steered import Steered, parameters_by_name
from tagmetry.pipeline.arena_twin.ready.stage import FLOOR_HALF_M

RobotOrder = FollowPath | GoTo | Halt | Resume | SetParameter


def command(steered: Mapping[int, Steered], order: RobotOrder) -> None:
    """Do what is asked of one robot, or set a parameter of all that have it.

    Args:
        steered: Every robot's controller, by id.
        order: What is asked.

    Raises:
        InputError: There is no such robot or parameter, or a value is out of its range.
    """
    if isinstance(order, SetParameter):
        _set(steered.values(), order)
    elif order.robot_id not in steered:
        raise InputError(f"there is no robot {order.robot_id}; there are {list(steered)}")
    else:
        steered[order.robot_id].errand = _errand(order)


def _errand(order: FollowPath | GoTo | Halt | Resume) -> Errand | None:
    match order:
        case GoTo(_, x_m, y_m):
            return Visit(_on_floor((x_m, y_m)))
        case FollowPath(_, points_m):
            return Walk(_path(points_m))
        case Halt():
            return Wait()
        case Resume():
            return None


def _path(points_m: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    if not 1 <= len(points_m) <= MOST_POINTS:
        raise InputError(f"a path has 1 to {MOST_POINTS} points, got {len(points_m)}")
    return [_on_floor(one) for one in points_m]


def _on_floor(point_m: tuple[float, float]) -> tuple[float, float]:
    pairs = zip(point_m, FLOOR_HALF_M, strict=True)
    if not all(isfinite(at_m) and abs(at_m) <= half_m for at_m, half_m in pairs):
        raise InputError(f"expected a place on the floor, within {FLOOR_HALF_M}, got {point_m}")
    return point_m


def _set(steered: Collection[Steered], order: SetParameter) -> None:
    known = parameters_by_name(steered)
    if order.name not in known:
        names = ", ".join(known) or "none"
        raise InputError(f"there is no parameter {order.name!r}; there are {names}")
    check_range(known[order.name], order.value)
    for one in steered:
        one.tune(order.name, order.value)

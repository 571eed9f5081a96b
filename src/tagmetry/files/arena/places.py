"""Where simulated robots of an arena start: where its file says, else at free places."""

from collections.abc import Collection, Iterator, Mapping

import numpy as np

from tagmetry.arena import Fence
from tagmetry.arena.place import Place
from tagmetry.errors import InputError

_APART_M = 0.3  # between centres
_REACH_M = 1.0  # from the middle, where there is no fence


def free_places(
    fence: Fence | None,
    diameter_m: float,
    taken: Collection[Place] = (),
    middle_m: tuple[float, float] = (0.0, 0.0),
) -> Iterator[Place]:
    """Yield places of a grid, the innermost first, where a robot stands whole and apart.

    Args:
        fence: They are inside; near a middle where None.
        diameter_m: Of a robot.
        taken: Where others stand.
        middle_m: Of the places, where there is no fence.
    """
    low, high = np.array(middle_m) - _REACH_M, np.array(middle_m) + _REACH_M
    if fence is not None:
        low, high = np.min(fence.corners_m, axis=0), np.max(fence.corners_m, axis=0)
    middle, step_m = (low + high) / 2, max(_APART_M, 1.5 * diameter_m)
    half = np.floor((high - low) / 2 / step_m).astype(int)
    grid = np.mgrid[-half[0] : half[0] + 1, -half[1] : half[1] + 1].reshape(2, -1).T * step_m
    for x_m, y_m in (middle + grid[np.argsort(np.hypot(*grid.T), kind="stable")]).tolist():
        place = Place(x_m, y_m, 0.0)
        is_inside = fence is None or fence.inside_m(place.xy_m) >= diameter_m
        if is_inside and all(place.distance_m(one) >= step_m for one in taken):
            yield place


def starts_of(
    given: Mapping[int, Place | None], fence: Fence | None, diameter_m: float
) -> dict[int, Place]:
    """Return where simulated robots start, by id: as given, else at free places.

    Raises:
        InputError: There are not so many free places.
    """
    said = [place for place in given.values() if place is not None]
    places = free_places(fence, diameter_m, said)
    return {
        robot_id: place if place is not None else next_place(places)
        for robot_id, place in given.items()
    }


def next_place(places: Iterator[Place]) -> Place:
    """Return the next free place.

    Raises:
        InputError: There is none.
    """
    place = next(places, None)
    if place is None:
        raise InputError("simulated robots find no free place any more; give each its start")
    return place

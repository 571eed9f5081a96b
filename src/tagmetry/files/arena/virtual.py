"""More robots for an arena, which are simulated."""

from dataclasses import replace

from tagmetry.arena import Mount, Robot, Roster
from tagmetry.errors import InputError
from tagmetry.files.arena.places import free_places, next_place
from tagmetry.files.arena.setup import ArenaSetup

_HIGHEST_ID = 0xFFFF


def with_virtual(
    setup: ArenaSetup, count: int, middle_m: tuple[float, float] = (0.0, 0.0)
) -> ArenaSetup:
    """Return an arena with so many simulated robots more, like its first one.

    They take the next free numbers and the family's last free markers.

    Args:
        setup: The arena.
        count: How many.
        middle_m: Where they start, side by side, where there is no fence to start in.

    Raises:
        InputError: There are not so many free markers, numbers or places.
    """
    first = setup.roster.robots[0]
    highest = max(robot.id for robot in setup.roster.robots)
    markers = _free_markers(setup, first.family)
    if count > min(len(markers), _HIGHEST_ID - highest):
        raise InputError(
            f"{count} more robots find no free marker of {first.family}: {len(markers)} are left"
        )
    more = [_like(first, highest + 1 + n, markers[n]) for n in range(count)]
    taken = setup.virtual.values()
    places = free_places(setup.safety.fence, first.diameter_m, taken, middle_m)
    starts = {robot.id: next_place(places) for robot in more}
    roster = Roster((*setup.roster.robots, *more))
    return replace(setup, roster=roster, virtual={**setup.virtual, **starts})


def _free_markers(setup: ArenaSetup, family: str) -> list[int]:
    """Return the ids that nothing of the arena has, the last first."""
    taken = {robot.marker_id for robot in setup.roster.robots if robot.family == family}
    taken |= {one.key.id for one in setup.floor if one.key.family == family}
    count = max((len(one) for one in setup.families if one.name == family), default=0)
    return [n for n in reversed(range(count)) if n not in taken]


def _like(robot: Robot, number: int, marker_id: int) -> Robot:
    return replace(
        robot,
        id=number,
        name=f"virtual {number}",
        marker_id=marker_id,
        mount=Mount(robot.mount.height_m),
        key=None,
    )

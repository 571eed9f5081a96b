"""Other computers in `tagmetry arena run`: they see what it sees, and command with a key."""

from collections.abc import Callable
from contextlib import ExitStack
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tagmetry.arena.controllers import Controller
    from tagmetry.files.arena import ArenaSetup
    from tagmetry.link.computers import ArenaBridge
    from tagmetry.pipeline.arena import ArenaMeasurement, Taker

Controllers = Callable[[int], "Controller"]


def opened_bridge(
    stack: ExitStack, setup: "ArenaSetup", *, has_listeners: bool
) -> "ArenaBridge | None":
    """Return the bridge that the arena's file asks for; None where it asks for none.

    Args:
        stack: Closes it.
        setup: The arena.
        has_listeners: There are robots that hear commands: real ones by a link, or simulated ones.
    """
    if setup.zenoh is None:
        return None
    from tagmetry.link.computers import ArenaBridge
    from tagmetry.link.computers.keys import OPEN_KEY

    said = setup.zenoh
    bridge = ArenaBridge(
        setup.name,
        {robot.id: robot.name for robot in setup.roster.robots},
        listen=said.listen,
        connect=said.connect,
        view_key=said.view_key or OPEN_KEY,
        command_key=said.command_key if has_listeners else None,
    )
    return stack.enter_context(bridge)


def shared_controllers(
    bridge: "ArenaBridge | None", own: Controllers | None
) -> tuple[Controllers | None, Callable[[int], bool] | None]:
    """Return who drives the robots, and whether a robot is driven just now."""
    if bridge is None or not bridge.is_obeying:
        return own, None
    from tagmetry.pipeline.arena.bridged import commanded_controllers

    def is_driven(robot_id: int) -> bool:
        return own is not None or bridge.command(robot_id) is not None

    return commanded_controllers(bridge, own), is_driven


def bridge_takers(
    bridge: "ArenaBridge | None", setup: "ArenaSetup", task: "ArenaMeasurement"
) -> "list[Taker]":
    """Return who tells other computers, behind a queue, and who hears their emergency stop."""
    if bridge is None:
        return []
    from tagmetry.pipeline.arena import Posted
    from tagmetry.pipeline.arena.bridged import BridgeTaker, RemoteStop
    from tagmetry.pipeline.arena.linked import sensor_ranges_m

    telling = BridgeTaker(bridge, *sensor_ranges_m(setup))
    return [RemoteStop(bridge, task), Posted(telling, longest=2, may_drop=True)]

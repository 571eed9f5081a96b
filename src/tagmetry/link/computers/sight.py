"""What a computer that looks on sees of an arena: all robots at the newest image's moment."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from tagmetry.arena import RobotState, WorldState
from tagmetry.arena.world_state import STATE_NAMES
from tagmetry.geometry import Array
from tagmetry.link.messages import ArenaState, Command, Message, Neighbours, State

SEEN, MUST_STAND = 1, 2  # flags of a state
STOPPED = 1  # flag of the arena
_SIZE = len(STATE_NAMES)
_UPPER = np.triu_indices(_SIZE)


@dataclass(frozen=True, eq=False)
class ArenaSight:
    """All that was told of one image.

    Attributes:
        world: The robots; times are the host's clock in seconds.
        image: Counts the images, from 0 when the arena began.
        is_stopped: The stop for all is pressed.
        held: The robots that must stand still, by id.
        missing: So many robots' states were lost on their way.
        neighbours: Whom each robot is told of, by id, where it has a sensor.
        commanded: What each robot is commanded, by id, where it is.
    """

    world: WorldState
    image: int
    is_stopped: bool
    held: frozenset[int]
    missing: int
    neighbours: Mapping[int, Neighbours] = field(default_factory=dict)
    commanded: Mapping[int, Command] = field(default_factory=dict)


class Gathering:
    """Puts the packets of an image together; the newest replaces what was before."""

    def __init__(self) -> None:
        self._states: dict[int, tuple[str, State]] = {}
        self._neighbours: dict[int, Neighbours] = {}
        self._commanded: dict[int, Command] = {}

    def add(self, robot_id: int, name: str, message: Message) -> ArenaSight | None:
        """Take what was said of a robot, or of all; return what is seen once an image is whole."""
        if isinstance(message, State):
            self._states[robot_id] = name, message
        elif isinstance(message, Neighbours):
            self._neighbours[robot_id] = message
        elif isinstance(message, Command):
            self._commanded[robot_id] = message
        elif isinstance(message, ArenaState):
            return self._sight(message)
        return None

    def _sight(self, told: ArenaState) -> ArenaSight:
        now = {
            robot_id: (name, state)
            for robot_id, (name, state) in sorted(self._states.items())
            if state.moment_us == told.moment_us
        }
        robots = tuple(robot_state(key, *value) for key, value in now.items())
        neighbours, self._neighbours = self._neighbours, {}
        commanded, self._commanded = self._commanded, {}
        return ArenaSight(
            WorldState(told.moment_us / 1e6, robots),
            told.image,
            bool(told.flags & STOPPED),
            frozenset(key for key, (_, state) in now.items() if state.flags & MUST_STAND),
            told.robots - len(robots),
            neighbours,
            commanded,
        )


def robot_state(robot_id: int, name: str, state: State) -> RobotState:
    """Return where a robot is, as the arena has it."""
    return RobotState(
        robot_id,
        name,
        state.x_m,
        state.y_m,
        state.heading_rad,
        state.speed_mps,
        state.turn_rate_radps,
        _covariance(state.covariance),
        state.age_s,
        bool(state.flags & SEEN),
        state.moment_us / 1e6,
    )


def state_message(state: RobotState, moment_us: int, *, must_stand: bool) -> State:
    """Return a robot's state as it is told, of a moment of the host's clock."""
    return State(
        moment_us,
        state.x_m,
        state.y_m,
        state.heading_rad,
        state.speed_mps,
        state.turn_rate_radps,
        state.age_s,
        SEEN * state.seen | MUST_STAND * must_stand,
        tuple(state.covariance[_UPPER].tolist()),
    )


def _covariance(upper: tuple[float, ...]) -> Array:
    """Return the matrix of its upper triangle, shape (5, 5)."""
    covariance = np.zeros((_SIZE, _SIZE))
    covariance[_UPPER] = upper
    return covariance + np.triu(covariance, 1).T

"""The robots' computers, simulated in this process."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from tagmetry.pipeline.arena_twin.air_client import AirClient
from tagmetry.pipeline.arena_twin.crew import Acts
from tagmetry.pipeline.arena_twin.on_board import OnBoard
from tagmetry.pipeline.arena_twin.scenario import TwinRobot


class Aboard:
    """All robots' computers, one after another."""

    def __init__(
        self, robots: Sequence[TwinRobot], keys: Mapping[int, bytes], rng: np.random.Generator
    ) -> None:
        """Switch them on.

        Args:
            robots: All there are.
            keys: Of their links, by id.
            rng: Where their nonces come from.
        """

        def draw_nonce() -> int:
            return int(rng.integers(1, 2**63))

        self._now_us = 0
        self._links = {
            one.robot.id: AirClient(
                one.robot.id, keys[one.robot.id], draw_nonce, lambda: self._now_us
            )
            for one in robots
        }
        self._computers = {one.robot.id: _computer(one, self._links) for one in robots}

    @property
    def faults(self) -> Mapping[int, str]:
        """What is wrong with controllers on board, by robot's id."""
        return {key: one.fault for key, one in self._computers.items() if one.fault is not None}

    def bring(self, robot_id: int, packet: bytes) -> None:
        """Let a packet arrive at a robot, before its next tick."""
        self._links[robot_id].bring(packet)

    def act(self, counts: NDArray[np.int64], now_us: int) -> Acts:
        """Let all robots' computers do one tick's work."""
        self._now_us = now_us
        both = zip(self._computers.values(), counts.tolist(), strict=True)
        wheels = [computer.step((left, right), now_us) for computer, (left, right) in both]
        packets = [packet for link in self._links.values() for packet in link.take_sent()]
        return Acts(tuple(packets), np.array(wheels))

    def close(self) -> None:
        """End the threads of controllers on board."""
        for computer in self._computers.values():
            computer.close()


def _computer(twin: TwinRobot, links: Mapping[int, AirClient]) -> OnBoard:
    controller = twin.controller() if twin.on_board and twin.controller is not None else None
    design, robot_id = twin.design, twin.robot.id
    return OnBoard(robot_id, design.drive, design.encoder_steps, links[robot_id], controller)

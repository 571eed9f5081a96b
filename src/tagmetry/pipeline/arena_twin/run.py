"""The simulated arena, running: physics, camera, arena, controllers, link, in simulated time.

Every 8 ms the robots' computers look at what has arrived, read their encoders and set their wheels.
Every image is measured when its delay is over; then the host takes its turn, and what it tells
leaves through the air. Nothing here waits for a clock: simulated time is as fast as the computer.
"""

from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from tagmetry.arena import Arena, Neighbourhood, Roster, StopForAll
from tagmetry.arena.drive import Twist
from tagmetry.arena.place import Place
from tagmetry.detect import Detection
from tagmetry.link import Odometry, RobotLink, Telemetry
from tagmetry.pipeline.arena.drivers import Drivers
from tagmetry.pipeline.arena.guarded import Guarded
from tagmetry.pipeline.arena.messages import (
    command_message,
    microseconds,
    neighbours_messages,
    pose_message,
)
from tagmetry.pipeline.arena.turning import Turn, Turning
from tagmetry.pipeline.arena_twin.aboard import Aboard
from tagmetry.pipeline.arena_twin.air import HOST, Air
from tagmetry.pipeline.arena_twin.base import Base
from tagmetry.pipeline.arena_twin.crew import Crew
from tagmetry.pipeline.arena_twin.eyes import CornerEye, Eye
from tagmetry.pipeline.arena_twin.processes import Processes
from tagmetry.pipeline.arena_twin.scenario import Scenario
from tagmetry.twin.robots import RobotsPhysics

TICK_S = 0.008
_PATIENCE_S = 5.0  # of the computer's time: a busy one must not stop a simulated robot


@dataclass(frozen=True, eq=False)
class Moment:
    """The arena when an image has been measured.

    Attributes:
        time_s: Now.
        image_s: When the image was taken.
        detections: What it showed.
        turn: What the host made of it.
        places: Where the robots truly are now, by id.
        twists: How they truly move now.
        odometry: What their wheels said last; robots that said nothing yet are left out.
        readings: Their telemetry, by id and name.
        links: How every robot's link does.
        touching: Pairs of ids of robots that touch.
        faults: What failed on the robots themselves, in words, by id.
    """

    time_s: float
    image_s: float
    detections: tuple[Detection, ...]
    turn: Turn
    places: Mapping[int, Place]
    twists: Mapping[int, Twist]
    odometry: Mapping[int, Odometry]
    readings: Mapping[int, Mapping[str, float]]
    links: tuple[RobotLink, ...]
    touching: frozenset[tuple[int, int]]
    faults: Mapping[int, str]


class TwinArena:
    """A scenario that runs."""

    def __init__(
        self, scenario: Scenario, eye: Eye | None = None, *, processes: bool = False
    ) -> None:
        """Put everything in its place.

        Args:
            scenario: What there is.
            eye: The camera; markers' corners with 0.05 px of noise, without pictures, when None.
            processes: Every robot's computer is a process of its own that speaks the link over
                UDP; simulated time waits for all of them.

        Raises:
            InputError: A robot's process cannot be started.
        """
        self.scenario = scenario
        rng = np.random.default_rng(scenario.seed)
        self._ids = [one.robot.id for one in scenario.robots]
        roster = Roster(tuple(one.robot for one in scenario.robots))
        self._physics = RobotsPhysics(
            [(one.design, one.start) for one in scenario.robots], scenario.blocks, scenario.patches
        )
        self._eye = eye or CornerEye(roster.robots, scenario.view, rng)
        secret = np.random.default_rng([scenario.seed, 1])  # what processes draw is their own
        keys = {robot_id: secret.bytes(32) for robot_id in self._ids}
        self._air = Air(scenario.radio, rng)
        self._base = Base(keys, self._air, secret)
        self._crew: Crew = (
            Processes(scenario.robots, keys) if processes else Aboard(scenario.robots, keys, secret)
        )
        drivers = Drivers(
            {
                one.robot.id: Guarded(one.controller(), _PATIENCE_S)
                for one in scenario.robots
                if one.controller is not None and not one.on_board
            }
        )
        self._turning = Turning(
            Arena(roster, scenario.view),
            Neighbourhood(
                scenario.sensor,
                obstacles=scenario.obstacles,
                radii_m={one.robot.id: one.robot.radius_m for one in scenario.robots},
                seed=scenario.seed,
            ),
            scenario.rules,
            drivers,
        )
        self._odometry: dict[int, Odometry] = {}
        self._readings: dict[int, dict[str, float]] = {}
        self._images: deque[tuple[float, tuple[Detection, ...]]] = deque()
        self._next_image = 0

    @property
    def time_s(self) -> float:
        """Now, in simulated time."""
        return self._physics.time_s

    @property
    def crew(self) -> Crew:
        """The robots' computers."""
        return self._crew

    @property
    def physics(self) -> RobotsPhysics:
        """The robots' bodies: to cut motors, to look at wheels."""
        return self._physics

    def run(self, duration_s: float) -> Iterator[Moment]:
        """Let time pass, and yield every image's moment as it is measured."""
        end_s = self.time_s + duration_s
        while self.time_s < end_s - TICK_S / 2:
            yield from self._tick()

    def stop(self, why: str = "pressed") -> None:
        """Stop all robots, and keep them stopped."""
        self._turning.stop = self._turning.stop.pressed(why, self.time_s)
        self._base.stop()

    def release(self) -> None:
        """Let them move again."""
        self._turning.stop = StopForAll()
        self._base.release()

    def close(self) -> None:
        """End the controllers' threads, and the robots' processes."""
        self._turning.drivers.close()
        self._crew.close()

    def _tick(self) -> Iterator[Moment]:
        now_s = self.time_s
        if now_s >= self._next_image / self.scenario.image_rate_hz - 1e-9:
            self._next_image += 1
            self._images.append((now_s, self._eye.look(now_s, self._physics.poses())))
        self._deliver(now_s)
        while self._images and self._images[0][0] + self.scenario.camera_delay_s <= now_s + 1e-9:
            yield self._moment(*self._images.popleft(), now_s)
        self._base.beat(microseconds(now_s))
        self._think(now_s)
        self._physics.step(TICK_S)

    def _deliver(self, now_s: float) -> None:
        for receiver, packet in self._air.arrived(now_s):
            if receiver == HOST:
                self._base.hear(packet, microseconds(now_s))
            else:
                self._crew.bring(receiver, packet)
        for received in self._base.take():
            if isinstance(received.message, Odometry):
                self._odometry[received.robot_id] = received.message
            elif isinstance(received.message, Telemetry):
                told = self._readings.setdefault(received.robot_id, {})
                told.update(received.message.readings)

    def _think(self, now_s: float) -> None:
        """Let the robots' computers do their work."""
        acts = self._crew.act(self._physics.encoder_counts(), microseconds(now_s))
        for packet in acts.packets:
            self._air.send(HOST, packet, now_s)
        self._physics.turn_wheels(acts.wheels_radps)

    def _moment(self, image_s: float, detections: tuple[Detection, ...], now_s: float) -> Moment:
        radio = self.scenario.radio
        acts_s = now_s + radio.delay_s + radio.jitter_s / 2
        turn = self._turning.turn(detections, image_s, lambda: acts_s)
        self._send(turn, now_s)
        return Moment(
            now_s,
            image_s,
            detections,
            turn,
            dict(zip(self._ids, self._physics.places(), strict=True)),
            dict(zip(self._ids, self._physics.twists(), strict=True)),
            dict(self._odometry),
            {one: dict(told) for one, told in self._readings.items()},
            self._base.links(microseconds(now_s)),
            frozenset((self._ids[a], self._ids[b]) for a, b in self._physics.touching()),
            dict(self._crew.faults),
        )

    def _send(self, turn: Turn, now_s: float) -> None:
        """Tell the robots: how to move, where they are, whom they sense."""
        now_us, reach_m = microseconds(now_s), self.scenario.sensor.range_m
        for robot_id, twist in turn.commands.items():
            self._base.send(robot_id, command_message(twist), now_us)
        for state in turn.world:
            self._base.send(state.id, pose_message(state, state.time_s), now_us)
        reaches_m = [reach_m] * len(turn.told)
        messages = neighbours_messages(turn.told, reaches_m, turn.step.world.time_s)
        for told, message in zip(turn.told, messages, strict=True):
            self._base.send(told.robot_id, message, now_us)

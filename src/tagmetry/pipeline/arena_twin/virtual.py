"""Simulated robots in an arena of real ones: they move by physics, and the arena sees them.

Their markers' corners, as the calibrated camera would see them and with its noise, join those of
the image. So their tracks, what others are told of them, their fence and their stops are those of
any robot. Real and simulated ones do not bump into each other.
"""

from collections import deque
from collections.abc import Mapping

import numpy as np

from tagmetry.arena import OverheadView, Robot, Roster
from tagmetry.arena.drive import STILL, Drive, Twist
from tagmetry.arena.place import Place
from tagmetry.detect import Detection
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.pipeline.arena.turning import Turn
from tagmetry.pipeline.arena_twin.eyes import CornerEye
from tagmetry.twin.robots import RobotDesign, RobotsPhysics

_STEP_S = 0.004
_COMMAND_S = 0.2  # as long as a robot obeys what it was told last
_KEPT = 100  # orders that do not act yet, and the one that does
_LONGEST_GAP_S = 1.0  # what is missing of a longer one they stand still in


class VirtualRobots:
    """The simulated robots of an arena; `pipeline.arena.Beside`."""

    def __init__(
        self,
        roster: Roster,
        starts: Mapping[int, Place],
        view: OverheadView,
        rng: np.random.Generator,
        noise_px: float = 0.05,
    ) -> None:
        """Put them down.

        Args:
            roster: All robots of the arena.
            starts: Where the simulated ones start, by id.
            view: The camera over the floor.
            rng: Where the noise of their markers' corners comes from.
            noise_px: Its standard deviation.

        Raises:
            MissingExtraError: The part `robots` is not installed.
        """
        own = [robot for robot in roster.robots if robot.id in starts]
        self._rows = {robot.id: row for row, robot in enumerate(own)}
        self._physics = RobotsPhysics([(_design(one), starts[one.id]) for one in own])
        self._eye = CornerEye(own, view, rng, noise_px)
        self._time_s = float("-inf")  # before the first image
        self._orders: dict[int, deque[tuple[float, Twist]]] = {  # from when, how to move
            robot.id: deque([(float("-inf"), STILL)], maxlen=_KEPT) for robot in own
        }

    def places(self) -> Mapping[int, Place]:
        """Return where they truly are, by id."""
        return dict(zip(self._rows, self._physics.places(), strict=True))

    def look(self, time_s: float) -> tuple[Detection, ...]:
        """Let time pass until an image, and return the markers that it would show."""
        self._pass(time_s)
        return self._eye.look(time_s, self._poses_later(time_s - self._time_s))

    def drive(self, turn: Turn) -> None:
        """Obey what the host commands, from when it acts; stand still where it commands nothing."""
        for robot_id in self._rows:
            order = turn.world.time_s, turn.commands.get(robot_id, STILL)
            self._orders[robot_id].append(order)

    def _pass(self, until_s: float) -> None:
        now_s = until_s if self._time_s == float("-inf") else self._time_s
        end_s = min(until_s, now_s + _LONGEST_GAP_S)
        while now_s + _STEP_S <= end_s:
            for robot_id, row in self._rows.items():
                self._physics.want(row, self._wish(robot_id, now_s))
            self._physics.step(_STEP_S)
            now_s += _STEP_S
        self._time_s = now_s if end_s == until_s else until_s

    def _wish(self, robot_id: int, now_s: float) -> Twist:
        newest_first = reversed(self._orders[robot_id])
        since_s, twist = next((one for one in newest_first if one[0] <= now_s), (now_s, STILL))
        return twist if now_s - since_s < _COMMAND_S else STILL

    def _poses_later(self, rest_s: float) -> RigidTransform:
        """Return T_world_robot of all, carried on by less than a step of the physics."""
        twists = self._physics.twists()
        ahead_m = [[rest_s * twist.speed_mps, 0.0, 0.0] for twist in twists]
        turns_rad = [[0.0, 0.0, rest_s * twist.turn_rate_radps] for twist in twists]
        T_robot_later = RigidTransform.from_components(ahead_m, Rotation.from_rotvec(turns_rad))
        return self._physics.poses() * T_robot_later


def _design(robot: Robot) -> RobotDesign:
    """Return the seed's robot, as large as this one."""
    seed = RobotDesign()
    share = robot.diameter_m / seed.diameter_m
    drive = Drive(
        share * seed.drive.wheel_radius_m,
        share * seed.drive.track_m,
        seed.drive.top_wheel_speed_radps,
    )
    return RobotDesign(drive, robot.diameter_m, max(robot.mount.height_m, 1e-3))

"""Robots that move as their wheels, masses and friction let them: MuJoCo, 4 ms a step."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tagmetry.arena.drive import Twist
from tagmetry.arena.place import Place
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.twin.robots.design import RobotDesign
from tagmetry.twin.robots.model import OVERTURNED_HEIGHT_M, TIME_STEP_S, Block, arena_xml
from tagmetry.twin.robots.servo import SpeedServos


@dataclass(frozen=True)
class SlipperyPatch:
    """A round place of the floor on which wheels grip less.

    Attributes:
        x_m: Its middle.
        y_m: Its middle.
        radius_m: How far it reaches.
        friction: Of every wheel on it.
    """

    x_m: float
    y_m: float
    radius_m: float
    friction: float


class RobotsPhysics:
    """All robots of an arena on one floor."""

    def __init__(
        self,
        robots: Sequence[tuple[RobotDesign, Place]],
        blocks: Sequence[Block] = (),
        patches: Sequence[SlipperyPatch] = (),
    ) -> None:
        """Put robots down.

        Args:
            robots: What each is made of and where it starts, its centre on the floor.
            blocks: What they can bump into.
            patches: Where the floor is slippery; the first that a wheel stands on counts.
        """
        if not robots:
            raise InputError("the simulated arena needs at least one robot, got none")
        self._mujoco = mujoco = _mujoco()
        self._model: Any = mujoco.MjModel.from_xml_string(arena_xml(robots, blocks))
        self._state: Any = mujoco.MjData(self._model)
        self._patches = tuple(patches)
        self._servo = SpeedServos([design for design, _ in robots])
        self._bodies = self._numbers("body", "robot{}", len(robots))
        self._wheel_bodies = self._both_sides("body", len(robots))
        self._wheel_geoms = self._both_sides("geom", len(robots))
        joints = self._both_sides("joint", len(robots))
        self._turn_at = self._model.jnt_qposadr[joints]
        self._speed_at = self._model.jnt_dofadr[joints]
        self._clean_friction = np.array([[design.wheel_friction] * 2 for design, _ in robots])
        mujoco.mj_forward(self._model, self._state)

    def __len__(self) -> int:
        """How many robots."""
        return len(self._bodies)

    @property
    def time_s(self) -> float:
        """Since they were put down."""
        return float(self._state.time)

    def want(self, robot: int, twist: Twist) -> None:
        """Give one robot's wheels the speeds of a motion, as far as they reach them."""
        self._servo.want(robot, twist)

    def turn_wheels(self, speeds_radps: Array) -> None:
        """Give all wheels the speeds of the left and right wheel of each robot, shape (n, 2)."""
        self._servo.turn(speeds_radps)

    def cut(self, robot: int, side: int | None = None) -> None:
        """Take a motor's power away for good: of one wheel (0 left, 1 right), or of both."""
        self._servo.powered[robot, slice(None) if side is None else side] = False

    def put(self, robot: int, place: Place) -> None:
        """Put one robot elsewhere, upright."""
        half_rad = place.heading_rad / 2
        turned_wxyz = (np.cos(half_rad), 0.0, 0.0, np.sin(half_rad))
        self._put(robot, (place.x_m, place.y_m, 0.0), turned_wxyz)

    def overturn(self, robot: int) -> None:
        """Lay one robot on its back where it is, on the marker on its roof."""
        x_m, y_m, _ = self._state.xpos[self._bodies[robot]]
        self._put(robot, (x_m, y_m, OVERTURNED_HEIGHT_M), (0.0, 1.0, 0.0, 0.0))

    def step(self, duration_s: float) -> None:
        """Let this much time pass, in whole steps."""
        for _ in range(max(1, round(duration_s / TIME_STEP_S))):
            self._grip()
            asked_radps, limits_Nm = self._servo.asks(self.wheel_speeds_radps)
            self._state.ctrl[:] = asked_radps.ravel()
            self._model.actuator_forcerange[:] = limits_Nm.reshape(-1, 1) * [-1.0, 1.0]
            self._mujoco.mj_step(self._model, self._state)

    @property
    def wheel_speeds_radps(self) -> Array:
        """Of the left and right wheel of each robot, shape (n, 2)."""
        return np.asarray(self._state.qvel[self._speed_at])

    @property
    def wheel_turns_rad(self) -> Array:
        """By how much each wheel has turned since the start, shape (n, 2)."""
        return np.asarray(self._state.qpos[self._turn_at])

    def encoder_counts(self) -> NDArray[np.int64]:
        """Return what the wheels' encoders have counted, whole steps, shape (n, 2)."""
        steps = self._servo.encoder_steps[:, None]
        return np.asarray(np.floor(self.wheel_turns_rad / (2 * np.pi) * steps), dtype=np.int64)

    def poses(self) -> RigidTransform:
        """Return T_world_robot of every robot, its origin on the floor below its centre."""
        quaternions_wxyz = self._state.xquat[self._bodies]
        turned = Rotation.from_quat(np.roll(quaternions_wxyz, -1, axis=1))
        return RigidTransform.from_components(self._state.xpos[self._bodies], turned)

    def places(self) -> tuple[Place, ...]:
        """Return where every robot's centre is, and its heading."""
        ahead = self._state.xmat[self._bodies].reshape(-1, 3, 3)[:, :, 0]
        headings_rad = np.arctan2(ahead[:, 1], ahead[:, 0])
        xy_m = self._state.xpos[self._bodies, :2]
        return tuple(
            Place(x_m, y_m, heading_rad)
            for (x_m, y_m), heading_rad in zip(xy_m.tolist(), headings_rad.tolist(), strict=True)
        )

    def twists(self) -> tuple[Twist, ...]:
        """Return how every robot moves: along its own forward axis, and about the vertical."""
        ahead = self._state.xmat[self._bodies].reshape(-1, 3, 3)[:, :, 0]
        first = self._model.body_dofadr[self._bodies]
        velocity = self._state.qvel[first[:, None] + np.arange(3)]
        turn = self._state.qvel[first + 5]
        return tuple(map(Twist, np.einsum("ij,ij->i", ahead, velocity).tolist(), turn.tolist()))

    def touching(self) -> frozenset[tuple[int, int]]:
        """Return the pairs of robots whose bodies touch, the lower number first."""
        owners = {int(body): n for n, body in enumerate(self._bodies)}
        owners |= {int(body): n for n, two in enumerate(self._wheel_bodies) for body in two}
        bodies = self._model.geom_bodyid[self._state.contact.geom]
        robots = [(owners.get(int(one), -1), owners.get(int(two), -1)) for one, two in bodies]
        pairs = ((min(pair), max(pair)) for pair in robots)
        return frozenset(pair for pair in pairs if -1 < pair[0] < pair[1])

    def _put(self, robot: int, at_m: Sequence[float], turned_wxyz: Sequence[float]) -> None:
        """Put a body somewhere, at rest."""
        body = self._bodies[robot]
        place_at = self._model.jnt_qposadr[self._model.body_jntadr[body]]
        speed_at = self._model.body_dofadr[body]
        self._state.qpos[place_at : place_at + 7] = (*at_m, *turned_wxyz)
        self._state.qvel[speed_at : speed_at + 6] = 0.0
        self._mujoco.mj_forward(self._model, self._state)

    def _grip(self) -> None:
        """Give each wheel the friction of the floor below it."""
        if not self._patches:
            return
        friction = self._clean_friction.copy()
        wheels_m = self._state.xpos[self._wheel_bodies, :2]
        for patch in reversed(self._patches):
            off_m = np.linalg.norm(wheels_m - [patch.x_m, patch.y_m], axis=-1)
            friction[off_m < patch.radius_m] = patch.friction
        self._model.geom_friction[self._wheel_geoms, 0] = friction

    def _both_sides(self, kind: str, count: int) -> Array:
        sides = [self._numbers(kind, side + "{}", count) for side in ("left", "right")]
        return np.column_stack(sides)

    def _numbers(self, kind: str, pattern: str, count: int) -> Array:
        named = getattr(self._model, kind)
        return np.array([named(pattern.format(n)).id for n in range(count)])


def _mujoco() -> Any:  # noqa: ANN401 - it has no types
    try:
        import mujoco
    except ImportError as error:
        raise MissingExtraError("simulated robots", "robots") from error
    return mujoco

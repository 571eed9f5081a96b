"""Small simulated arenas."""

import numpy as np

from tagmetry.arena import Mount, OverheadView, Robot
from tagmetry.arena.controllers import Arc, Course, PathFollower, SpringFollower
from tagmetry.arena.place import Place
from tagmetry.camera import BrownLens, Camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.pipeline.arena_twin import Radio, Scenario, TwinArena, TwinRobot

CAMERA = Camera(
    1920, 1080, (1273.0, 1270.0), (952.4, 545.1), BrownLens((-0.2, 0.05, 0.0004, -0.0007))
)
VIEW = OverheadView(
    CAMERA,
    RigidTransform.from_components([0.8, 0.3, 2.5], Rotation.from_euler("x", np.pi)),
    np.zeros((6, 6)),
)
HERE = Place(0.0, 0.0, 0.0)


def twin_robot(number, start=HERE, controller=None, **more):
    robot = Robot(number, f"robot {number}", 0.16, "tag36h11", number, 0.08, Mount(0.093))
    return TwinRobot(robot, start, controller, **more)


def course(start_s=1.0, line_m=0.8):
    return Course(HERE, (Arc(line_m), Arc(2.2, 2 * np.pi), Arc(line_m)), start_s=start_s)


def pair(delay_s=0.05, path=None, *, on_board=False, loss=0.0, **more):
    """Return a leader on its way and a follower 20 cm behind it, at a delay of all in all."""
    path = path or course()
    leader = twin_robot(0, HERE, lambda: PathFollower(path))
    follower = twin_robot(1, Place(-0.2, 0, 0), lambda: SpringFollower(0), on_board=on_board)
    radio = Radio(0.4 * delay_s - 0.001, 0.002, loss)
    return Scenario((leader, follower), VIEW, camera_delay_s=0.6 * delay_s, radio=radio, **more)


def ran(scenario, duration_s, *, processes=False):
    """Return all moments of a run."""
    arena = TwinArena(scenario, processes=processes)
    moments = list(arena.run(duration_s))
    arena.close()
    return moments

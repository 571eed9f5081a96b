"""The speed servos on board of robots, a motor for each wheel.

A servo's torque is proportional to the missing speed, with an integral that is held while the motor
gives all it can. A motor's torque falls in a straight line from its stall torque at rest to nothing
at its top speed.
"""

from collections.abc import Sequence

import numpy as np

from tagmetry.arena.drive import Twist
from tagmetry.geometry import Array
from tagmetry.twin.robots.design import RobotDesign
from tagmetry.twin.robots.model import TIME_STEP_S


class SpeedServos:
    """The speed servos of all wheels: torque = gain (wanted - speed) + what is held against drag.

    MuJoCo computes the first term with the step's own new speed, which is stable where a wheel
    slips and only its own small mass resists; so the held torque is given as a speed on top.

    Attributes:
        encoder_steps: Of a turn of each robot's wheels, shape (n,).
        powered: Which motors have power: left and right of each robot, shape (n, 2).
    """

    def __init__(self, designs: Sequence[RobotDesign]) -> None:
        """Put one on each wheel of robots."""
        self._drives = [design.drive for design in designs]
        self.encoder_steps = np.array([design.encoder_steps for design in designs])
        self.powered = np.ones((len(designs), 2), dtype=bool)
        self._stall_Nm = np.array([[design.stall_torque_nm] for design in designs])
        self._top_radps = np.array([[one.top_wheel_speed_radps] for one in self._drives])
        self._gain = np.array([[design.servo_gain_nms] for design in designs])
        self._rate = np.array([[TIME_STEP_S / one.servo_hold_s] for one in designs])
        self._wanted_radps = np.zeros((len(designs), 2))
        self._held_radps = np.zeros((len(designs), 2))

    def want(self, robot: int, twist: Twist) -> None:
        """Want the speeds of a motion of one robot's wheels, as far as they reach them."""
        drive = self._drives[robot]
        self._wanted_radps[robot] = drive.wheel_speeds_radps(drive.within(twist))

    def turn(self, speeds_radps: Array) -> None:
        """Want speeds of all wheels, shape (n, 2), as far as they reach them."""
        self._wanted_radps[:] = np.clip(speeds_radps, -self._top_radps, self._top_radps)

    def asks(self, speeds_radps: Array) -> tuple[Array, Array]:
        """Return the speeds to ask for and the torques at hand, each of shape (n, 2)."""
        missing_radps = self._wanted_radps - speeds_radps
        torques_Nm = self._gain * (missing_radps + self._held_radps)
        driving = torques_Nm * speeds_radps > 0
        share = np.where(driving, 1 - np.abs(speeds_radps) / self._top_radps, 1.0)
        limits_Nm = self._stall_Nm * np.clip(share, 0, 1) * self.powered
        enough = np.abs(torques_Nm) < limits_Nm
        self._held_radps += np.where(enough, self._rate * missing_radps, 0.0)
        return self._wanted_radps + self._held_radps, limits_Nm

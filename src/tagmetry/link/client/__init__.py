"""The robot's end of the link: in Python, and the sources in C for computers and ESP32."""

from tagmetry.link.client.robot import Robot
from tagmetry.link.client.robot_client import RobotClient

__all__ = ["Robot", "RobotClient"]

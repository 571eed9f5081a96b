"""Simulated two-wheeled robots: masses, motors, wheels that slip, and radio."""

from tagmetry.twin.robots.design import RobotDesign
from tagmetry.twin.robots.model import Wall
from tagmetry.twin.robots.physics import RobotsPhysics, SlipperyPatch

__all__ = ["RobotDesign", "RobotsPhysics", "SlipperyPatch", "Wall"]

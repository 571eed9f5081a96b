"""Simulated two-wheeled robots: masses, motors, wheels that slip, and radio."""

from tagmetry.twin.robots.design import RobotDesign
from tagmetry.twin.robots.model import Block
from tagmetry.twin.robots.physics import RobotsPhysics, SlipperyPatch

__all__ = ["Block", "RobotDesign", "RobotsPhysics", "SlipperyPatch"]

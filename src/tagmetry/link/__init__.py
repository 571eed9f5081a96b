"""Packets to and from robots: sealed, in time, and never obeyed for longer than the host lives."""

from tagmetry.link.client import RobotClient
from tagmetry.link.host import Host, now_us
from tagmetry.link.keys import new_key, parse_key
from tagmetry.link.layout import Kind
from tagmetry.link.messages import (
    Beat,
    Command,
    EmergencyStop,
    Message,
    Neighbour,
    Neighbours,
    Odometry,
    Pose,
    Telemetry,
)
from tagmetry.link.packet import Refusal
from tagmetry.link.peer import RobotLink
from tagmetry.link.traffic import Packet, Received, packet_message
from tagmetry.link.wire import PORT

__all__ = [
    "PORT",
    "Beat",
    "Command",
    "EmergencyStop",
    "Host",
    "Kind",
    "Message",
    "Neighbour",
    "Neighbours",
    "Odometry",
    "Packet",
    "Pose",
    "Received",
    "Refusal",
    "RobotClient",
    "RobotLink",
    "Telemetry",
    "new_key",
    "now_us",
    "packet_message",
    "parse_key",
]

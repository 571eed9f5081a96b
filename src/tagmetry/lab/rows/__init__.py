"""The rows of results that experiments write and conclusions read."""

from tagmetry.lab.rows.limits import Limit
from tagmetry.lab.rows.seed001 import (
    FloorError,
    FollowingMoment,
    Rate,
    SliderPlace,
    SwarmPlace,
)
from tagmetry.lab.rows.seed002 import Followed, Localization
from tagmetry.lab.rows.seed003 import Position, Quantity
from tagmetry.lab.rows.seed004 import RobotPlace

__all__ = [
    "FloorError",
    "Followed",
    "FollowingMoment",
    "Limit",
    "Localization",
    "Position",
    "Quantity",
    "Rate",
    "RobotPlace",
    "SliderPlace",
    "SwarmPlace",
]

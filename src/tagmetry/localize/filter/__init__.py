"""The camera's pose over time: what images say, joined by how cameras move."""

from tagmetry.localize.filter.motion import Motion
from tagmetry.localize.filter.pose_filter import FilteredPose, PoseFilter
from tagmetry.localize.filter.speeds import Speeds

__all__ = ["FilteredPose", "Motion", "PoseFilter", "Speeds"]

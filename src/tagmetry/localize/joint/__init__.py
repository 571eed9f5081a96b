"""The joint solution: one camera pose from the corners of all markers."""

from tagmetry.localize.joint.solve import JointCorners

__all__ = ["JointCorners"]

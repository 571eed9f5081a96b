"""TUM trajectories: `timestamp tx ty tz qx qy qz qw`, one line per pose of one marker.

Seconds, metres, unit quaternion. The pose is `T_camera_marker`, or `T_marker_camera` when the
camera's way past a fixed marker is wanted. Images without a time count as one second each.
"""

from contextlib import ExitStack
from dataclasses import dataclass
from typing import BinaryIO

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.record.result import ImageResult
from tagmetry.record.told import quaternion_xyzw

MarkerKey = tuple[str, int]  # family and id


class TrajectoryEncoder:
    """Writes where one marker was."""

    def __init__(self, marker: MarkerKey | None = None, *, inverse: bool = False) -> None:
        """Choose the marker.

        Args:
            marker: Family and id; without it the only marker there is.
            inverse: Write `T_marker_camera` instead of `T_camera_marker`.
        """
        self._marker = marker
        self._inverse = inverse
        self._seen: set[MarkerKey] = set()

    def begin(self, file: BinaryIO, stack: ExitStack) -> None:  # noqa: ARG002
        """Write the comment that names the columns."""
        pose = "T_marker_camera" if self._inverse else "T_camera_marker"
        self._file = file
        self._file.write(f"# {pose}: timestamp tx ty tz qx qy qz qw\n".encode())

    def write(self, item: ImageResult) -> None:
        """Write the marker's pose, if the image shows it; the first, if it does so twice."""
        poses = {pose.key: pose.T_camera_marker for pose in reversed(_posed(item))}
        self._seen |= poses.keys()
        if self._marker is None and len(self._seen) > 1:
            raise InputError(f"a trajectory is of one marker: choose one of {_listed(self._seen)}")
        for key in poses.keys() & {self._marker or next(iter(self._seen), None)}:
            self._file.write(self._line(item, poses[key]).encode())

    def finish(self) -> None:
        """Refuse to leave an empty trajectory of a marker that was asked for."""
        if self._marker is not None and self._marker not in self._seen:
            there = _listed(self._seen) or "none"
            raise InputError(f"no pose of {_listed({self._marker})} in any image; seen: {there}")

    def _line(self, item: ImageResult, T_camera_marker: RigidTransform) -> str:
        T = T_camera_marker.inv() if self._inverse else T_camera_marker
        time_s = float(item.sequence) if item.time_kind == "none" else item.time_s
        numbers = [time_s, *np.asarray(T.translation).tolist(), *quaternion_xyzw(T).tolist()]
        return " ".join(map(repr, numbers)) + "\n"


@dataclass(frozen=True)
class _Posed:
    key: MarkerKey
    T_camera_marker: RigidTransform


def _posed(result: ImageResult) -> list[_Posed]:
    return [
        _Posed((pose.family, pose.id), pose.best.T_camera_marker)
        for pose in (marker.pose for marker in result.markers)
        if pose is not None and pose.hypotheses
    ]


def _listed(markers: set[MarkerKey]) -> str:
    return ", ".join(f"{family} {number}" for family, number in sorted(markers))

"""How a camera stands to the things at a time, row by row of its sensor.

A global shutter sees all rows at one time; a rolling shutter reads row v at

    t(v) = time + (v - (height - 1) / 2) line,

so that every row has its own pose of whatever moves against the camera.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.twin.scenes.path import Path


@dataclass(frozen=True, eq=False)
class View:
    """A camera on its path, at a time.

    Attributes:
        camera: Intrinsics of the sensor's image.
        path: Where the camera is, T_world_camera.
        time_s: When the middle row is seen.
        line_s: Time from one row to the next; 0 for a global shutter.
    """

    camera: Camera
    path: Path
    time_s: float = 0.0
    line_s: float = 0.0

    def times_s(self, rows_px: Array) -> Array:
        """Return when rows are seen."""
        return self.time_s + (rows_px - (self.camera.height_px - 1) / 2) * self.line_s

    def T_world_thing(self, thing: Path) -> RigidTransform:  # noqa: N802 (a frame)
        """Return where a thing is in the world for the middle row."""
        return thing.at(np.array([self.time_s]))[0]

    def T_camera_thing(self, thing: Path) -> RigidTransform:  # noqa: N802 (a frame)
        """Return where a thing is for the middle row."""
        return self._relative(thing, np.array([self.time_s]))[0]

    def Ts_camera_thing(self, thing: Path, rows_px: Array) -> RigidTransform:  # noqa: N802
        """Return where a thing is for every row, or its one pose where all rows see the same."""
        if not self.rolls_over(thing):
            return self.T_camera_thing(thing)
        return self._relative(thing, self.times_s(rows_px))

    def rolls_over(self, thing: Path) -> bool:
        """Say whether rows can see a thing at different places."""
        return self.line_s != 0 and (self.path.moves or thing.moves)

    def _relative(self, thing: Path, times_s: Array) -> RigidTransform:
        return self.path.at(times_s).inv() * thing.at(times_s)

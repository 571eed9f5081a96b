"""Camera poses as files: JSON lines with everything, TUM trajectories for other tools."""

import json
from contextlib import ExitStack
from pathlib import Path
from typing import BinaryIO

import numpy as np

from tagmetry.errors import InputError
from tagmetry.pipeline.location import Located
from tagmetry.record.jsonl import LinesWriter
from tagmetry.record.line import printable
from tagmetry.record.told import quaternion_xyzw
from tagmetry.record.whole import WholeFileWriter, Writer


def open_location_writer(path: str | Path) -> Writer[Located]:
    """Return a writer by the suffix, to be used in a with-block.

    `.jsonl` holds every line at once, and `-` is the same on the standard output; `.tum` appears
    when the block ends without an error.

    Raises:
        InputError: The suffix is another one; later, the file cannot be written.
    """
    if str(path) == "-" or Path(path).suffix.lower() == ".jsonl":
        return LinesWriter(path, location_line)
    if Path(path).suffix.lower() == ".tum":
        return WholeFileWriter(path, LocationTrajectory())
    raise InputError(f"camera poses are written as .jsonl or .tum, got {str(path)[-60:]}")


def location_line(located: Located) -> str:
    """Return a line of JSON without its end; the pose is null where there is none."""
    T = located.T_world_camera
    pose = None
    if T is not None:
        pose = {
            "rotation_xyzw": quaternion_xyzw(T).tolist(),
            "translation_m": np.asarray(T.translation).tolist(),
        }
    line = {
        "source": printable(located.source),
        "sequence": located.sequence,
        "time_s": located.time_s,
        "method": located.method,
        "T_world_camera": pose,
        "covariance": None if pose is None else located.covariance.tolist(),
        "probability": None if pose is None else located.probability,
        "markers": [key.id for key in located.used],
        "rejected": [{"id": one.key.id, "why": one.why} for one in located.rejected],
        "age_s": located.age_s,
    }
    if pose is None:
        line["why"] = located.why
    return json.dumps(line, allow_nan=False, separators=(",", ":"))


class LocationTrajectory:
    """Writes `timestamp tx ty tz qx qy qz qw` of T_world_camera for every image that has a pose.

    Images without a time count as one second each.
    """

    def begin(self, file: BinaryIO, stack: ExitStack) -> None:  # noqa: ARG002
        """Write the comment that names the columns."""
        self._file = file
        self._file.write(b"# T_world_camera: timestamp tx ty tz qx qy qz qw\n")

    def write(self, item: Located) -> None:
        """Write one pose."""
        T = item.T_world_camera
        if T is None:
            return
        time_s = float(item.sequence) if item.time_kind == "none" else item.time_s
        numbers = [time_s, *np.asarray(T.translation).tolist(), *quaternion_xyzw(T).tolist()]
        self._file.write((" ".join(map(repr, numbers)) + "\n").encode())

    def finish(self) -> None:
        """Nothing comes last."""

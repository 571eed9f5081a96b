"""TUM trajectories read: `timestamp tx ty tz qx qy qz qw`, a line per pose.

Seconds, metres, a quaternion of any length but zero; words are parted by spaces or commas, and
lines that begin with # are comments.
"""

from pathlib import Path

import numpy as np

from tagmetry.errors import InputError
from tagmetry.files.text import named_errors, read_text
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize.trajectory import Trajectory

_LARGEST_BYTES = 256 * 1024 * 1024  # some hours at 200 poses a second


def load_trajectory(path: str | Path) -> Trajectory:
    """Return the poses of a TUM file.

    Raises:
        InputError: The file is missing or broken, or its times do not rise; the text says where.
    """
    path = Path(path)
    text = read_text(path, _LARGEST_BYTES)
    with named_errors(path):
        lines = [(n, line.strip()) for n, line in enumerate(text.splitlines(), 1)]
        table = _table([(n, line) for n, line in lines if line and not line.startswith("#")])
        R = Rotation.from_quat(table[:, 4:])
        return Trajectory(table[:, 0], RigidTransform.from_components(table[:, 1:4], R))


def _table(lines: list[tuple[int, str]]) -> Array:
    if not lines:
        raise InputError("expected poses, found only comments")
    rows: list[list[float]] = []
    for number, line in lines:
        row = _numbers(number, line)
        if rows and row[0] <= rows[-1][0]:
            raise InputError(f"line {number}: time does not rise, {row[0]:.6f} s")
        rows.append(row)
    return np.array(rows)


def _numbers(number: int, line: str) -> list[float]:
    try:
        row = [float(word) for word in line.replace(",", " ").split()]
    except ValueError:
        row = []
    if len(row) != 8 or not np.isfinite(row).all():
        raise InputError(
            f"line {number}: expected the 8 numbers time_s tx ty tz qx qy qz qw, found "
            f"{line[:60]!r}"
        )
    if not np.linalg.norm(row[4:]) > 1e-6:
        raise InputError(f"line {number}: the quaternion is zero")
    return row

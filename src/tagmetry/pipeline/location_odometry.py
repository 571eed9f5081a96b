"""A robot's odometry from a CSV file, as speeds of its camera.

Columns by name: `time_s`, then any of `forward_m_s`, `left_m_s`, `turn_rad_s` (to the left). The
robot's frame is x forward, y left, z up. The camera's velocity is that of its place on the robot:
v + w x p.
"""

import csv
import io
from pathlib import Path

import numpy as np

from tagmetry.errors import InputError
from tagmetry.files.text import named_errors, read_text
from tagmetry.geometry import RigidTransform
from tagmetry.localize.filter import Speeds

_COLUMNS = ("forward_m_s", "left_m_s", "turn_rad_s")


def load_odometry(path: str | Path, T_robot_camera: RigidTransform) -> list[tuple[float, Speeds]]:
    """Return times and speeds of a camera on a robot, by rising time.

    Raises:
        InputError: The file is missing or broken, or its times do not rise.
    """
    path = Path(path)
    rows = csv.DictReader(io.StringIO(read_text(path)))
    with named_errors(path):
        names = [name.strip() for name in rows.fieldnames or []]
        if "time_s" not in names or not set(_COLUMNS) & set(names):
            raise InputError(
                f"expected the columns time_s and some of {', '.join(_COLUMNS)}, found "
                f"{', '.join(names)[:80] or 'none'}"
            )
        found: list[tuple[float, Speeds]] = []
        for number, row in enumerate(rows, 2):
            values = {str(key).strip(): _number(value, number) for key, value in row.items()}
            if found and values["time_s"] <= found[-1][0]:
                raise InputError(f"line {number}: time runs backwards, {values['time_s']:g} s")
            found.append((values["time_s"], _speeds(values, T_robot_camera)))
    return found


def _number(text: object, number: int) -> float:
    try:
        value = float(str(text))
    except ValueError:
        value = float("nan")
    if not np.isfinite(value):
        raise InputError(f"line {number}: expected finite numbers, found {str(text)[:40]!r}")
    return value


def _speeds(values: dict[str, float], T_robot_camera: RigidTransform) -> Speeds:
    forward, left, turn = (values.get(name, 0.0) for name in _COLUMNS)
    rate = np.array([0.0, 0.0, turn])
    speed = np.array([forward, left, 0.0]) + np.cross(rate, T_robot_camera.translation)
    to_camera = T_robot_camera.rotation.inv()
    moves = "forward_m_s" in values or "left_m_s" in values
    return Speeds(
        speed_m_s=to_camera.apply(speed) if moves else None,
        rate_rad_s=to_camera.apply(rate) if "turn_rad_s" in values else None,
    )

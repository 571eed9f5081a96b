"""A swarm's run, second by second, from the rows of its robots."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from tagmetry.geometry import Array
from tagmetry.lab.rows import SwarmPlace

LINK_M = 0.32  # two bodies: so near are those of one crowd
_NEAR_SHARE = 0.1  # of the whole change: from then on it has converged


@dataclass(frozen=True, eq=False)
class SwarmRun:
    """One run, second by second.

    Attributes:
        task: What the swarm does.
        time_s: Shape (t,).
        xy_m: Shape (t, n, 2).
        nearest_m: Of every robot, shape (t, n).
        off_m: From its place in the formation, shape (t, n).
        told: Neighbours of every robot, shape (t, n).
        touched: How many robots ever touched another.
        faster: Simulated time by processor time.
    """

    task: str
    time_s: Array
    xy_m: Array
    nearest_m: Array
    off_m: Array
    told: Array
    touched: int
    faster: float

    @property
    def robots(self) -> int:
        """How many."""
        return int(self.xy_m.shape[1])

    @property
    def measure_m(self) -> Array:
        """What the task wants small or large, shape (t,)."""
        if self.task == "disperse":
            return np.asarray(self.nearest_m.mean(axis=1))
        if self.task == "formation":
            return np.asarray(self.off_m[:, 1:].mean(axis=1))
        middle = self.xy_m.mean(axis=1, keepdims=True)
        return np.asarray(np.linalg.norm(self.xy_m - middle, axis=2).mean(axis=1))

    @property
    def crowds(self) -> int:
        """In how many crowds the robots stand at the end: chains of those that are near."""
        xy_m = self.xy_m[-1]
        near = np.linalg.norm(xy_m[:, None] - xy_m[None], axis=-1) < LINK_M
        return int(connected_components(csr_array(near))[0])

    @property
    def converged_s(self) -> float:
        """Since when the measure is near what it is at the end."""
        measure_m = self.measure_m
        allowed_m = _NEAR_SHARE * np.abs(measure_m - measure_m[-1]).max()
        away = np.flatnonzero(np.abs(measure_m - measure_m[-1]) > allowed_m)
        return float(self.time_s[away[-1] + 1]) if len(away) else 0.0


def swarm_runs(rows: Sequence[SwarmPlace]) -> list[SwarmRun]:
    """Return the runs that rows are of, in their order."""
    keys = list(dict.fromkeys((row.task, row.robots, row.repeat) for row in rows))
    return [_run([row for row in rows if _key(row) == key]) for key in keys]


def _key(row: SwarmPlace) -> tuple[str, int, int]:
    return row.task, row.robots, row.repeat


def _run(rows: Sequence[SwarmPlace]) -> SwarmRun:
    def of(name: str) -> Array:
        values = np.array([getattr(row, name) for row in rows], dtype=np.float64)
        return values.reshape(-1, rows[0].robots)

    spent_s = max(rows[-1].cpu_s - rows[0].cpu_s, 1e-9)
    return SwarmRun(
        rows[0].task,
        of("time_s")[:, 0],
        np.stack([of("x_m"), of("y_m")], axis=-1),
        of("nearest_m"),
        of("off_m"),
        of("told"),
        int(of("has_touched")[-1].sum()),
        float((rows[-1].time_s - rows[0].time_s) / spent_s),
    )

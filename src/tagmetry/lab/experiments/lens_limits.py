"""How near, how far and how oblique may a 10 mm marker stand, when the lens is driven?

Each reading is of one image at the setting that promises the most there.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from tagmetry.lab.beside.lens_limits import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.lens_row import LensReading
from tagmetry.lab.rigs.lens_runs import our_finder
from tagmetry.lab.rigs.micro_marker import Stand, camera_before, turn_of
from tagmetry.lens import Measured, Whereabouts, ZoomLens, best_setting, measured
from tagmetry.pipeline.lens.twin import webcam_lens

DEPTHS_M = (0.02, 0.025, 0.03, 0.04, 0.05, 0.3, 1.05, 1.3, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0, 2.2)
TURNS_DEG = (60.0, 64.0, 68.0, 72.0, 76.0, 78.0, 80.0, 82.0)
OBLIQUE_M = (0.1, 0.3, 1.05)
_TURN_DEG = 30.0
_SIZE_M = 0.01
_REPEATS = 5
_LOOKED_FOR_M = (0.015, 3.0)


@dataclass(frozen=True)
class Case:
    """Where a marker stands.

    Attributes:
        sweep: What is varied: "depth" or "turn".
        depth_m: Its depth.
        turn_deg: Its turn.
    """

    sweep: str
    depth_m: float
    turn_deg: float


def cases(quick: bool) -> tuple[Case, ...]:
    """Return depths at one turn, and turns at three depths."""
    by_depth = [Case("depth", depth_m, _TURN_DEG) for depth_m in DEPTHS_M]
    by_turn = [Case("turn", depth_m, turn) for depth_m in OBLIQUE_M for turn in TURNS_DEG]
    return tuple((by_depth + by_turn)[:: 4 if quick else 1])


def measure(case: Case, seed: int) -> Sequence[LensReading]:
    """Return five readings."""
    return list(_readings(case, np.random.default_rng(seed)))


def _readings(case: Case, rng: np.random.Generator) -> Iterator[LensReading]:
    stand, lens = Stand(_SIZE_M, case.depth_m, case.turn_deg), _lens()
    for repeat in range(_REPEATS):
        T_camera_marker = stand.placed(rng)
        at = Whereabouts(np.asarray(T_camera_marker.translation), float(np.radians(case.turn_deg)))
        setting = best_setting(lens, stand.marker, at)
        camera = camera_before(stand, T_camera_marker, int(rng.integers(2**31)), setting)
        seen = our_finder().detect(camera.take().pixels, lens.camera_at(setting))
        found = measured(seen[0], lens, stand.marker, setting) if len(seen) == 1 else None
        yield _row(case, repeat, found)


@lru_cache(maxsize=1)
def _lens() -> ZoomLens:
    """Return the webcam's lens, for markers at any depth."""
    nearest_m, farthest_m = _LOOKED_FOR_M
    return replace(webcam_lens(), nearest_m=nearest_m, farthest_m=farthest_m)


def _row(case: Case, repeat: int, found: Measured | None) -> LensReading:
    nothing = float("nan")
    depth_m, sd_m, turn_deg = nothing, nothing, nothing
    if found is not None:
        depth_m, sd_m = found.depth_m, found.depth_sd_m
        turn_deg = turn_of(found.T_camera_marker)
    return LensReading(
        "tagmetry", case.sweep, "both", _SIZE_M, case.depth_m, case.turn_deg, repeat, -1,
        depth_m, sd_m, turn_deg, nothing, nothing, 0, 1, nothing, nothing,
    )  # fmt: skip


EXPERIMENT = Experiment(
    name="lens-limits",
    title="How near, how far and how oblique is a 10 mm marker measured?",
    source="seed 000, whose range of 0.05 to 1.05 m is to be exceeded",
    row=LensReading,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

"""Seed 000, figures 9 and 10: depth with zoom and focus fixed, and with the focus driven alone.

Figure 9 has three fixed settings and one calibration, made with autofocus on; figure 10 five fixed
zooms with the focus of equation 3 and the calibration of that focus. The marker is turned by 40
degrees. A condition counts when the marker is recognized five times in a row.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.lab.beside.seed000_fixed import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.lens_row import LensReading
from tagmetry.lab.rigs.lens_runs import OpenCvFinder, our_finder, paper_lens
from tagmetry.lab.rigs.micro_marker import Stand, camera_before, turn_of
from tagmetry.lens import LensSetting, Measured, SeedRule, measured
from tagmetry.pipeline.lens.twin import webcam_lens

FIXED = ((100.0, 100.0), (500.0, 50.0), (500.0, 0.0))
ZOOMS = (100.0, 200.0, 300.0, 400.0, 500.0)
_AUTOFOCUS = 40.0  # where autofocus stands for a board at arm's length
_TURN_DEG = 40.0
_REPEATS = 5


@dataclass(frozen=True)
class Case:
    """A condition, recognized by both.

    Attributes:
        figure: Of the paper.
        zoom_percent: Held.
        focus: Held; -1 where it follows the depth.
        depth_m: Of the marker.
    """

    figure: Literal["9", "10"]
    zoom_percent: float
    focus: float
    depth_m: float


def cases(quick: bool) -> tuple[Case, ...]:
    """Return figure 9's three settings and figure 10's five zooms over the depths."""
    depths_m = np.linspace(0.05, 1.05, 6 if quick else 11).round(3).tolist()
    held: list[tuple[Literal["9", "10"], float, float]] = [("9", *one) for one in FIXED]
    held += [("10", zoom, -1.0) for zoom in ZOOMS]
    return tuple(Case(*one, depth_m) for one in held for depth_m in depths_m)


def measure(case: Case, seed: int) -> Sequence[LensReading]:
    """Return five recognitions by each method."""
    return list(_readings(case, np.random.default_rng(seed)))


def _readings(case: Case, rng: np.random.Generator) -> Iterator[LensReading]:
    stand = Stand(0.01, case.depth_m, _TURN_DEG)
    focus = case.focus if case.focus >= 0 else _sharp(case.depth_m)
    setting = LensSetting(case.zoom_percent, focus)
    known = LensSetting(case.zoom_percent, focus if case.focus < 0 else _AUTOFOCUS)
    for repeat in range(_REPEATS):
        camera = camera_before(stand, stand.placed(rng), int(rng.integers(2**31)), setting)
        pixels = camera.take().pixels
        for method, finder, lens in (
            ("tagmetry", our_finder(), webcam_lens()),
            ("paper", OpenCvFinder(), paper_lens()),
        ):
            seen = finder.detect(pixels, lens.camera_at(known))
            found = measured(seen[0], lens, stand.marker, known) if len(seen) == 1 else None
            yield _row(case, method, repeat, found)


def _sharp(depth_m: float) -> float:
    lens = webcam_lens()
    return SeedRule().setting(depth_m, lens.zoom, lens.focus).focus


def _row(case: Case, method: str, repeat: int, found: Measured | None) -> LensReading:
    nothing = float("nan")
    control = f"W = {case.zoom_percent:g}" + (f", F = {case.focus:g}" if case.focus >= 0 else "")
    own = method == "tagmetry"
    return LensReading(
        method, case.figure, control, 0.01, case.depth_m, _TURN_DEG, repeat, -1,
        nothing if found is None else found.depth_m,
        found.depth_sd_m if found is not None and own else nothing,
        nothing if found is None else abs(turn_of(found.T_camera_marker)),
        nothing, nothing, 0, 1, nothing, nothing,
    )  # fmt: skip


EXPERIMENT = Experiment(
    name="seed000-fixed",
    title="How far is a 10 mm marker read with zoom and focus fixed, or only the focus driven?",
    source="seed 000, figures 9 and 10",
    row=LensReading,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

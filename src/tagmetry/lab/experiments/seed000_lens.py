"""Seed 000, figures 11 to 15: zoom, focus and calibration driven by the measured depth.

Figures 11 and 12: depth, at three turns over the range. Figure 13: the trace of each iteration at
three depths. Figures 14 and 15: turn, at three depths. And the 64 mm marker of its discussion.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.lab.beside.seed000_lens import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.lens_row import LensReading
from tagmetry.lab.rigs.lens_runs import By, OpenCvFinder, our_finder, our_run, paper_lens, paper_run
from tagmetry.lab.rigs.micro_marker import Stand, camera_before, turn_bound_deg, turn_of
from tagmetry.pipeline.lens import LensStep, LensTask
from tagmetry.pipeline.lens.twin import webcam_lens
from tagmetry.twin.camera import TwinCamera

REPEATS = 5
_PERIOD_S = 1 / 30


@dataclass(frozen=True)
class Case:
    """A condition, measured several times by one method.

    Attributes:
        method: "tagmetry" or "paper".
        figure: The paper's figure that it is of: 11 (and 12), 13, 14 (and 15), or 64 mm.
        size_m: Side of the marker.
        depth_m: Where it is.
        turn_deg: Its turn.
    """

    method: str
    figure: str
    size_m: float
    depth_m: float
    turn_deg: float


def cases(quick: bool) -> tuple[Case, ...]:
    """Return all conditions, each for both methods."""
    conditions = _some() if quick else _all()
    return tuple(Case(method, *one) for one in conditions for method in ("tagmetry", "paper"))


def _some() -> list[tuple[str, float, float, float]]:
    return [
        *(("11", 0.01, z, 30.0) for z in (0.05, 0.3, 1.05)),
        *(("13", 0.01, z, 40.0) for z in (1.0, 0.1)),
        *(("14", 0.01, 0.55, turn) for turn in (0.0, 40.0)),
        ("64 mm", 0.064, 0.4, 30.0),
    ]


def _all() -> list[tuple[str, float, float, float]]:
    depths_m = (0.05, 0.1, 0.25, 0.45, 0.65, 0.85, 1.05)
    turns_deg = (0.0, 5.0, 10.0, 20.0, 35.0, 50.0, 65.0)
    return [
        *(("11", 0.01, z, turn) for turn in (0.0, 30.0, 60.0) for z in depths_m),
        *(("13", 0.01, z, 40.0) for z in (1.0, 0.5, 0.1)),
        *(("14", 0.01, z, turn) for z in (0.05, 0.55, 1.05) for turn in turns_deg),
        *(("64 mm", 0.064, z, turn) for z in (0.1, 0.4, 0.7) for turn in (0.0, 30.0)),
    ]


def measure(case: Case, seed: int) -> Sequence[LensReading]:
    """Return five results; for figure 13 every image of the iteration too."""
    rng = np.random.default_rng(seed)
    stand = Stand(case.size_m, case.depth_m, case.turn_deg)
    return [row for repeat in range(REPEATS) for row in _run(case, stand, repeat, rng)]


def _run(case: Case, stand: Stand, repeat: int, rng: np.random.Generator) -> Iterator[LensReading]:
    T_camera_marker = stand.placed(rng)
    own = case.method == "tagmetry"
    bound_deg = turn_bound_deg(webcam_lens(), stand, T_camera_marker) if own else float("nan")
    camera = camera_before(stand, T_camera_marker, int(rng.integers(2**31)))
    steps = list(_steps(case, stand, camera))
    scanned = sum(step.phase == "scan" for step in steps)
    if case.figure == "13":
        traced = [step for step in steps if step.found is not None and step.is_settled]
        for number, step in enumerate(traced):
            yield _row(case, repeat, number, step, bound_deg, scanned, steps)
    yield _row(case, repeat, -1, steps[-1], bound_deg, scanned, steps)


def _steps(case: Case, stand: Stand, camera: TwinCamera) -> Iterator[LensStep]:
    if case.method == "tagmetry":
        return our_run(camera, LensTask(webcam_lens(), our_finder(), stand.marker))
    by: By = "posture" if case.figure in ("14", "64 mm") else "position"
    return paper_run(camera, LensTask(paper_lens(), OpenCvFinder(), stand.marker), by)


def _row(
    case: Case,
    repeat: int,
    number: int,
    step: LensStep,
    bound_deg: float,
    scanned: int,
    steps: Sequence[LensStep],
) -> LensReading:
    found, own, nothing = step.found, case.method == "tagmetry", float("nan")
    counts = found is not None and (number >= 0 or step.is_final)
    since = [one.image.sequence for one in steps]
    converged = next((one.image.sequence for one in steps if one.is_final), since[-1])
    passed_s = (min(step.image.sequence, converged) - since[0] + 1) * _PERIOD_S
    depth_m, turn_deg, sd_m, sd_deg = nothing, nothing, nothing, nothing
    if found is not None and counts:
        depth_m, turn_deg = found.depth_m, turn_of(found.T_camera_marker)
        sd_m = found.depth_sd_m if own else nothing
        sd_deg = float(np.degrees(np.sqrt(found.covariance[4, 4]))) if own else nothing
    return LensReading(
        case.method, case.figure, "both", case.size_m, case.depth_m, case.turn_deg, repeat, number,
        depth_m, sd_m, turn_deg, sd_deg, bound_deg, scanned, since[-1] - since[0] + 1, passed_s,
        float(np.mean([one.busy_s for one in steps])),
    )  # fmt: skip


EXPERIMENT = Experiment(
    name="seed000-lens",
    title="How exact is a 10 mm marker over a metre, with zoom, focus and calibration driven?",
    source="seed 000, figures 11 to 15, and the 64 mm marker of its discussion",
    row=LensReading,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

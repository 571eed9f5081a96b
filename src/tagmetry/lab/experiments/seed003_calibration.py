"""Seed 003, tables 3 to 6: is the paper's camera found again from 35 views of its board?

The paper's camera is the true one. It is calibrated from the same pictures by tagmetry and by the
steps of the paper's program, some times with other noise.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from tagmetry.lab.beside.seed003_calibration import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.camera_numbers import camera_numbers, projection_rms_px
from tagmetry.lab.rigs.webcam import CAMERA, PRINTED, board_poses, to_tutorial
from tagmetry.lab.rigs.webcam_calibration import Case, SolvedWebcam, cases, solved_webcam
from tagmetry.lab.rows import Quantity


def measure(case: Case, seed: int) -> Sequence[Quantity]:
    """Return the camera's numbers, the errors, and the printed views' poses, with the truth."""
    solved = solved_webcam(case.method, np.random.default_rng(seed))
    named = (*camera_numbers(solved.camera, CAMERA), *_errors(solved), *_poses(solved))
    return [Quantity(case.method, case.repeat, *one) for one in named]


def _errors(solved: SolvedWebcam) -> Iterator[tuple[str, float, float, float]]:
    named = (
        ("rms px", solved.rms_px),
        ("tutorial error px", solved.tutorial_error_px),
        ("projection rms px", projection_rms_px(solved.camera, CAMERA, places=(33, 25))),
        ("views", float(len(solved.views))),
    )
    for name, value in named:
        yield name, value, np.nan, np.nan


def _poses(solved: SolvedWebcam) -> Iterator[tuple[str, float, float, float]]:
    true_poses = board_poses()
    for view in set(PRINTED) & set(solved.views):
        found, true = solved.poses[solved.views.index(view)], to_tutorial(true_poses[view])
        for n in range(3):
            turn, true_turn = float(found.rotation_rad[n]), float(true.rotation_rad[n])
            yield f"view {view + 1} r{n + 1}", turn, true_turn, np.nan
            place, true_place = found.translation_squares[n], true.translation_squares[n]
            yield f"view {view + 1} t{n + 1}", float(place), float(true_place), np.nan


EXPERIMENT = Experiment(
    name="seed003-calibration",
    title="Is the camera of seed 003 found again from 35 views of its board?",
    source="seed 003, tables 3 to 6",
    row=Quantity,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

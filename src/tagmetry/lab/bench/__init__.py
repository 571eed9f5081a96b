"""All detectors on the same images, in one run: time, recall, accuracy, memory."""

from tagmetry.lab.bench.compare import Change, Comparison, compared
from tagmetry.lab.bench.real import own_pictures, real_sets
from tagmetry.lab.bench.results import Results, load_results, save_results
from tagmetry.lab.bench.rounds import PACES, Pace
from tagmetry.lab.bench.row import Row
from tagmetry.lab.bench.run import bench
from tagmetry.lab.bench.works import Step, Work, fitting, renderings, steps

__all__ = [
    "PACES",
    "Change",
    "Comparison",
    "Pace",
    "Results",
    "Row",
    "Step",
    "Work",
    "bench",
    "compared",
    "fitting",
    "load_results",
    "own_pictures",
    "real_sets",
    "renderings",
    "save_results",
    "steps",
]

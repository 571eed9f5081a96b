"""The experiments by their names; a new one is a file in `experiments` and a line here."""

from importlib import import_module
from typing import Any

from tagmetry.errors import InputError
from tagmetry.files.plain import shortened
from tagmetry.lab.experiment import Experiment

_HOMES = {
    "seed000-fixed": "seed000_fixed",
    "seed000-lens": "seed000_lens",
    "lens-limits": "lens_limits",
    "seed001-calibration": "seed001_calibration",
    "seed001-map": "seed001_map",
    "seed001-slider": "seed001_slider",
    "seed001-rate": "seed001_rate",
    "seed001-following": "seed001_following",
    "swarm": "swarm",
    "seed002-yaw": "seed002_yaw",
    "seed002-tilt": "seed002_tilt",
    "seed002-zones": "seed002_zones",
    "seed002-perpendicular": "seed002_perpendicular",
    "seed002-way": "seed002_way",
    "seed003-calibration": "seed003_calibration",
    "seed003-pose": "seed003_pose",
    "seed004-distance": "seed004_distance",
    "seed004-backlight": "seed004_backlight",
    "seed004-repeat": "seed004_repeat",
    "detector-limits": "detector_limits",
}


def experiment_names() -> tuple[str, ...]:
    """Return the names of all experiments."""
    return tuple(_HOMES)


def experiment(name: str) -> Experiment[Any, Any]:
    """Return an experiment by its name.

    Raises:
        InputError: There is none of this name; the text lists those there are.
    """
    if name not in _HOMES:
        raise InputError(
            f"there is no experiment {shortened(name)!r}; there are {', '.join(_HOMES)}"
        )
    module = import_module(f"tagmetry.lab.experiments.{_HOMES[name]}")
    found: Experiment[Any, Any] = module.EXPERIMENT
    return found

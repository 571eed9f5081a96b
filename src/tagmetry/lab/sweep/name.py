"""A case's name: the same for the same settings, version and source, and for nothing else.

Results of another setting, version or text of the experiment thus never mix with these.
"""

import hashlib
import json
from dataclasses import asdict
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from typing import Any

from tagmetry import __version__
from tagmetry.lab import rigs
from tagmetry.lab.experiment import Experiment, Record


def settings_json(case: Record) -> str:
    """Return a case's settings as JSON, the same text on every run."""
    return json.dumps(asdict(case), sort_keys=True)


def case_name(experiment: Experiment[Any, Any], case: Record, seed: int) -> str:
    """Return what a finished case is kept under."""
    source = _source(experiment.measure.__module__)
    return _digest(experiment.name, __version__, source, str(seed), settings_json(case))


def case_seed(experiment: Experiment[Any, Any], case: Record, seed: int) -> int:
    """Return the seed of a case's random numbers, which no version changes."""
    return int(_digest(experiment.name, str(seed), settings_json(case)), 16)


@lru_cache
def _source(module: str) -> str:
    """Return the text of an experiment and of all rigs, as a change of either changes results."""
    own = Path(import_module(module).__file__ or "")
    files = [own, *sorted(Path(rigs.__path__[0]).glob("*.py"))]
    return "".join(file.read_text("utf-8") for file in files)


def _digest(*parts: str) -> str:
    return hashlib.sha256("\x00".join(parts).encode()).hexdigest()[:16]

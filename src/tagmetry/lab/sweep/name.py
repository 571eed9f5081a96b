"""A case's name: the same for the same settings, version and source, and for nothing else.

Results of another setting, version or text of the experiment thus never mix with these.
"""

import hashlib
import json
import re
from dataclasses import asdict
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from typing import Any

from tagmetry import __version__
from tagmetry.lab.experiment import Experiment, Record

_RIG = re.compile(r"^from (tagmetry\.lab\.rigs\.\w+) import", re.MULTILINE)


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
    """Return the text of a module and of all rigs that it needs: their changes change results."""
    text = Path(import_module(module).__file__ or "").read_text("utf-8")
    return text + "".join(map(_source, sorted(set(_RIG.findall(text)))))


def _digest(*parts: str) -> str:
    return hashlib.sha256("\x00".join(parts).encode()).hexdigest()[:16]

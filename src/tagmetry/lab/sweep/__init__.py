"""Cases measured by many processes, each kept as soon as it is finished."""

from tagmetry.lab.sweep.folder import Sweep
from tagmetry.lab.sweep.measuring import run
from tagmetry.lab.sweep.workers import Workers, cluster_workers, local_workers

__all__ = ["Sweep", "Workers", "cluster_workers", "local_workers", "run"]

"""Who measures: processes of this machine, or a Dask cluster; both are executors to the sweep.

Every worker has one thread, as cases run side by side.
"""

import os
import signal
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.lab.environment import environment

PATIENCE_S = 10  # with a scheduler that does not answer

_LIBRARIES = ("OMP", "OPENBLAS", "MKL", "NUMBA")
_ONE_THREAD = {f"{library}_NUM_THREADS": "1" for library in _LIBRARIES}


@dataclass(frozen=True)
class Workers:
    """An executor.

    Attributes:
        executor: Runs cases.
        count: How many at the same time.
    """

    executor: Executor
    count: int


@contextmanager
def local_workers(jobs: int | None = None) -> Iterator[Workers]:
    """Give processes of this machine, one for each processor unless told otherwise."""
    count = jobs or os.cpu_count() or 1
    with (
        environment(_ONE_THREAD),
        ProcessPoolExecutor(count, get_context("spawn"), _prepare) as executor,
    ):
        yield Workers(executor, count)


@contextmanager
def cluster_workers(address: str) -> Iterator[Workers]:
    """Give the threads of a Dask cluster's workers.

    Args:
        address: Of its scheduler, like tcp://10.0.0.5:8786.

    Raises:
        MissingExtraError: Dask is not installed.
        InputError: There is no such cluster, or it has no workers.
    """
    try:
        from distributed import Client
    except ImportError as error:
        raise MissingExtraError("sweeps on a Dask cluster", "cluster") from error
    try:
        client = Client(address, timeout=PATIENCE_S)
    except (OSError, ValueError) as error:
        raise InputError(
            f"cannot reach a Dask cluster at {address}; give the address that `dask scheduler` "
            f"prints, like tcp://10.0.0.5:8786"
        ) from error
    with client:
        count = sum(client.nthreads().values())
        if count == 0:
            raise InputError(f"the Dask cluster at {address} has no workers; start `dask worker`")
        yield Workers(client.get_executor(), count)


def _prepare() -> None:
    """Make a process fit for work: Ctrl-C is the parent's to answer, OpenCV has one thread."""
    import cv2

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    cv2.setNumThreads(1)

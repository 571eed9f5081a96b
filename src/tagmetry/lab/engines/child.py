"""An engine in a process of its own: it may crash or hang, and nothing else does.

Some peers crash at exit or on tiny images. The time is measured inside the child; the images go to
it beforehand, through a pipe, and stay there.
"""

import os
import signal
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

from tagmetry.closing import Closing
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.engines.engine import EngineKind
from tagmetry.lab.engines.worker import Answer, serve
from tagmetry.lab.environment import environment

_THREAD_VARIABLES = (
    "NUMBA_NUM_THREADS",
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "RAYON_NUM_THREADS",
)
_LONGEST_COMPLAINT = 120


@dataclass(frozen=True)
class Failure:
    """An engine gave no answer.

    Attributes:
        reason: Why, in words: crashed, or did not answer in time.
    """

    reason: str


@dataclass(frozen=True)
class Patience:
    """How long an engine may be silent before it is ended.

    Attributes:
        image_s: On one image.
        first_s: On being made, and on its first image: kernels may be compiled there.
    """

    image_s: float
    first_s: float = 300.0


class Child(Closing):
    """One engine in its own process, until it is closed.

    After a failure it is dead, and says so again whenever it is asked.

    Args:
        kind: The engine.
        family: What it looks for.
        threads: How many it may use.
        patience: How long it may take.
    """

    def __init__(self, kind: EngineKind, family: str, threads: int, patience: Patience) -> None:
        self.kind = kind
        self._patience = patience
        self._failure: Failure | None = None
        handle, name = tempfile.mkstemp(prefix="tagmetry-engine-")
        os.close(handle)
        self._complaints = Path(name)
        context = get_context("spawn")
        self._pipe, far_end = context.Pipe()
        self._process = context.Process(
            target=serve, args=(far_end, kind, family, threads, name), daemon=True
        )
        with _threads_limited(threads), _interrupts_kept_away():
            self._process.start()
        far_end.close()
        self._is_made = self._is_warm = False

    @property
    def is_dead(self) -> bool:
        """It failed, and answers no more."""
        return self._failure is not None

    def show(self, images: Sequence[GreyPixels]) -> Failure | None:
        """Give it the images that it will be asked about; return why it could not take them."""
        if not self._is_made:
            self._receive(self._patience.first_s)
            self._is_made = True
        self._order(tuple(images), self._patience.image_s)
        return self._failure

    def look(self, number: int) -> Answer | Failure:
        """Return what it finds in one of its images."""
        patience_s = self._patience.image_s if self._is_warm else self._patience.first_s
        self._is_warm = True
        answer = self._order(number, patience_s)
        return answer if isinstance(answer, Answer) else self._failed()

    def close(self) -> None:
        """End the process, whatever it is doing."""
        self._process.kill()
        self._process.join()
        self._process.close()
        self._pipe.close()
        self._complaints.unlink(missing_ok=True)

    def _order(self, order: tuple[GreyPixels, ...] | int, patience_s: float) -> object:
        if self._failure is not None:
            return None
        try:
            self._pipe.send(order)
        except OSError:
            self._failure = Failure(self._death())
            return None
        return self._receive(patience_s)

    def _receive(self, patience_s: float) -> object:
        """Return what it says; None when it is dead, or killed for its silence."""
        try:
            if self._pipe.poll(patience_s):
                return self._pipe.recv()
        except (EOFError, OSError):
            self._failure = Failure(self._death())
            return None
        self._process.kill()
        self._failure = Failure(f"no answer in {patience_s:g} s")
        return None

    def _failed(self) -> Failure:
        return self._failure or Failure("answered something else")

    def _death(self) -> str:
        """Return how it ended, and the last line that it wrote."""
        self._process.join()
        code = self._process.exitcode or 0
        how = signal.Signals(-code).name if code < 0 else f"exit code {code}"
        lines = self._complaints.read_text("utf-8", errors="replace").strip().splitlines()
        last = f": {lines[-1][:_LONGEST_COMPLAINT]}" if lines else ""
        return f"crashed ({how}){last}"


def _threads_limited(threads: int) -> AbstractContextManager[None]:
    """Let processes that start meanwhile use so many threads; libraries read it when imported."""
    return environment(dict.fromkeys(_THREAD_VARIABLES, str(threads)))


@contextmanager
def _interrupts_kept_away() -> Iterator[None]:
    """Let processes that start meanwhile never see Ctrl-C, which is ours to answer."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows; the child ignores it once it runs
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)

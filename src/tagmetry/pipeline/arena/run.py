"""The arena's loop: the newest image, measured, to every taker."""

from collections.abc import Generator, Iterable, Sequence

from tagmetry.camera import Image
from tagmetry.pipeline.arena.latency import Latency
from tagmetry.pipeline.arena.measurement import ArenaMeasurement, ArenaResult
from tagmetry.pipeline.arena.taker import Taker
from tagmetry.pipeline.steady import steady


def run_arena(
    images: Iterable[Image],
    measurement: ArenaMeasurement,
    takers: Sequence[Taker] = (),
    latency: Latency | None = None,
) -> Generator[ArenaResult]:
    """Give the result of every image, after all takers have it.

    The first takers are served first, and in this thread: those that talk to robots. Others belong
    behind `Posted`. All are closed at the end, however it comes.

    Args:
        images: A source; a live one gives the newest image only.
        measurement: What is done with them.
        takers: Who takes the results.
        latency: Told how long each image took, until all takers had it.
    """
    try:
        with steady():
            for image in images:
                result = measurement.measure(image)
                for taker in takers:
                    taker.take(result)
                if latency is not None:
                    latency.add(measurement.clock() - result.taken_s)
                yield result
    finally:
        _close(list(takers))


def _close(takers: list[Taker]) -> None:
    """Close all, even where one fails."""
    if not takers:
        return
    try:
        takers[0].close()
    finally:
        _close(takers[1:])

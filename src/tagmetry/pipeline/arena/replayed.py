"""A recorded run once more through the same pipeline, and whether it gives the same."""

from collections.abc import Generator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tagmetry.detect import Detection
from tagmetry.pipeline.arena.measurement import ArenaMeasurement, ArenaResult
from tagmetry.record import parse_line
from tagmetry.record.mcap import DETECTIONS, Replay, read_entries

_Key = tuple[str, int]


@dataclass(frozen=True)
class Replayed:
    """One image of a recording, measured again.

    Attributes:
        result: What the image tells now.
        missing_count: Markers that were found then and not now, or now and not then.
        largest_px: How far a corner of the others lies from where it was then; 0 where all is the
            same, NaN where the recording holds no markers of this image.
    """

    result: ArenaResult
    missing_count: int
    largest_px: float


def replay_arena(path: str | Path, measurement: ArenaMeasurement) -> Generator[Replayed]:
    """Give every image of a recording, measured again and compared.

    Images that were recorded without loss give the same numbers, bit by bit; JPEG moves corners by
    about a hundredth of a pixel.

    Args:
        path: The recording.
        measurement: The arena's, fresh: what the first image tells depends on nothing before.

    Raises:
        InputError: The recording cannot be read, or its images do not fit the camera.
        MissingExtraError: The part `arena` is not installed.
    """
    recorded = dict(_recorded_detections(path))
    with Replay(path, camera=measurement.camera) as source:
        for image in source:
            result = measurement.measure(image)
            yield _compared(result, recorded.get((image.source, image.sequence)))


def _recorded_detections(path: str | Path) -> Generator[tuple[_Key, tuple[Detection, ...]]]:
    for entry in read_entries(path, DETECTIONS, on_damage=lambda _: None):
        result = parse_line(entry.content)
        yield (result.source, result.sequence), tuple(m.detection for m in result.markers)


def _compared(result: ArenaResult, recorded: tuple[Detection, ...] | None) -> Replayed:
    if recorded is None:
        return Replayed(result, 0, float("nan"))
    now, then = _by_name(result.detections), _by_name(recorded)
    moved_px = [
        float(np.abs(now[name].corners_px - then[name].corners_px).max())
        for name in now.keys() & then.keys()
    ]
    return Replayed(result, len(now.keys() ^ then.keys()), max(moved_px, default=0.0))


def _by_name(detections: tuple[Detection, ...]) -> dict[tuple[str, int], Detection]:
    return {(one.family, one.id): one for one in detections}

"""One engine on one case: what it took, what it found, and how well."""

from dataclasses import dataclass
from typing import Literal

Standard = Literal["truth", "agreement"]
Clock = Literal["processor", "wall"]


@dataclass(frozen=True)
class Row:
    """One engine on one case; None where there is nothing to measure.

    Attributes:
        case: Name of the case.
        engine: Name of the engine.
        threads: How many it was allowed.
        clock: What the times are of; see `times`.
        megapixels: Of an image.
        rounds: How many images were timed.
        p50_ms: Half of the images took less.
        p99_ms: 99 of 100 images took less.
        ratio: Its p50 by that of tagmetry on the whole image.
        memory_mib: What the process held at most beyond libraries and images.
        judged_by: Exact truth, or what engines of two authors agree upon.
        expected: How many markers there are in all images that were looked at.
        found: How many of them it found.
        false_positives: What else it found; by agreement: what nobody else did.
        corner_rms_px: Root mean square error of a corner's coordinate.
        bound_px: The least that the noise allows, by Cramer and Rao.
        distance2: Mean squared distance of a marker's corners from the truth, by the covariance
            that the engine states; 8 where that is right.
        position_error_percent: Median error of the marker's place, of its distance.
        angle_error_deg: Median error of the rotation.
        flips: How often the wrong one of both poses was taken for the likelier.
        failure: Why there is nothing more: it crashed, or did not answer in time.
    """

    case: str
    engine: str
    threads: int
    clock: Clock
    megapixels: float
    rounds: int = 0
    p50_ms: float | None = None
    p99_ms: float | None = None
    ratio: float | None = None
    memory_mib: float | None = None
    judged_by: Standard = "truth"
    expected: int = 0
    found: int = 0
    false_positives: int = 0
    corner_rms_px: float | None = None
    bound_px: float | None = None
    distance2: float | None = None
    position_error_percent: float | None = None
    angle_error_deg: float | None = None
    flips: int | None = None
    failure: str | None = None

    @property
    def recall(self) -> float | None:
        """Share of the markers that it found."""
        return self.found / self.expected if self.expected else None

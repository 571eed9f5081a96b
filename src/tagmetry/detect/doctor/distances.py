"""Are the measured distances plausible? A wrong unit of size shows in them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from tagmetry.detect.doctor.advice import Advice

_NEAR_M, _FAR_M = 0.02, 50.0
_AMBIGUOUS = 0.05


@dataclass(frozen=True)
class MeasuredMarker:
    """What a pose says that can be wrong.

    Attributes:
        name: Family and id.
        size_m: Side of its black square, as given.
        distance_m: From the camera to its centre.
        ambiguity: Probability that the other of a flat marker's two poses is the true one.
    """

    name: str
    size_m: float
    distance_m: float
    ambiguity: float


def check_distances(markers: Sequence[MeasuredMarker]) -> tuple[Advice, ...]:
    """Judge distances that cannot be, and poses that may be flipped."""
    far = [one for one in markers if one.distance_m > _FAR_M]
    near = [one for one in markers if one.distance_m < _NEAR_M]
    unsure = [one for one in markers if one.ambiguity > _AMBIGUOUS]
    return (*_implausible(far, 0.001), *_implausible(near, 1000.0), *_ambiguous(unsure))


def _implausible(markers: Sequence[MeasuredMarker], factor: float) -> Iterator[Advice]:
    if not markers:
        return
    one = markers[0]
    rest = f", and {len(markers) - 1} more" if len(markers) > 1 else ""
    yield Advice(
        "problem",
        "an implausible distance",
        f"{one.name}, given as {one.size_m:g} m, would be {one.distance_m:.3g} m away{rest}",
        f"sizes are metres: perhaps {one.size_m * factor:g} m was meant, giving "
        f"{one.distance_m * factor:.3g} m; write a unit, such as 120mm",
    )


def _ambiguous(markers: Sequence[MeasuredMarker]) -> Iterator[Advice]:
    if not markers:
        return
    worst = max(markers, key=lambda one: one.ambiguity)
    yield Advice(
        "hint",
        "a pose that may be flipped",
        f"{len(markers)} of the markers fit two tilts almost equally well; worst is {worst.name}: "
        f"the other tilt has a probability of {worst.ambiguity:.0%}",
        "come nearer, look at it from aside, or measure several markers together",
    )

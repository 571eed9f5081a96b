"""The row of results of experiments with driven zoom and focus (seed 000)."""

from dataclasses import dataclass


@dataclass(frozen=True)
class LensReading:
    """A marker's depth and turn by a camera whose zoom and focus are set (seed 000).

    Attributes:
        method: "tagmetry", or "paper": its steps on the twin.
        figure: Which of the paper's figures the condition belongs to, like "11".
        control: What is driven, in words: "both", or the fixed values.
        size_m: Side of the marker.
        depth_m: Where it truly is.
        turn_deg: How far it is truly turned about its upright axis.
        repeat: Which of the repeats.
        image: Number of the image from the first one on, for traces; -1 for the result.
        measured_m: Depth; NaN where the marker was not found.
        sd_m: Standard deviation as the method states it; NaN where it states none.
        measured_deg: Turn.
        sd_deg: Its standard deviation as stated.
        bound_deg: Cramer-Rao bound of the turn's standard deviation at this pose; NaN elsewhere.
        scanned: Images until it was found.
        images: Images until the result, those of a mean too.
        simulated_s: Time until it converged, at 30 images per second.
        busy_s: Computing time per image.
    """

    method: str
    figure: str
    control: str
    size_m: float
    depth_m: float
    turn_deg: float
    repeat: int
    image: int
    measured_m: float
    sd_m: float
    measured_deg: float
    sd_deg: float
    bound_deg: float
    scanned: int
    images: int
    simulated_s: float
    busy_s: float

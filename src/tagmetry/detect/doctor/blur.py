"""Is the image as a whole sharp enough?"""

import numpy as np

from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.edges import sharpest_edges_px
from tagmetry.detect.doctor.evidence import Evidence, detections_of
from tagmetry.detect.doctor.unread import blur_px, blur_words

_SOFT_PX = 2.0
_VERY_SOFT_PX = 3.0
_MOVED = 4.0  # ratio of the blurs of two directions


def check_blur(evidence: Evidence) -> tuple[Advice, ...]:
    """Measure the edges of the markers found, or else the sharpest edges of the image."""
    if evidence.found:
        return _of_markers(evidence)
    return () if evidence.others else _of_image(evidence)


def _of_markers(evidence: Evidence) -> tuple[Advice, ...]:
    along_px, across_px = blur_px(evidence, detections_of(evidence.found))
    if not along_px > _SOFT_PX:
        return ()
    kind, remedy = blur_words(along_px, across_px)
    return (
        Advice(
            "hint",
            "soft edges",
            f"the markers' edges are blurred by {kind}; corners suffer",
            remedy,
        ),
    )


def _of_image(evidence: Evidence) -> tuple[Advice, ...]:
    blurs_px = sharpest_edges_px(evidence.grey)
    if np.isnan(blurs_px).all():
        return ()
    least_px, most_px = float(np.nanmin(blurs_px)), float(np.nanmax(blurs_px))
    if least_px >= _VERY_SOFT_PX:
        return (
            _blurred(f"even the sharpest edges are blurred by about {least_px:.0f} px or more"),
        )
    if most_px >= max(_VERY_SOFT_PX, _MOVED * least_px):
        return (
            _blurred(
                f"edges of one direction are blurred by about {most_px:.0f} px, of another by "
                f"{least_px:.1f} px: something may have moved"
            ),
        )
    return ()


def _blurred(explanation: str) -> Advice:
    remedy = "focus by hand on the marker; a shorter exposure if anything moves"
    return Advice("hint", "blurred", explanation, remedy)

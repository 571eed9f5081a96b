"""Is the image as a whole sharp enough?"""

from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.edges import sharpest_edges_px
from tagmetry.detect.doctor.evidence import Evidence, detections_of
from tagmetry.detect.doctor.unread import blur_px, blur_words

_SOFT_PX = 2.0
_VERY_SOFT_PX = 3.0


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
            f"the markers' edges are blurred by {kind}; corners and distant markers suffer",
            remedy,
        ),
    )


def _of_image(evidence: Evidence) -> tuple[Advice, ...]:
    sharpest_px = sharpest_edges_px(evidence.grey)
    if sharpest_px is None or sharpest_px < _VERY_SOFT_PX:
        return ()
    return (
        Advice(
            "hint",
            "blurred",
            f"even the sharpest edges of the picture are blurred by about {sharpest_px:.0f} px or more",
            "focus by hand on the marker; a shorter exposure if anything moves",
        ),
    )

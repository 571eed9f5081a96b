"""Too dark, too bright, too flat: grey values in numbers, and whether stretching them helps."""

import numpy as np

from tagmetry.detect.detector import Detector
from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.evidence import Evidence
from tagmetry.detect.doctor.groups import Group, grouped
from tagmetry.geometry.arrays import GreyPixels

_DARK, _BRIGHT = 60.0, 190.0  # nearly all grey values below, above
_PERCENTILES = (0.01, 1, 99, 99.99)
_FLAT = 40.0  # grey values between the darkest and the brightest percent
_BURNT_SHARE = 0.3
_BURNT = 254


def check_contrast(evidence: Evidence) -> tuple[Advice, ...]:
    """Judge the exposure of an image in which nothing is found."""
    if evidence.found or evidence.others:
        return ()
    lowest, low, high, highest = (float(v) for v in np.percentile(evidence.grey, _PERCENTILES))
    words = _words(low, high)
    if words is None:
        return _burnt(evidence.grey)
    title, remedy = words
    numbers = f"98 % of the grey values lie from {low:.0f} to {high:.0f} (of 0 to 255)"
    seen = [group for group in _in_stretched(evidence) if group.is_sure(tries=2)]
    if seen:
        shown = "; ".join(str(group) for group in seen)
        return (
            Advice("problem", title, f"{numbers}; stretched to full contrast: {shown}", remedy),
        )
    if _words(lowest, highest) is None:  # a small marker may stand in a plain image
        return ()
    return (Advice("hint", title, f"{numbers}; stretching them shows no marker either", remedy),)


def stretched(grey: GreyPixels) -> GreyPixels:
    """Return an image with its darkest value at 0 and its brightest at 255, lightly smoothed."""
    import cv2

    smooth = cv2.GaussianBlur(grey.astype(np.float64), (3, 3), 0.8)
    low, high = np.percentile(smooth, [0.1, 99.9])
    scaled = (smooth - low) * (255 / max(high - low, 1e-9))
    return np.asarray(np.clip(np.rint(scaled), 0, 255), dtype=np.uint8)


def _words(low: float, high: float) -> tuple[str, str] | None:
    """Return title and remedy, None for an image with enough contrast."""
    if high < _DARK:
        return "too dark", "more light, a longer exposure, or more gain"
    if low > _BRIGHT:
        return "too bright", "a shorter exposure or less gain"
    if high - low < _FLAT:
        return "too little contrast", "even, direct light; no fog, glass or veil before the lens"
    return None


def _in_stretched(evidence: Evidence) -> tuple[Group, ...]:
    found = Detector(evidence.families).detect(stretched(evidence.grey))
    return grouped(found, evidence.families)


def _burnt(grey: GreyPixels) -> tuple[Advice, ...]:
    share = float((grey >= _BURNT).mean())
    if share < _BURNT_SHARE:
        return ()
    return (
        Advice(
            "hint",
            "burnt out",
            f"{share:.0%} of the pixels are fully white: light may spread over thin black borders",
            "if this is a photograph: a shorter exposure or less gain",
        ),
    )

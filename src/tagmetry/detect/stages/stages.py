"""All that the detector sees of one image, step by step."""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.detection import Detection, Findings
from tagmetry.detect.detector import Detector, default_min_side_px
from tagmetry.detect.expected import expected_picture
from tagmetry.detect.grey import grey_8bit
from tagmetry.detect.segment import Squares, squares
from tagmetry.detect.stages.classic import Classic, Straightened, classic, straightened
from tagmetry.detect.stages.parted import Parted, parted
from tagmetry.detect.stages.redrawn import Redrawn, redrawn
from tagmetry.detect.stages.sampled import Sampled, sampled
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels, GreyPixels
from tagmetry.markers import MarkerFamily


@dataclass(frozen=True, eq=False)
class OneMarker:
    """The steps of one marker.

    Attributes:
        detection: What came out.
        family: Its family.
        first_px: Its corners before they were refined, clockwise from its own top left, (4, 2).
        sampled: How its cells read at these.
        redrawn: Its picture drawn from the refined corners.
        straightened: The same by the textbook's way.
    """

    detection: Detection
    family: MarkerFamily
    first_px: Array
    sampled: Sampled
    redrawn: Redrawn
    straightened: Straightened


@dataclass(frozen=True, eq=False)
class Stages:
    """The steps of one image.

    Attributes:
        image: As it came.
        grey: What is worked on, shape (h, w).
        parted: Dark and bright, at half scale.
        squares: Outlines with four sides, of all looks.
        findings: Markers, and squares that were turned down.
        shown: The largest marker's steps; None where there is no marker.
        classic: The textbook's steps.
    """

    image: AnyPixels
    grey: GreyPixels
    parted: Parted
    squares: Squares
    findings: Findings
    shown: OneMarker | None
    classic: Classic


def look_through(image: AnyPixels, detector: Detector, camera: Camera | None = None) -> Stages:
    """Return what a detector sees of an image; the image is as for `Detector.detect`."""
    grey = grey_8bit(image)
    least_px = detector.min_side_px or default_min_side_px(grey.size)
    found = squares(grey, least_px, bright=True)
    findings = detector.explain(image, camera)
    return Stages(
        image,
        grey,
        parted(grey, least_px),
        found,
        findings,
        _largest(grey, found, findings, detector, camera),
        classic(grey),
    )


def _largest(
    grey: GreyPixels,
    found: Squares,
    findings: Findings,
    detector: Detector,
    camera: Camera | None,
) -> OneMarker | None:
    if not findings.detections:
        return None
    detection = max(findings.detections, key=lambda one: one.side_px)
    own = next(one for one in detector.families if one.name == detection.family)
    first_px = _before(detection, found)
    picture = expected_picture(grey, detection.corners_px, own, detection.id)
    return OneMarker(
        detection,
        own,
        first_px,
        sampled(grey, first_px, own.layout),
        redrawn(grey, detection.corners_px, picture, camera),
        straightened(grey, first_px, own.layout),
    )


def _before(detection: Detection, found: Squares) -> Array:
    """Return the square that became a detection, beginning at the same corner, shape (4, 2)."""
    turned = np.stack([np.roll(found.corners_px, -k, axis=1) for k in range(4)], axis=1)
    apart = np.linalg.norm(turned - detection.corners_px, axis=3).max(axis=2)
    square, quarter = np.unravel_index(apart.argmin(), apart.shape)
    return np.asarray(turned[square, quarter])

"""The doctor's round: every check, proven causes before likely ones."""

from collections.abc import Sequence

from tagmetry.camera import Camera
from tagmetry.detect.detection import Detection
from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.blur import check_blur
from tagmetry.detect.doctor.calibration import check_calibration
from tagmetry.detect.doctor.contrast import check_contrast
from tagmetry.detect.doctor.duplicates import check_duplicates
from tagmetry.detect.doctor.edge import check_edge
from tagmetry.detect.doctor.evidence import Evidence, detections_of
from tagmetry.detect.doctor.found import check_found
from tagmetry.detect.doctor.mirrored import check_mirrored
from tagmetry.detect.doctor.nothing import nothing_there
from tagmetry.detect.doctor.perhaps import check_perhaps
from tagmetry.detect.doctor.present import check_present
from tagmetry.detect.doctor.quiet_zone import check_quiet_zone
from tagmetry.detect.doctor.unread import check_unread
from tagmetry.detect.grey import grey_8bit
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.markers import MarkerFamily

_SEVERITIES = ("problem", "hint", "ok")
_OF_FOUND = (check_found, check_duplicates, check_edge)
_PROVING = (check_present, check_mirrored, check_quiet_zone)
_LIKELY = (check_contrast, check_unread, check_blur, check_perhaps)


def diagnose(
    image: AnyPixels, families: Sequence[MarkerFamily] = (), camera: Camera | None = None
) -> tuple[Advice, ...]:
    """Say what is found in an image, and why nothing or something else is.

    Args:
        image: Grey or BGR, uint8 or uint16, shape (h, w) or (h, w, 3).
        families: The families asked for; none stands for whatever is there.
        camera: Intrinsics that are to be used with the image.

    Returns:
        Problems first.

    Raises:
        InputError: The array is no image in which a marker could be.
    """
    evidence = Evidence(grey_8bit(image), tuple(families))
    height_px, width_px = evidence.grey.shape
    calibration = check_calibration(camera, width_px, height_px) if camera else ()
    return problems_first((*_of_image(evidence), *calibration))


def found_markers(image: AnyPixels, families: Sequence[MarkerFamily] = ()) -> tuple[Detection, ...]:
    """Return the markers that `diagnose` calls found in an image."""
    return detections_of(Evidence(grey_8bit(image), tuple(families)).found)


def problems_first(advice: Sequence[Advice]) -> tuple[Advice, ...]:
    """Return problems, then hints, then what is right, else in the order given."""
    return tuple(sorted(advice, key=lambda one: _SEVERITIES.index(one.severity)))


def _of_image(evidence: Evidence) -> tuple[Advice, ...]:
    """A cause that was proven by taking it away leaves no room for guesses."""
    found = [advice for check in _OF_FOUND for advice in check(evidence)]
    proven = [advice for check in _PROVING for advice in check(evidence)]
    if any(advice.severity == "problem" for advice in proven):
        return (*found, *proven)
    likely = [advice for check in _LIKELY for advice in check(evidence)]
    said = (*found, *proven, *likely)
    is_explained = evidence.found or any(advice.severity == "problem" for advice in likely)
    return said if is_explained else (*said, nothing_there(evidence))

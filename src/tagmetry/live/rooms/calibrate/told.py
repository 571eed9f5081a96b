"""From a session and a calibration to what the page is told."""

import cv2
import numpy as np

from tagmetry.calibrate.guidance import Session
from tagmetry.camera import Image
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.live.rooms.calibrate.messages import (
    CalibrationNumber,
    CalibrationPicture,
    CalibrationResult,
)
from tagmetry.pipeline.calibration import CalibrationRun, advice_line
from tagmetry.record.calibration_report.tables import parameter_rows

_WIDEST_PX = 960
_JPEG_QUALITY = 75


def told_picture(image: Image, session: Session) -> CalibrationPicture:
    """Return an image as it is sent, with the board found in it and the outline wanted next."""
    small = _small(image.pixels)
    height_px, width_px = small.shape[:2]
    scale = width_px / image.width_px
    seen = session.last[0].corners_px if session.last is not None else np.zeros((0, 2))
    _, jpeg = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY])
    return CalibrationPicture(
        width_px,
        height_px,
        _scaled(seen, scale),
        _scaled(session.next.outline_px, scale),
        jpeg.tobytes(),
    )


def told_coverage(session: Session) -> tuple[tuple[int, ...], ...]:
    """Return how many corners were seen in each cell of the image."""
    return tuple(tuple(row) for row in session.coverage.tolist())


def told_result(run: CalibrationRun, *, has_report: bool) -> CalibrationResult:
    """Return a camera and what it is worth."""
    verdict = run.assessment.verdict
    left_out = verdict.evidence.left_out
    return CalibrationResult(
        run.calibration.camera.lens.kind,
        tuple(
            CalibrationNumber(name, float(value), float(sd))
            for name, value, sd, _ in parameter_rows(run.calibration)
        ),
        run.calibration.rms_px,
        float("nan") if left_out is None else left_out.rms_px,
        verdict.evidence.uncertainty.worst_px,
        verdict.grade,
        verdict.words,
        verdict.fit_for,
        (*verdict.warnings, *(advice_line(one) for one in run.advice)),
        has_report,
    )


def _small(pixels: AnyPixels) -> AnyPixels:
    """Return a picture of 8 bits that is no wider than the page needs."""
    scale = min(1.0, _WIDEST_PX / pixels.shape[1])
    small = cv2.resize(pixels, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    return (small // 257).astype(np.uint8) if small.dtype == np.uint16 else small


def _scaled(pixels: Array, scale: float) -> tuple[tuple[float, float], ...]:
    """Return pixels (n, 2) in the picture that is sent."""
    return tuple((x, y) for x, y in (scale * (pixels + 0.5) - 0.5).tolist())

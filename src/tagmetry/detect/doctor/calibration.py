"""Can this calibration belong to this image?"""

import math
from collections.abc import Iterator

import numpy as np

from tagmetry.camera import Camera, distortion_reach
from tagmetry.detect.doctor.advice import Advice

_NARROW_DEG, _WIDE_DEG = 5.0, 170.0
_SAME_RATIO = 0.01


def check_calibration(camera: Camera, width_px: int, height_px: int) -> tuple[Advice, ...]:
    """Compare intrinsics with the size of an image, and with themselves.

    Args:
        camera: The intrinsics.
        width_px: Columns of the image.
        height_px: Rows.
    """
    checks = (
        *_resolution(camera, width_px, height_px),
        *_center(camera),
        *_view(camera),
        *_fold(camera),
    )
    return checks or (_fits(camera),)


def _fits(camera: Camera) -> Advice:
    angle_deg = view_angle_deg(camera)
    text = f"{camera.width_px}x{camera.height_px}, {angle_deg:.0f}° wide"
    return Advice("ok", "the calibration fits the picture", text)


def view_angle_deg(camera: Camera) -> float:
    """Return the angle of view that width and focal length give, lens distortion left out."""
    half_px = camera.width_px / 2
    if camera.lens.kind == "fisheye":
        return math.degrees(2 * half_px / camera.focal_px[0])
    return math.degrees(2 * math.atan(half_px / camera.focal_px[0]))


def _resolution(camera: Camera, width_px: int, height_px: int) -> Iterator[Advice]:
    if camera.size_px == (width_px, height_px):
        return
    yield Advice(
        "problem",
        "a calibration of another resolution",
        f"the intrinsics belong to {camera.width_px}x{camera.height_px}, the picture is "
        f"{width_px}x{height_px}",
        _conversion(camera, width_px, height_px),
    )


def _conversion(camera: Camera, width_px: int, height_px: int) -> str:
    across, down = width_px / camera.width_px, height_px / camera.height_px
    if abs(across / down - 1) < _SAME_RATIO:
        return (
            f"if the camera scales its full image: a factor of {across:.4g}, tagmetry camera "
            f"convert CAMERA OUT --scale-to {width_px}x{height_px}; if it crops: calibrate at "
            "this size"
        )
    if abs(width_px / camera.height_px / (height_px / camera.width_px) - 1) < _SAME_RATIO:
        return "the sides are swapped: take the picture unturned, or turn the intrinsics too"
    return (
        f"the factors differ ({across:.4g} across, {down:.4g} down), so the camera crops: "
        "calibrate at this size"
    )


def _center(camera: Camera) -> Iterator[Advice]:
    if not camera.contains(np.array(camera.center_px)):
        cx, cy = camera.center_px
        yield Advice(
            "problem",
            "the principal point is outside the image",
            f"({cx:.0f}, {cy:.0f}) in an image of {camera.width_px}x{camera.height_px}",
            "calibrate again, unless the image was cut out of a larger one on purpose",
        )


def _view(camera: Camera) -> Iterator[Advice]:
    angle_deg = view_angle_deg(camera)
    if camera.lens.kind == "fisheye" or _NARROW_DEG <= angle_deg <= _WIDE_DEG:
        return
    yield Advice(
        "problem",
        "an implausible focal length",
        f"{camera.focal_px[0]:.4g} px for a width of {camera.width_px} px is a view of "
        f"{angle_deg:.2g}°; expected {_NARROW_DEG:.0f}° to {_WIDE_DEG:.0f}°",
        "focal lengths are in pixels, not millimetres; check the file, calibrate again",
    )


def _fold(camera: Camera) -> Iterator[Advice]:
    reach = distortion_reach(camera)
    if not reach.is_monotonic:
        yield Advice(
            "problem",
            "the distortion folds inside the image",
            f"{1 - reach.covered_share:.0%} of the pixels have no ray; the model holds to "
            f"{math.degrees(reach.fold_angle_rad):.0f}° from the axis",
            "calibrate with views that reach the corners, or with fewer coefficients; use the "
            "middle of the image meanwhile",
        )

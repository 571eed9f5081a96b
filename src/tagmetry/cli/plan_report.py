"""An error budget as text and as JSON."""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from tagmetry.geometry import Array
    from tagmetry.pose.plan import Free, Prediction

_RARE = 1e-6


def plan_table(prediction: "Prediction", free: "Free | None") -> dict[str, object]:
    """Return all numbers for JSON; `by_calibration` is null where the file states none."""
    from tagmetry.pose.plan import range_m, shortest_side_px

    setup = prediction.setup
    return {
        "solved_for": free,
        "size_m": setup.size_m,
        "distance_m": setup.distance_m,
        "width_px": setup.camera.width_px,
        "height_px": setup.camera.height_px,
        "tilt_deg": setup.tilt_deg,
        "short_side_px": setup.short_side_px,
        "needed_side_px": shortest_side_px(setup),
        "range_m": range_m(setup),
        "motion_px": float(np.hypot(*setup.motion_px)),
        "corner_px": prediction.corner_px,
        "by_corners": _numbers(prediction.by_corners),
        "by_calibration": _numbers(prediction.by_calibration),
        "by_size": _numbers(prediction.by_size),
        "all": _numbers(prediction.covariance),
        "covariance": prediction.covariance.tolist(),
        "flip_probability": prediction.flip_probability,
    }


def plan_lines(prediction: "Prediction", free: "Free | None") -> list[str]:
    """Return the budget as text."""
    return [
        *_setup_lines(prediction, free),
        "",
        f"{'one deviation, mm':<24}{'position':>10}{'x':>10}{'y':>10}{'z':>10}{'angle':>11}",
        _line("noise of the corners", prediction.by_corners),
        _line("calibration", prediction.by_calibration),
        _line("size of the marker", prediction.by_size),
        _line("all", prediction.covariance),
        "",
        *_remarks(prediction),
    ]


def _setup_lines(prediction: "Prediction", free: "Free | None") -> list[str]:
    setup, family = prediction.setup, prediction.setup.marker_family.name
    size_mm, (width_px, height_px) = 1000 * setup.size_m, setup.camera.size_px
    head = f"{family} of {size_mm:.4g} mm at {setup.distance_m:.4g} m, tilted {setup.tilt_deg:g}°"
    lines = [f"{head}, in {width_px}x{height_px} px"]
    answers = {
        "size": f"the smallest marker that will do: {size_mm:.4g} mm",
        "distance": f"the greatest distance that will do: {setup.distance_m:.4g} m",
        "resolution": f"the fewest pixels that will do: {width_px}x{height_px}",
    }
    return [answers[free], *lines] if free is not None else lines


def _line(name: str, covariance: "Array | None") -> str:
    if covariance is None:
        return f"{name:<24}{'unknown: the camera file holds no covariance':>45}"
    numbers = _numbers(covariance) or {}
    x_mm, y_mm, z_mm = np.sqrt(np.diag(covariance)[:3]) * 1e3
    position_mm, angle_deg = 1e3 * numbers["position_m"], np.degrees(numbers["angle_rad"])
    lengths = "".join(f"{length:>10.3g}" for length in (position_mm, x_mm, y_mm, z_mm))
    return f"{name:<24}{lengths}{angle_deg:>10.3g}°"


def _numbers(covariance: "Array | None") -> dict[str, float] | None:
    from tagmetry.pose.plan.predict import angle_rad, position_m

    if covariance is None:
        return None
    return {"position_m": position_m(covariance), "angle_rad": angle_rad(covariance)}


def _remarks(prediction: "Prediction") -> list[str]:
    from tagmetry.pose.plan import range_m, shortest_side_px

    setup, flips = prediction.setup, prediction.flip_probability
    far_m, moved_px = range_m(setup), float(np.hypot(*setup.motion_px))
    side_px, needed_px = setup.short_side_px, shortest_side_px(setup)
    reach = f"found up to {far_m:.3g} m" if far_m > 0 else "found at no distance"
    remarks = [
        f"corners ± {prediction.corner_px:.2g} px; averaging n pictures divides their part by √n",
        f"flips: {flips:.1%} of pictures" if flips > _RARE else "flips: none to speak of",
        f"{reach}: {needed_px:.3g} px are needed, its shorter side has {side_px:.3g} here",
    ]
    if moved_px > 0:
        remarks.append(f"moves {moved_px:.2g} px while the shutter is open")
    if side_px < needed_px:
        remarks.append("WARNING: it will mostly not be found here")
    return remarks

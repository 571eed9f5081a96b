"""What is weak about a calibration, each in a sentence with the number that shows it."""

import numpy as np

from tagmetry.calibrate.guidance.evidence import Evidence
from tagmetry.calibrate.guidance.words import where
from tagmetry.calibrate.result import Calibration
from tagmetry.camera import distortion_reach
from tagmetry.geometry.arrays import IntArray

FEW_VIEWS = 8
_UNCERTAIN_PX = 1.0
_LOOSE_FOCAL = 0.005
_SIGNIFICANT = 2.0  # standard deviations
_TOO_SMALL = 1.5  # times the formula's standard deviation
_DECISIVE = 2.0  # standard deviations that one view moves the camera
_FLAT_DEG = 15.0
_NEGLIGIBLE_PX = 0.03  # a pattern in the residuals that moves nothing anyone measures


def doubts(calibration: Calibration, evidence: Evidence) -> tuple[str, ...]:
    """Return what is weak, the worst first; nothing where nothing is."""
    found = [
        _folds(calibration),
        _uncertain_place(calibration, evidence),
        _few_views(calibration),
        _loose_focal(calibration),
        _halves_differ(evidence),
        _one_view_decides(calibration, evidence),
        _insignificant(calibration),
        _dependent(calibration),
        _board_off(evidence),
        _lens_off(evidence),
        _little_tilt(evidence),
        _uncovered(evidence),
    ]
    return tuple(filter(None, found))


def _folds(calibration: Calibration) -> str | None:
    reach = distortion_reach(calibration.camera)
    if reach.is_monotonic:
        return None
    return (
        f"the distortion is not one to one: it folds back {np.degrees(reach.fold_angle_rad):.0f} "
        f"degrees from the axis, so that {1 - reach.covered_share:.1%} of the image shows nothing "
        "that can be measured; use fewer coefficients, or add views out there"
    )


def _uncertain_place(calibration: Calibration, evidence: Evidence) -> str | None:
    uncertainty = evidence.uncertainty
    if not uncertainty.worst_px > _UNCERTAIN_PX:
        return None
    corners = [_px(sd) for sd in uncertainty.sd_px[[0, 0, -1, -1], [0, -1, 0, -1]]]
    return (
        f"projections are uncertain by {uncertainty.worst_px:.1f} px "
        f"{where(uncertainty.worst_pixel, calibration.camera.size_px)} (image corners: upper left "
        f"{corners[0]}, upper right {corners[1]}, lower left {corners[2]}, lower right "
        f"{corners[3]}): {_shown_there(evidence)}"
    )


def _px(sd_px: float) -> str:
    return f"{sd_px:.1f} px" if np.isfinite(sd_px) else "beyond the lens"


def _shown_there(evidence: Evidence) -> str:
    """Return how many corners lie in the cell of the image that is least certain."""
    cells, (u, v) = evidence.coverage.cells, evidence.uncertainty.worst_pixel
    share = (np.array([v, u]) + 0.5) / (evidence.uncertainty.pixels[-1, -1][::-1] + 1)
    count = cells[tuple(np.minimum(share * cells.shape, np.array(cells.shape) - 1).astype(int))]
    return f"{count} corners were seen there" if count else "no view shows the board there"


def _few_views(calibration: Calibration) -> str | None:
    count = len(calibration.views)
    if count >= FEW_VIEWS:
        return None
    return (
        f"{count} views are few: their error of {calibration.rms_px:.2f} px says nothing, for it "
        f"is smallest with the fewest views; take at least {FEW_VIEWS}"
    )


def _loose_focal(calibration: Calibration) -> str | None:
    covariance = calibration.camera.covariance
    if covariance is None:
        return None
    share = float(np.sqrt(np.diag(covariance)[:2]).max() / min(calibration.camera.focal_px))
    if share <= _LOOSE_FOCAL:
        return None
    return f"the focal length is known to {share:.1%} only; add views with more tilt"


def _halves_differ(evidence: Evidence) -> str | None:
    halves = evidence.halves
    if halves is None or not halves.worst_px > 2 * _UNCERTAIN_PX:
        return None
    return (
        f"two halves of the views lead to cameras that differ by {halves.mean_px:.1f} px in the "
        f"mean and {halves.worst_px:.1f} px at the worst place of the image"
    )


def _one_view_decides(calibration: Calibration, evidence: Evidence) -> str | None:
    shift_px = np.nan_to_num(evidence.influence.shift_px, nan=np.inf)
    most = int(np.argmax(shift_px))
    sd_px = float(np.sqrt(np.nanmean(evidence.uncertainty.sd_px**2)))
    if shift_px[most] <= max(_DECISIVE * sd_px, 0.1):
        return None
    name = calibration.views[most].source or f"view {most + 1}"
    return (
        f"one view decides: without {name} projections move by {shift_px[most]:.1f} px in the root "
        f"mean square over the image, where {sd_px:.1f} px was to be expected; look at it"
    )


def _insignificant(calibration: Calibration) -> str | None:
    lens, covariance = calibration.camera.lens, calibration.camera.covariance
    if covariance is None:
        return None
    values, sd = np.array(lens.coefficients), np.sqrt(np.diag(covariance)[4:])
    weak = [
        f"{lens.names[i]} ({values[i]:.2g} with a standard deviation of {sd[i]:.2g})"
        for i in np.flatnonzero((sd > 0) & (np.abs(values) < _SIGNIFICANT * sd))
    ]
    if not weak:
        return None
    return f"not told apart from zero: {', '.join(weak)}; a simpler lens may do as well"


def _dependent(calibration: Calibration) -> str | None:
    covariance = calibration.camera.covariance
    if covariance is None:
        return None
    sd, formula = (np.sqrt(np.diag(C)[2]) for C in (covariance, calibration.formula_covariance))
    if not sd > _TOO_SMALL * formula:
        return None
    return (
        f"errors within a view depend on each other: cx is known to {sd:.2f} px, not to the "
        f"{formula:.2f} px that the usual formula gives"
    )


def _board_off(evidence: Evidence) -> str | None:
    board = evidence.residuals.over_board
    if not board.is_pattern or board.rms_px < _NEGLIGIBLE_PX:
        return None
    return (
        f"the board's points are off by {board.rms_px:.2f} px in the same way in all views (noise "
        f"alone: {_by_noise_px(evidence.residuals.noise_px, board.count):.2f} px): it is not as "
        "its maker says; release its shape, or print it on something flat"
    )


def _lens_off(evidence: Evidence) -> str | None:
    rings = evidence.residuals.over_radius
    if not rings.is_pattern or rings.rms_px < _NEGLIGIBLE_PX:
        return None
    return (
        f"errors follow the radius by {rings.rms_px:.2f} px (noise alone: "
        f"{_by_noise_px(evidence.residuals.noise_px, rings.count):.2f} px): the lens model does "
        "not fit; try one with more coefficients, or a fisheye"
    )


def _by_noise_px(noise_px: float, count: IntArray) -> float:
    """Return the root mean squared length of means of so many errors."""
    return float(noise_px * np.sqrt(2 * np.mean(1 / count[count > 0])))


def _little_tilt(evidence: Evidence) -> str | None:
    largest = float(evidence.coverage.tilts_deg.max())
    if largest >= _FLAT_DEG:
        return None
    return (
        f"the board is never tilted by more than {largest:.0f} degrees, which leaves the focal "
        "length open; tilt it by 20 to 45"
    )


def _uncovered(evidence: Evidence) -> str | None:
    covered = evidence.coverage
    if covered.farthest_share >= 0.9 or not evidence.uncertainty.worst_px > _UNCERTAIN_PX:
        return None
    return (
        f"no corner lies beyond {covered.farthest_share:.0%} of the way to the image's corners, "
        f"and {1 - covered.share:.0%} of the image's cells show none"
    )

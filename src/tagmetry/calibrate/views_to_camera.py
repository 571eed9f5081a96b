"""Views of a board to a camera with its covariance.

    usable views -> start (Zhang) -> maximum likelihood without outliers -> views that fit
    -> the lens that the views support -> the board's shape, if released -> covariance

Reference: Z. Zhang, A Flexible New Technique for Camera Calibration, PAMI 22(11), 2000; seed 003.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from tagmetry.calibrate.bundle import errors_px
from tagmetry.calibrate.checks import (
    check_determined,
    check_fits,
    check_tilts,
    seen_from_behind,
    warnings_of,
)
from tagmetry.calibrate.choice import LENS_NAMES, LensModel, ModelChoice
from tagmetry.calibrate.covariance import Covariances, covariances
from tagmetry.calibrate.fit import Fit, fit_flat, release_shape
from tagmetry.calibrate.freedom import Wanted
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.select import general_fits, select_model
from tagmetry.calibrate.sightings import Sightings, gather
from tagmetry.calibrate.usable import LEAST_CORNERS, check_enough, check_flat, usable_views
from tagmetry.calibrate.view import BoardView, RejectedView
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation

_LEAST_KEPT = 0.5  # of a view's corners; with fewer the view itself does not fit


def calibrate(
    views: Sequence[BoardView],
    model: LensModel = "auto",
    *,
    shape: Literal["flat", "free"] = "flat",
    fix_aspect: bool = False,
    fix_center: bool = False,
    robust: bool = True,
) -> Calibration:
    """Return the camera that shows a board as the views do, with its covariance.

    Args:
        views: At least three, of one size, at different tilts of the board.
        model: The lens, or "auto": the one that left-out views, BIC and a distortion without
            folds support together.
        shape: "free" lets the board's points leave the places its maker gave them.
        fix_aspect: Hold fx = fy.
        fix_center: Hold the principal point at the image's centre.
        robust: Leave out corners farther off than 4 robust standard deviations, and views of
            which less than half fits.

    Raises:
        InputError: The views do not determine a camera; the text says why and what to add.
    """
    _check_names(model, shape)
    usable, unusable = usable_views(views)
    choose = model == "auto"
    wanted = Wanted("brown5" if model == "auto" else model, fix_aspect, fix_center)
    used, fits, misfits = _views_that_fit(usable, wanted, choose=choose, robust=robust)
    check_fits(fits[0])
    check_tilts(fits[0].bundle)
    selected = select_model(fits, wanted) if choose else None
    fit = selected.fit if selected else fits[0]
    if shape == "free":
        fit = release_shape(fit, gather(used), robust=robust)
    return _result(fit, used, unusable + misfits, selected.choice if selected else None)


def _views_that_fit(
    views: tuple[BoardView, ...], wanted: Wanted, *, choose: bool, robust: bool
) -> tuple[tuple[BoardView, ...], tuple[Fit, ...], tuple[RejectedView, ...]]:
    """Return the views that one camera shows, its fits, and the other views with the reason."""
    rejected: tuple[RejectedView, ...] = ()
    while True:
        check_enough(len(views), rejected)
        seen = gather(views)
        check_flat(seen.p_board)
        if choose:
            fits = general_fits(seen, wanted, robust=robust)
        else:
            fits = (fit_flat(seen, wanted, robust=robust),)
        faults = _faults(fits[0], seen)
        if not any(faults):
            return views, fits, rejected
        pairs = list(zip(views, faults, strict=True))
        rejected += tuple(RejectedView(view.source, fault) for view, fault in pairs if fault)
        views = tuple(view for view, fault in pairs if not fault)


def _faults(fit: Fit, seen: Sightings) -> list[str]:
    """Return what is wrong with each view, in words, empty if nothing is."""
    kept = fit.seen.used.sum(axis=1)
    shares = kept / seen.used.sum(axis=1)
    behind = seen_from_behind(fit.bundle)
    return [_fault(*of_view) for of_view in zip(kept, shares, behind, strict=True)]


def _fault(kept: int, share: float, behind: bool) -> str:
    if share < _LEAST_KEPT or kept < LEAST_CORNERS:
        return f"only {share:.0%} of its corners fit the camera that the other views agree on"
    if behind:
        return "its corners are mirrored: the board would be seen from behind"
    return ""


def _result(
    fit: Fit,
    views: tuple[BoardView, ...],
    rejected: tuple[RejectedView, ...],
    choice: ModelChoice | None,
) -> Calibration:
    found = _covariances(fit)
    check_determined(fit, found.by_view)
    bundle, size_px = fit.bundle, fit.seen.size_px
    camera = replace(
        bundle.camera(size_px),
        covariance=found.by_view,
        provenance=f"calibrated from {len(views)} views of a board",
    )
    everything = gather(views)
    columns = [np.searchsorted(everything.points, view.points) for view in views]
    errors, kept = errors_px(bundle, everything), fit.seen.used
    return Calibration(
        camera=camera,
        formula_covariance=found.formula,
        views=views,
        Ts_camera_board=RigidTransform.from_components(
            bundle.t_camera_board, Rotation.from_matrix(bundle.R_camera_board)
        ),
        residuals_px=tuple(errors[v, rows] for v, rows in enumerate(columns)),
        kept=tuple(kept[v, rows] for v, rows in enumerate(columns)),
        p_board=_by_number(bundle.p_board, everything),
        shape_released=fit.freedom.shape_sd_m is not None,
        rejected=rejected,
        choice=choice,
        warnings=warnings_of(fit, found.by_view),
    )


def _covariances(fit: Fit) -> Covariances:
    try:
        return covariances(fit.bundle, fit.seen, fit.freedom)
    except np.linalg.LinAlgError as error:
        raise InputError(
            "the views leave some of the camera's numbers open; add views tilted by 20 to 45 "
            "degrees to several sides, or ask for a simpler lens"
        ) from error


def _by_number(p_board: Array, seen: Sightings) -> Array:
    """Return the points with row k point k, NaN where no view shows it."""
    numbered = np.full((int(seen.points[-1]) + 1, 3), np.nan)
    numbered[seen.points] = p_board
    return numbered


def _check_names(model: str, shape: str) -> None:
    if model not in (*LENS_NAMES, "auto"):
        raise InputError(f"expected a lens of {', '.join(LENS_NAMES)} or auto, got {model!r}")
    if shape not in ("flat", "free"):
        raise InputError(f"expected a shape of flat or free, got {shape!r}")

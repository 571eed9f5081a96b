"""Which lens model the views support, by three tests together.

The error on the fitted corners falls with every coefficient, so it decides nothing. A model must
show left-out views at most 15 % worse than the best; of those it must be one to one over the
image, or as nearly so as any; of those show left-out views within 1 % of the best; and of those
the one with the least Bayesian information criterion wins, if the views tell all its numbers.
Lenses of eight coefficients and more are not tried with fewer than eight views.

Reference: G. Schwarz, Estimating the Dimension of a Model, 1978.
"""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.calibrate.bundle import Bundle, errors_in_sd
from tagmetry.calibrate.choice import LENS_NAMES, LensName, ModelChoice, ModelRow
from tagmetry.calibrate.covariance import covariances
from tagmetry.calibrate.fit import Fit, fit_flat, refit
from tagmetry.calibrate.freedom import Wanted
from tagmetry.calibrate.hold_out import hold_out_px
from tagmetry.calibrate.leave_out import quick_hold_out_px
from tagmetry.calibrate.sightings import Sightings
from tagmetry.calibrate.translate import as_rational
from tagmetry.camera import distortion_reach
from tagmetry.errors import InputError

_GENERAL: tuple[LensName, ...] = ("brown5", "fisheye")
_FAR_SLACK, _HOLD_OUT_SLACK = 1.15, 1.01
_ROUNDS = 8  # of leaving views out, for each of nine models
_ENOUGH = 40  # left-out views tell which models are worse; each costs a solution
_MOST_STEPS = 30
_MONOTONIC_SLACK = 0.005
_CREDIBLE = 1.5  # times the error on fitted corners: a quick hold-out error beyond is looked into
_MANY, _VIEWS_FOR_MANY = 8, 8  # so many coefficients hang on the one view at the image's corner
_OPEN = "the views leave some of its numbers open"


@dataclass(frozen=True, eq=False)
class Selected:
    """The winner among lens models.

    Attributes:
        fit: Its fit.
        choice: All of them, and why it won.
    """

    fit: Fit
    choice: ModelChoice


def general_fits(seen: Sightings, wanted: Wanted, *, robust: bool) -> tuple[Fit, ...]:
    """Return the fits of the five-coefficient lens and the fisheye, the better first.

    The first says which corners and views fit at all: a model that fits badly must not win by
    dropping corners. A model that no start leads to is missing.
    """
    fits = []
    for lens in _GENERAL:
        try:
            fits.append(fit_flat(seen, replace(wanted, lens=lens), robust=robust))
        except InputError as error:
            refusal = error
    if not fits:
        raise refusal
    return tuple(sorted(fits, key=lambda fit: fit.scale))


def select_model(general: tuple[Fit, ...], wanted: Wanted) -> Selected:
    """Return the lens model that the corners of the best general fit support."""
    fits = _fits(general, wanted)
    rows = {name: _row(name, fit) for name, fit in fits.items()}
    able = list(rows.values())
    finalists, chosen = _best(able)
    while len(able) > 1 and not _is_determined(fits[chosen.name]):
        able.remove(chosen)
        finalists, chosen = _best(able)
    told = tuple(
        _told(row, finalists, chosen) if row in able else replace(row, verdict=_OPEN)
        for row in rows.values()
    )
    return Selected(fits[chosen.name], ModelChoice(chosen.name, told, _reason(chosen, finalists)))


def _best(rows: list[ModelRow]) -> tuple[list[ModelRow], ModelRow]:
    """Return the models that come into question, and the one of them that explains most simply."""
    finalists = _finalists(rows)
    return finalists, min(finalists, key=lambda row: row.bic)


def _is_determined(fit: Fit) -> bool:
    """Return whether the views tell all numbers of the camera, so that it has a covariance."""
    try:
        covariances(fit.bundle, fit.seen, fit.freedom)
    except np.linalg.LinAlgError:
        return False
    return True


def _fits(general: tuple[Fit, ...], wanted: Wanted) -> dict[LensName, Fit]:
    """Return every model's fit to the same corners; a model that no start leads to is missing."""
    fits: dict[LensName, Fit] = {}
    few = len(general[0].seen) < _VIEWS_FOR_MANY
    for name in LENS_NAMES:
        kind = replace(wanted, lens=name)
        fitted: list[Fit] = []
        if few and kind.coefficients >= _MANY:
            continue
        for start in _starts(general, fits, kind):
            try:
                fitted.append(refit(start, general[0].seen, kind, robust=False, steps=_MOST_STEPS))
            except InputError:
                continue
        if fitted:
            fits[name] = min(fitted, key=lambda fit: fit.scale)
    return fits


def _starts(general: tuple[Fit, ...], fits: dict[LensName, Fit], kind: Wanted) -> list[Bundle]:
    """Return where to begin: the general fit of the kind, or the next smaller lens."""
    best = general[0]
    if kind.coefficients >= _MANY and best.bundle.kind == "fisheye":
        return [as_rational(best.bundle, kind.coefficients, _farthest_rad(best))]
    if kind.coefficients > 5:
        return [fit.bundle for fit in fits.values()][-1:]
    return [fit.bundle for fit in general if fit.bundle.kind == kind.kind]


def _farthest_rad(fit: Fit) -> float:
    """Return the largest angle from the axis at which a corner lies."""
    rays = fit.bundle.camera(fit.seen.size_px).unproject(fit.seen.corners_px[fit.seen.used])
    return float(np.arccos(np.clip(np.nanmin(rays[:, 2]), -1.0, 1.0)))


def _row(name: LensName, fit: Fit) -> ModelRow:
    reach = distortion_reach(fit.bundle.camera(fit.seen.size_px))
    return ModelRow(
        name=name,
        parameters=fit.freedom.count,
        rms_px=_rms_px(fit),
        hold_out_px=_hold_out_px(fit),
        bic=bayesian_information(fit),
        monotonic_share=reach.covered_share,
        verdict="",
    )


def _hold_out_px(fit: Fit) -> float:
    """Return the error on left-out views, solved in full where one step does not tell it.

    A lens with more coefficients than the views support goes far along its valleys in one step.
    """
    found_px = quick_hold_out_px(fit, _ROUNDS, _ENOUGH)
    if found_px < _CREDIBLE * _rms_px(fit):
        return found_px
    return hold_out_px(fit, _ROUNDS, _ENOUGH)


def _rms_px(fit: Fit) -> float:
    squares = (errors_in_sd(fit.bundle, fit.seen) ** 2).sum()
    return float(np.sqrt(squares / fit.seen.weights.sum()))


def bayesian_information(fit: Fit) -> float:
    """Return m ln(chi^2 / m) + p ln m for m equations and p free numbers, poses included."""
    chi2 = float((errors_in_sd(fit.bundle, fit.seen) ** 2).sum())
    equations = 2 * fit.seen.corner_count
    unknowns = fit.freedom.count + 6 * len(fit.seen)
    return float(equations * np.log(chi2 / equations) + unknowns * np.log(equations))


def _finalists(rows: list[ModelRow]) -> list[ModelRow]:
    able = _within(rows, _FAR_SLACK)
    widest = max(row.monotonic_share for row in able)
    safe = [row for row in able if row.monotonic_share >= widest - _MONOTONIC_SLACK]
    return _within(safe, _HOLD_OUT_SLACK)


def _within(rows: list[ModelRow], slack: float) -> list[ModelRow]:
    least = min(row.hold_out_px for row in rows)
    return [row for row in rows if row.hold_out_px <= slack * least]


def _told(row: ModelRow, finalists: list[ModelRow], chosen: ModelRow) -> ModelRow:
    """Return the row with its verdict in words."""
    if row is chosen:
        verdict = "chosen"
    elif row in finalists:
        verdict = "as good on left-out views, but needs more parameters than it is worth"
    elif not np.isfinite(row.hold_out_px):
        verdict = "cannot be solved without some of the views"
    elif row.monotonic_share < chosen.monotonic_share - _MONOTONIC_SLACK:
        verdict = f"folds back over {1 - row.monotonic_share:.0%} of the image"
    else:
        verdict = f"{row.hold_out_px / chosen.hold_out_px - 1:.0%} worse on left-out views"
    return replace(row, verdict=verdict)


def _reason(chosen: ModelRow, finalists: list[ModelRow]) -> str:
    others = [row.name for row in finalists if row is not chosen]
    beside = f" like {', '.join(others)}, and with the lowest BIC of these" if others else ""
    return (
        f"{chosen.name} shows left-out views best, at {chosen.hold_out_px:.3f} px{beside}; it is "
        f"one to one over {chosen.monotonic_share:.0%} of the image"
    )

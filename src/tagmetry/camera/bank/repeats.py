"""Several calibrations at one setting become one, weighted by what they are sure of."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tagmetry.camera.bank.between import re_expressed
from tagmetry.camera.bank.node import BankNode
from tagmetry.camera.bank.parameters import (
    alike,
    parameters,
    with_parameters,
    worst_displacement_px,
)
from tagmetry.camera.bank.report import Repeat
from tagmetry.camera.model import Camera
from tagmetry.geometry.arrays import Array


def merged(nodes: Sequence[BankNode]) -> Camera:
    """Return the mean of calibrations at one setting.

    Weighted by their covariances where all have one; the mean's covariance grows by the excess of
    their spread over what they claim, never shrinks.
    """
    cameras = _comparable(nodes)
    if len(cameras) == 1:
        return cameras[0]
    values, covariance = _mean(cameras)
    camera = replace(with_parameters(cameras[0], values), provenance=f"mean of {len(cameras)}")
    excess = _excess(cameras)
    if covariance is None or excess is None:
        return camera
    return replace(camera, covariance=max(1.0, excess) * covariance)


def repeat_of(nodes: Sequence[BankNode]) -> Repeat:
    """Say how well calibrations at one setting agree."""
    mean = merged(nodes)
    worst_px = max(worst_displacement_px(node.camera, mean) for node in nodes)
    return Repeat(
        mean.width_px, mean.height_px, mean.zoom, nodes[0].focus,
        len(nodes), worst_px, _excess(_comparable(nodes)), _hysteresis_px(nodes),
    )  # fmt: skip


def _hysteresis_px(nodes: Sequence[BankNode]) -> float | None:
    near = [node for node in nodes if node.approach == "from near"]
    far = [node for node in nodes if node.approach == "from far"]
    return worst_displacement_px(merged(near), merged(far)) if near and far else None


def _comparable(nodes: Sequence[BankNode]) -> tuple[Camera, ...]:
    """Return the cameras with coefficients that may be averaged: those near the first one's."""
    first, *others = alike([node.camera for node in nodes])
    return (first, *(re_expressed(other, first) for other in others))


def _excess(cameras: Sequence[Camera]) -> float | None:
    """Return chi-square per degree of freedom about the mean; None without covariances."""
    values, mean_covariance = _mean(cameras)
    if mean_covariance is None:
        return None
    chi2 = 0.0
    for camera in cameras:
        error = parameters(camera) - values
        chi2 += float(error @ _inverse(np.asarray(camera.covariance)) @ error)
    free = int(np.linalg.matrix_rank(_scaled(mean_covariance), hermitian=True))
    return chi2 / ((len(cameras) - 1) * max(1, free))


def _mean(cameras: Sequence[Camera]) -> tuple[Array, Array | None]:
    """Return the mean and its covariance, one calibration added after the other.

    This form, unlike that with inverses, allows parameters that were held fixed (variance zero).
    """
    if any(camera.covariance is None for camera in cameras):
        return np.mean([parameters(camera) for camera in cameras], axis=0), None
    values, covariance = parameters(cameras[0]), np.asarray(cameras[0].covariance)
    for camera in cameras[1:]:
        gain = covariance @ _inverse(covariance + np.asarray(camera.covariance))
        values = values + gain @ (parameters(camera) - values)
        covariance = covariance - gain @ covariance
        covariance = (covariance + covariance.T) / 2
    return values, covariance


def _inverse(covariance: Array) -> Array:
    """Invert a covariance whose scales differ widely; directions without spread become zero."""
    deviations = _deviations(covariance)
    inverse = np.linalg.pinv(_scaled(covariance), rcond=1e-12, hermitian=True)
    return np.asarray(inverse / np.outer(deviations, deviations))


def _scaled(covariance: Array) -> Array:
    deviations = _deviations(covariance)
    return np.asarray(covariance / np.outer(deviations, deviations))


def _deviations(covariance: Array) -> Array:
    variances = np.diag(covariance)
    return np.where(variances > 0, np.sqrt(np.maximum(variances, 0.0)), 1.0)

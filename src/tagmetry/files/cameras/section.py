"""The section `tagmetry`: what the formats of others have no place for and pass over."""

from dataclasses import replace

import numpy as np

from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.files.checked import OwnFileModel
from tagmetry.files.tables import Table
from tagmetry.geometry.arrays import Array

_ROUNDING = 1e-6


class Section(OwnFileModel):
    """What is known of a camera beyond its intrinsics; each key may be missing.

    Attributes:
        name: What the camera is called, where the format has no name.
        coefficient_count: How many of the distortion coefficients are meant; the rest is padding.
        covariance: Of (fx, fy, cx, cy, coefficients), rows of numbers.
        zoom: Zoom factor that the intrinsics belong to.
        focus: Focus setting that they belong to, in the camera's own unit.
        provenance: Where the numbers come from.
    """

    name: str | None = None
    coefficient_count: int | None = None
    covariance: list[list[float]] | None = None
    zoom: float = 1.0
    focus: float | None = None
    provenance: str = ""


def section_of(camera: Camera) -> Table:
    """Return what differs from the defaults, apart from name and coefficient count."""
    table: Table = {}
    if camera.zoom != 1.0:
        table["zoom"] = float(camera.zoom)
    if camera.focus is not None:
        table["focus"] = float(camera.focus)
    if camera.provenance:
        table["provenance"] = camera.provenance
    if camera.covariance is not None:
        table["covariance"] = np.asarray(camera.covariance, dtype=np.float64).tolist()
    return table


def completed(camera: Camera, section: Section) -> Camera:
    """Return the camera with what its section adds."""
    return replace(
        camera,
        name=camera.name if section.name is None else section.name,
        zoom=section.zoom,
        focus=section.focus,
        provenance=section.provenance,
        covariance=None if section.covariance is None else _covariance(section.covariance),
    )


def meant(coefficients: tuple[float, ...], section: Section) -> tuple[float, ...]:
    """Return the coefficients without padding."""
    count = section.coefficient_count
    if count is None:
        return coefficients
    if not 0 <= count <= len(coefficients) or any(coefficients[max(count, 0) :]):
        raise InputError(
            f"tagmetry.coefficient_count is {count}, which does not fit the distortion "
            f"coefficients {list(coefficients)}: those after it must be 0"
        )
    return coefficients[:count]


def _covariance(rows: list[list[float]]) -> Array:
    if {len(row) for row in rows} != {len(rows)}:
        raise InputError(f"tagmetry.covariance: expected a square, found {len(rows)} unequal rows")
    covariance = np.array(rows, dtype=np.float64)
    scale = float(np.abs(covariance).max())
    is_symmetric = np.allclose(covariance, covariance.T, rtol=1e-6, atol=1e-12 * scale)
    if not is_symmetric or (np.diag(covariance) < 0).any():
        raise InputError(
            "tagmetry.covariance: expected a symmetric matrix with variances of at least 0"
        )
    _check_correlations(covariance)
    return covariance


def _check_correlations(covariance: Array) -> None:
    """Refuse numbers that vary together by more than each of them varies."""
    deviations = np.sqrt(np.diag(covariance))
    if (np.abs(covariance) > (1 + _ROUNDING) * np.outer(deviations, deviations)).any():
        raise InputError(
            "tagmetry.covariance: expected covariances of at most the product of both standard "
            "deviations"
        )

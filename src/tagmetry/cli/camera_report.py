"""A camera as text: what it is, how wide it sees, and what is odd about it."""

import numpy as np

from tagmetry.camera import Camera, distortion_reach


def camera_table(camera: Camera) -> dict[str, object]:
    """Return a camera's numbers for JSON."""
    reach = distortion_reach(camera)
    return {
        "name": camera.name,
        "width_px": camera.width_px,
        "height_px": camera.height_px,
        "focal_px": camera.focal_px,
        "center_px": camera.center_px,
        "lens": camera.lens.kind,
        "coefficients": camera.lens.coefficients,
        "standard_deviations": _deviations(camera),
        "view_deg": [angle if np.isfinite(angle) else None for angle in _view_deg(camera)],
        "zoom": camera.zoom,
        "focus": camera.focus,
        "provenance": camera.provenance,
        "distortion_covers_image": reach.is_monotonic,
        "covered_share": reach.covered_share,
    }


def camera_lines(camera: Camera) -> list[str]:
    """Return a camera's numbers and warnings as text."""
    values = (*camera.focal_px, *camera.center_px, *camera.lens.coefficients)
    spreads = [f" ± {s:.2g}" for s in _deviations(camera) or []] or [""] * len(values)
    across, down = _view_deg(camera)
    lines = [f"{camera.name}: {camera.width_px}x{camera.height_px}, {camera.lens.kind} lens"]
    for name, value, spread in zip(camera.parameter_names, values, spreads, strict=True):
        lines.append(f"  {name:<3} {value:12.6g}{spread}")
    if np.isfinite([across, down]).all():
        lines.append(f"  sees {across:.1f}° across and {down:.1f}° down through the middle")
    if camera.covariance is None:
        lines.append("  uncertainty unknown: the file holds no covariance")
    return [*lines, *_provenance(camera), *_warnings(camera)]


def _deviations(camera: Camera) -> list[float] | None:
    if camera.covariance is None:
        return None
    return [float(s) for s in np.sqrt(np.maximum(np.diag(camera.covariance), 0.0))]


def _view_deg(camera: Camera) -> tuple[float, float]:
    """Return the angles between the rays at the middles of opposite edges."""
    right, low = camera.width_px - 0.5, camera.height_px - 0.5
    middle_u, middle_v = (camera.width_px - 1) / 2, (camera.height_px - 1) / 2
    ends = np.array([[[-0.5, middle_v], [right, middle_v]], [[middle_u, -0.5], [middle_u, low]]])
    axis = np.array([0.0, 0.0, 1.0])
    angles = np.degrees(np.arccos(np.clip(camera.unproject(ends) @ axis, -1, 1))).sum(axis=1)
    return float(angles[0]), float(angles[1])


def _provenance(camera: Camera) -> list[str]:
    facts = [f"  from: {camera.provenance}"] if camera.provenance else []
    if camera.zoom != 1.0 or camera.focus is not None:
        facts.append(f"  zoom {camera.zoom:g}, focus {camera.focus}")
    return facts


def _warnings(camera: Camera) -> list[str]:
    reach = distortion_reach(camera)
    warnings = []
    if not reach.is_monotonic:
        warnings.append(
            f"  WARNING: the distortion folds inside the image: {1 - reach.covered_share:.1%} of "
            "it cannot be measured; calibrate with fewer coefficients or more views near the edge"
        )
    if not camera.contains(np.array(camera.center_px)):
        warnings.append("  WARNING: the principal point lies outside the image")
    fx, fy = camera.focal_px
    if not 0.8 < fx / fy < 1.25:
        warnings.append("  WARNING: fx and fy differ by more than a quarter; pixels are square")
    return warnings

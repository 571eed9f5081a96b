"""Is what was solved a camera that one may trust?

Wrong rows and columns, a mirrored board and views without tilt all give numbers, and some give
small errors. Each is recognised by what it does to the result.
"""

from dataclasses import replace

import numpy as np

from tagmetry.calibrate.bundle import Bundle
from tagmetry.calibrate.fit import Fit
from tagmetry.calibrate.sightings import Sightings
from tagmetry.calibrate.start import BoardPlane
from tagmetry.camera import Camera, distortion_reach
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

_LARGEST_ERROR = 0.005  # of the picture's diagonal, robust standard deviation
_LEAST_TILT_DEG, _SMALL_TILT_DEG = 4.0, 20.0
_WORST_FOCAL, _POOR_FOCAL = 0.05, 0.005  # standard deviation over focal length
_SMALL_FOLD = 0.005  # of the picture
_POOR_CORNER_PX = 1.0
_LONGEST_FOCAL = 50.0  # half diagonals: 2.3 degrees of view


def check_fits(fit: Fit) -> None:
    """Raise InputError where even the best camera misses the corners by far."""
    error_px = _robust_error_px(fit)
    if error_px > _LARGEST_ERROR * np.hypot(*fit.seen.size_px):
        raise InputError(
            f"no camera shows the board like that: the corners miss by {error_px:.1f} px at best; "
            f"check the board's rows and columns, and that corners and points belong together"
        )


def check_tilts(bundle: Bundle) -> None:
    """Raise InputError where all views see the board at the same tilt: any focal length fits."""
    if (spread := tilt_spread_deg(bundle)) < _LEAST_TILT_DEG:
        raise InputError(
            f"all views see the board at the same tilt, within {spread:.1f} degrees, which leaves "
            f"the focal length open; add views tilted by 20 to 45 degrees to several sides"
        )


def check_determined(fit: Fit, covariance: Array) -> None:
    """Raise InputError where the views leave the focal length open."""
    focal = fit.bundle.intrinsics[:2]
    share = float(np.sqrt(np.diag(covariance)[:2].max()) / focal.min())
    half = 0.5 * np.hypot(*fit.seen.size_px)
    if (
        not np.isfinite(covariance).all()
        or share > _WORST_FOCAL
        or focal.max() > _LONGEST_FOCAL * half
    ):
        raise InputError(
            f"the views leave the camera open: the focal length comes out as {focal[0]:.0f} px "
            f"with a standard deviation of {share:.0%}; add views tilted by 20 to 45 degrees to "
            f"several sides, near and far, over the whole picture"
        )


def seen_from_behind(bundle: Bundle) -> BoolArray:
    """Say for each view whether the board turns its back to the camera, shape (n,)."""
    plane = BoardPlane.through(bundle.p_board)
    middle = bundle.R_camera_board @ plane.origin + bundle.t_camera_board
    normal = bundle.R_camera_board @ plane.axes[:, 2]
    return np.asarray((normal * middle).sum(axis=1) > 0)


def tilt_spread_deg(bundle: Bundle) -> float:
    """Return the largest angle between the board's normals in any two views."""
    normals = bundle.R_camera_board @ BoardPlane.through(bundle.p_board).axes[:, 2]
    return float(np.degrees(np.arccos(np.clip(normals @ normals.T, -1, 1).min())))


def warnings_of(fit: Fit, covariance: Array) -> tuple[str, ...]:
    """Return what to know before trusting a camera, in words."""
    told = []
    camera = replace(fit.bundle.camera(fit.seen.size_px), covariance=covariance)
    reach = distortion_reach(camera)
    if reach.covered_share < 1 - _SMALL_FOLD:
        told.append(
            f"the distortion folds back over {1 - reach.covered_share:.1%} of the picture: "
            f"nothing can be measured there"
        )
    share = float(np.sqrt(np.diag(covariance)[:2].max()) / fit.bundle.intrinsics[:2].min())
    if share > _POOR_FOCAL:
        told.append(f"the focal length is known to {share:.1%} only; add views with more tilt")
    if (tilts := tilt_spread_deg(fit.bundle)) < _SMALL_TILT_DEG:
        told.append(f"the board's tilt varies by {tilts:.0f} degrees only; tilt it by 20 to 45")
    if (sd_px := corner_sd_px(camera)) > _POOR_CORNER_PX:
        told.append(
            f"the picture's corners are known to {sd_px:.1f} px only, as no corner of the board "
            f"lies beyond {_covered_radius(fit.seen):.0%} of the way there"
        )
    return tuple(told)


def corner_sd_px(camera: Camera) -> float:
    """Return the largest standard deviation along any direction at the picture's four corners.

    A camera that is turned a little shows nearly what one with another centre shows, and no board
    tells them apart. So the camera is turned until its centre stays: what is left is the lens.
    Corners beyond the fold of the lens do not count.
    """
    u, v = camera.width_px - 1.0, camera.height_px - 1.0
    rays = camera.unproject(np.array([[0.0, 0.0], [u, 0.0], [u, v], [0.0, v]]))
    rays = rays[np.isfinite(rays).all(axis=-1)]
    _, by_point = camera.project_with_jacobian(rays)
    by_turn = [by_point @ np.cross(axis, rays)[..., None] for axis in np.eye(3)[:2]]
    jacobian = camera.parameter_jacobian(rays).copy()
    (fx, fy), about_x, about_y = camera.focal_px, *by_turn
    jacobian[..., 2] -= about_y[..., 0] / fx  # a turn by 1 / fx about y moves the centre by 1 px
    jacobian[..., 3] += about_x[..., 0] / fy
    spread = jacobian @ np.asarray(camera.covariance) @ np.swapaxes(jacobian, -1, -2)
    return float(np.sqrt(np.linalg.eigvalsh(spread).max(initial=0.0)))


def _robust_error_px(fit: Fit) -> float:
    return float(fit.scale / np.sqrt(np.median(fit.seen.weights[fit.seen.used])))


def _covered_radius(seen: Sightings) -> float:
    """Return how far out corners lie, 1 at the picture's own corners."""
    centre = (np.array(seen.size_px) - 1) / 2
    farthest = np.linalg.norm(seen.corners_px[seen.used] - centre, axis=1).max()
    return float(farthest / np.hypot(*centre))

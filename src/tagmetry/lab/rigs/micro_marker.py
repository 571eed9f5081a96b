"""A small marker on a turntable before the webcam of seed 000, and how well it could be known.

Nobody puts a marker down to a tenth of a millimetre: each repeat stands a little aside and leans a
little, so that repeats do not all fall on the same pixels.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.detect.photometric.bound import Print, corner_bound_px2
from tagmetry.geometry import Array, RigidTransform, cross_matrix
from tagmetry.geometry.transforms import Rotation
from tagmetry.lens import LensSetting, MarkerKind, Whereabouts, ZoomLens, best_setting
from tagmetry.lens.measured import turn_about_y_deg
from tagmetry.markers import family, marker_corners_m
from tagmetry.twin.camera import BeforeCamera, TwinCamera, markers_before_camera, webcam
from tagmetry.twin.scenes import Still

FAMILY = "tag36h11"
MARKER_ID = 7
SIDE_CELLS = 8
_ASIDE = 0.01  # of the depth
_LEAN_DEG = 1.0
_NOISE_GREY = 1.6  # of a well exposed image in light grey, where the webcam's is greatest
_GREYS = (62.0, 190.0)
_BLUR_PX = 0.5
_LARGE_PX = 64.0


@dataclass(frozen=True)
class Stand:
    """A marker's pose and size.

    Attributes:
        size_m: Side of the black square.
        depth_m: Where it is.
        turn_deg: Its turn about the upright axis.
    """

    size_m: float
    depth_m: float
    turn_deg: float

    @property
    def marker(self) -> MarkerKind:
        """What is known of it."""
        return MarkerKind(self.size_m, SIDE_CELLS)

    def placed(self, rng: np.random.Generator) -> RigidTransform:
        """Return T_camera_marker as a person places it; depth and turn are as they should be."""
        lean = Rotation.from_euler("xz", rng.uniform(-_LEAN_DEG, _LEAN_DEG, 2), degrees=True)
        turned = Rotation.from_euler("y", self.turn_deg, degrees=True) * lean
        facing = turned * Rotation.from_euler("x", 180, degrees=True)
        aside_m = rng.uniform(-_ASIDE, _ASIDE, 2) * self.depth_m
        return RigidTransform.from_components([*aside_m, self.depth_m], facing)


def camera_before(
    stand: Stand, T_camera_marker: RigidTransform, seed: int, setting: LensSetting | None = None
) -> TwinCamera:
    """Return the webcam with the marker before it, switched on, or standing at a setting."""
    one = BeforeCamera(Still(T_camera_marker), MARKER_ID, stand.size_m, FAMILY)
    camera = TwinCamera(markers_before_camera(one), webcam(), seed=seed, quick=True)
    if setting is not None:
        for name in ("auto_focus", "auto_exposure"):
            camera.controls.write(name, 0.0)
        camera.controls.write("zoom", setting.zoom_percent)
        camera.controls.write("focus", setting.focus)
        camera.advance(0.5)
    return camera


def turn_of(T_camera_marker: RigidTransform) -> float:
    """Return the turn phi of a pose, degrees."""
    return turn_about_y_deg(T_camera_marker)


def turn_bound_deg(lens: ZoomLens, stand: Stand, T_camera_marker: RigidTransform) -> float:
    """Return the Cramer-Rao bound of the turn's standard deviation at the best setting.

    It holds for one image, exact calibration, the right one of the two poses, and errors so small
    that the outline changes in proportion: not within a degree or two of the frontal view.
    """
    at = Whereabouts(np.asarray(T_camera_marker.translation), float(np.radians(stand.turn_deg)))
    chosen = best_setting(lens, stand.marker, at)
    resolved = min(chosen.zoom_percent, lens.native_percent)
    camera = lens.camera_at(LensSetting(resolved, chosen.focus))
    from_centre = T_camera_marker.rotation.apply(marker_corners_m(stand.size_m))
    p_camera = from_centre + T_camera_marker.translation
    pixels, by_point = camera.project(p_camera), camera.project_with_jacobian(p_camera)[1]
    turned = np.stack([-cross_matrix(arm) for arm in from_centre])
    J = np.concatenate([by_point, by_point @ turned], axis=2).reshape(8, 6)
    covariance = np.linalg.inv(J.T @ np.linalg.inv(_corner_bound_px2(pixels)) @ J)
    return float(np.degrees(np.sqrt(covariance[4, 4])))


def _corner_bound_px2(corners_px: Array) -> Array:
    """Return the bound; that of a large marker from a smaller one with the same blur.

    What an edge tells goes with its length, so the covariance goes with 1 / side.
    """
    side_px = float(np.linalg.norm(np.diff(corners_px, axis=0), axis=1).mean())
    share = min(1.0, _LARGE_PX / side_px)
    middle = corners_px.mean(axis=0)
    corners_px = middle + share * (corners_px - middle)
    one = family(FAMILY)
    seen = Print(one.picture(MARKER_ID), one.layout.margin_cells, *_GREYS, _BLUR_PX)
    return np.asarray(share * corner_bound_px2(corners_px, seen, _NOISE_GREY))

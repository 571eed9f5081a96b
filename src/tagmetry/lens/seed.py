"""Zoom, focus and convergence as seed 000 iterates them: its equations 1, 2, 3, 6, 7 and 8.

    W = C (z - z_min) + W_min     (1)    n = W / 100      (2)    F = -alpha ln z + beta    (3)
    |p_k - p_k-1| < t_p           (6)    |q_k - q_k-1| < t_q    (7)    z = z' n            (8)

Its equation 7 prints t_p where t_q is meant. Table 3 gives t_q = 0.01 degrees, the text 0.05.
Equation 8 is for intrinsics of zoom 100; those of a bank contain the zoom: never both.
"""

from dataclasses import dataclass, field

import numpy as np

from tagmetry.camera.controls import Control
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.lens.focus_law import FocusLaw, LogLaw
from tagmetry.lens.setting import LensSetting


@dataclass(frozen=True)
class SeedRule:
    """The paper's numbers.

    Attributes:
        per_m: C of equation 1, percent per metre.
        nearest_m: z_min.
        law: Equation 3.
        position_m: t_p.
        posture_rad: t_q.
    """

    per_m: float = 1000.0
    nearest_m: float = 0.05
    law: FocusLaw = field(default_factory=LogLaw)
    position_m: float = 1e-3
    posture_rad: float = float(np.radians(0.01))

    def setting(self, depth_m: float, zoom: Control, focus: Control) -> LensSetting:
        """Return zoom and focus for a depth, within the controls: equations 1 and 3."""
        if not (np.isfinite(depth_m) and depth_m > 0):
            raise InputError(f"a depth must be positive, in metres, got {depth_m}")
        zoom_percent = self.per_m * (depth_m - self.nearest_m) + zoom.least
        return LensSetting(zoom.nearest(zoom_percent), focus.nearest(self.law.value(depth_m)))

    def has_settled(
        self,
        before: RigidTransform,
        now: RigidTransform,
        *,
        by_position: bool = True,
        by_posture: bool = True,
    ) -> bool:
        """Say whether two recognitions in a row agree: equations 6 and 7.

        Args:
            before: T_camera_marker of the one.
            now: Of the next.
            by_position: Whether position decides, as in section 4.5.1.
            by_posture: Whether posture decides, as in section 4.5.2.
        """
        moved_m = float(np.linalg.norm(now.translation - before.translation))
        turned = np.abs(_angles_rad(now) - _angles_rad(before))
        turned = np.minimum(turned, 2 * np.pi - turned)
        near = not by_position or moved_m < self.position_m
        alike = not by_posture or float(np.linalg.norm(turned)) < self.posture_rad
        return near and alike


def real_depth_m(apparent_m: float, zoom_percent: float) -> float:
    """Return z of z' as it comes out with the intrinsics of zoom 100: equation 8."""
    return apparent_m * zoom_percent / 100


def _angles_rad(T_camera_marker: RigidTransform) -> "np.ndarray[tuple[int], np.dtype[np.float64]]":
    """Return the posture as the paper writes it: three angles, here about x, y and z."""
    facing = T_camera_marker.rotation.as_matrix() @ np.diag([1.0, -1.0, -1.0])
    return np.array(
        [
            np.arctan2(facing[2, 1], facing[2, 2]),
            np.arctan2(-facing[2, 0], np.hypot(facing[0, 0], facing[1, 0])),
            np.arctan2(facing[1, 0], facing[0, 0]),
        ]
    )

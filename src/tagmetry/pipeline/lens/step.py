"""What one image did while zoom and focus are driven."""

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from tagmetry.camera import Image
from tagmetry.lens import LensSetting, Measured

Phase = Literal["scan", "iterate", "average", "track", "reacquire"]


@dataclass(frozen=True, eq=False)
class LensStep:
    """One image and what came of it.

    Attributes:
        phase: What it was taken for.
        image: The image.
        setting: What was in effect for it, as far as the camera's lag tells.
        is_settled: Whether that is what was commanded, so that a measurement may be trusted.
        found: The marker, where it was seen.
        is_final: The measurement has converged; those averaged after it are final too, and surer.
        busy_s: Computing time, of all threads together.
        reason: Why nothing was found, or why this is the last step; empty otherwise.
    """

    phase: Phase
    image: Image
    setting: LensSetting
    is_settled: bool
    found: Measured | None = None
    is_final: bool = False
    busy_s: float = 0.0
    reason: str = ""

    def table(self) -> dict[str, Any]:
        """Return it as plain values, for a line of JSON."""
        plain: dict[str, Any] = {
            "phase": self.phase,
            "sequence": self.image.sequence,
            "time_s": self.image.time_s,
            "zoom_percent": self.setting.zoom_percent,
            "focus": self.setting.focus,
            "is_settled": self.is_settled,
            "is_final": self.is_final,
            "busy_s": round(self.busy_s, 6),
        }
        if self.reason:
            plain["reason"] = self.reason
        return plain if self.found is None else {**plain, "marker": _marker_table(self.found)}


def _marker_table(found: Measured) -> dict[str, Any]:
    T_camera_marker = found.T_camera_marker
    return {
        "family": found.detection.family,
        "id": found.detection.id,
        "depth_m": found.depth_m,
        "depth_sd_m": found.depth_sd_m,
        "translation_m": np.asarray(T_camera_marker.translation).tolist(),
        "rotation_xyzw": T_camera_marker.rotation.as_quat(canonical=True).tolist(),
        "covariance": found.covariance.tolist(),
        "turn_sd_rad": found.turn_sd_rad,
        "images": found.images,
        "ambiguity": found.pose.ambiguity,
        "blur_px": found.blur_px if np.isfinite(found.blur_px) else None,
    }

"""Write how often a marker's pose flips, by measurement and by formula: `docs/generated/flips.md`.

For each case 2000 noisy views of a marker in the middle of the image; those with one minimum only
count as flipped where it leans the wrong way, but state no ambiguity.
"""

from pathlib import Path

import numpy as np
from scipy.stats import norm

from tagmetry.camera import Camera
from tagmetry.geometry import Array
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import marker_corners_m
from tagmetry.pose.marker import solve

OUT = Path(__file__).parent / "generated" / "flips.md"
FOCAL_PX, SIZE_M, COUNT = 1000.0, 0.1, 2000
CAMERA = Camera(1280, 960, (FOCAL_PX, FOCAL_PX), (639.5, 479.5))
TILTS_DEG, SIDES_PX, NOISES_PX = (5, 10, 20, 45), (30, 60), (0.03, 0.1, 0.3)
HEADER = """\
| tilt | side | noise | formula | flips | two hypotheses | flips among them | stated ambiguity |
|---|---|---|---|---|---|---|---|
"""


def measured(tilt_deg: float, side_px: float, sd_px: float) -> tuple[Array, Array]:
    """Return which views are flipped, and their stated ambiguity, NaN for a single hypothesis."""
    rng = np.random.default_rng(0)
    rotations = views(tilt_deg, rng)
    t = np.array([0.0, 0.0, FOCAL_PX * SIZE_M / side_px])
    p_marker = marker_corners_m(np.full(COUNT, SIZE_M))
    corners = CAMERA.project(p_marker @ np.swapaxes(rotations.as_matrix(), 1, 2) + t)
    noisy = corners + rng.normal(size=corners.shape) * sd_px
    noise_px2 = np.tile(np.eye(8) * sd_px**2, (COUNT, 1, 1))
    found = solve(noisy, noise_px2, np.full(COUNT, SIZE_M), CAMERA)
    leans = np.stack([h[0].T_camera_marker.rotation.as_matrix()[:2, 2] for h in found])
    flipped = (leans * rotations.as_matrix()[:, :2, 2]).sum(axis=1) < 0
    ambiguity = [1 - h[0].probability if len(h) == 2 else np.nan for h in found]
    return flipped, np.array(ambiguity)


def views(tilt_deg: float, rng: np.random.Generator) -> Rotation:
    """Return R_camera_marker of markers tilted about any axis of the image, rolled at random."""
    around = rng.uniform(0, 2 * np.pi, COUNT)
    axes = np.stack([np.cos(around), np.sin(around), np.zeros(COUNT)], axis=1)
    rolls = Rotation.from_euler("z", rng.uniform(0, 360, (COUNT, 1)), degrees=True)
    facing = Rotation.from_euler("x", 180, degrees=True)
    return Rotation.from_rotvec(np.deg2rad(tilt_deg) * axes) * facing * rolls


def row(tilt_deg: float, side_px: float, sd_px: float) -> str:
    """Return a line of the table."""
    flipped, ambiguity = measured(tilt_deg, side_px, sd_px)
    two = np.isfinite(ambiguity)
    formula = norm.sf(np.sin(np.deg2rad(tilt_deg)) * side_px**2 / (2 * FOCAL_PX * sd_px))
    shares = [formula, flipped.mean(), two.mean()]
    among = [flipped[two].mean(), ambiguity[two].mean()] if two.any() else [np.nan, np.nan]
    texts = [f"{100 * share:.1f} %" if np.isfinite(share) else "none" for share in shares + among]
    return f"| {tilt_deg}° | {side_px} px | {sd_px} px | {' | '.join(texts)} |\n"


if __name__ == "__main__":
    cases = [(t, side, sd) for t in TILTS_DEG for side in SIDES_PX for sd in NOISES_PX]
    OUT.write_text(HEADER + "".join(row(*case) for case in cases), encoding="utf-8")

"""Floor markers and the camera above them: the least squares over all corners.

Asked are the camera's pose (6 numbers) and those of every marker's (x, y, direction) that are free.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from scipy.linalg import block_diag

from tagmetry.arena.on_plane import OverheadView
from tagmetry.arena.square_fit import fit_squares
from tagmetry.detect import Detection
from tagmetry.geometry import Array, RigidTransform, perturb_pose
from tagmetry.geometry.arrays import IntArray
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers.bodies import marker_corners_m

RIGHT_RAD = np.pi / 2  # direction of a marker's top whose right is the world's x
_MOST_STEPS = 50
_FIRST_DAMPING, _LARGEST_DAMPING = 1e-6, 1e6
_LEAST_GAIN = 1e-9  # of chi2


@dataclass(frozen=True, eq=False)
class FloorMarkersSeen:
    """Floor markers of an image.

    Attributes:
        corners_px: Shape (n, 4, 2).
        covariances_px2: Shape (n, 8, 8).
        whiten: Inverse roots of those, shape (n, 8, 8).
        sizes_m: Shape (n,).
    """

    corners_px: Array
    covariances_px2: Array
    whiten: Array
    sizes_m: Array

    @classmethod
    def of(cls, detections: Sequence[Detection], sizes_m: Array) -> Self:
        """Return the markers of detections."""
        corners_px = np.array([one.corners_px for one in detections])
        covariances = np.array([one.corners_cov_px2 for one in detections])
        whiten = np.linalg.inv(np.linalg.cholesky(covariances))
        return cls(corners_px, covariances, whiten, sizes_m)

    def fits(self, view: OverheadView) -> tuple[Array, float]:
        """Return the places on the floor that a view gives, (n, 3), and how badly they fit."""
        heights = np.zeros(len(self.sizes_m))
        found = fit_squares(view, self.corners_px, self.covariances_px2, self.sizes_m, heights)
        chi2 = float(found.chi2.sum())
        return found.places, chi2 if np.isfinite(found.places).all() else np.inf


@dataclass(frozen=True, eq=False)
class FloorSolution:
    """A solution, or one on the way to it.

    Attributes:
        view: The camera.
        places: (x, y, direction of the top) of the markers, shape (n, 3).
        seen: What the image shows.
        free: Which of the 3 n numbers of the places are asked.
    """

    view: OverheadView
    places: Array
    seen: FloorMarkersSeen
    free: IntArray

    @cached_property
    def equations(self) -> tuple[Array, Array]:
        """Whitened residuals, shape (8 n,), and their derivatives by what is asked."""
        poses = [lying(place) for place in self.places]
        sized = zip(poses, self.seen.sizes_m.tolist(), strict=True)
        p_world = np.array([T.apply(marker_corners_m(size_m)) for T, size_m in sized])
        pixels, by_point = self.view.project(p_world)
        arm = p_world[..., :2] - self.places[:, None, :2]
        by_turn = by_point[..., :2] @ np.stack([-arm[..., 1], arm[..., 0]], -1)[..., None]
        by_place = np.concatenate([by_point[..., :2], by_turn], axis=-1).reshape(-1, 8, 3)
        by_camera = self.view.by_camera(p_world, by_point).reshape(-1, 8, 6)
        residuals = self.seen.whiten @ (self.seen.corners_px - pixels).reshape(-1, 8, 1)
        of_places = block_diag(*(self.seen.whiten @ by_place))[:, self.free]
        of_camera = (self.seen.whiten @ by_camera).reshape(-1, 6)
        return residuals.ravel(), np.hstack([of_camera, of_places])

    @property
    def chi2(self) -> float:
        """Of all corners."""
        residuals = self.equations[0]
        chi2 = float(residuals @ residuals)
        return chi2 if np.isfinite(chi2) else np.inf

    def stepped(self, damping: float) -> "FloorSolution":
        """Return the solution after a step."""
        residuals, by_asked = self.equations
        H = by_asked.T @ by_asked
        damped = H + damping * np.diag(np.diag(H))
        step: Array = np.asarray(np.linalg.solve(damped, by_asked.T @ residuals), dtype=np.float64)
        T = perturb_pose(self.view.T_world_camera, step[:6])
        places = self.places.ravel().copy()
        places[self.free] += step[6:]
        view = OverheadView(self.view.camera, T, self.view.covariance)
        return FloorSolution(view, places.reshape(-1, 3), self.seen, self.free)

    @cached_property
    def solved(self) -> "FloorSolution":
        """The least squares (by Levenberg and Marquardt)."""
        state, damping = self, _FIRST_DAMPING
        for _ in range(_MOST_STEPS):
            after = state.stepped(damping)
            if not after.chi2 < state.chi2:
                damping *= 10
                if damping > _LARGEST_DAMPING:
                    break
                continue
            is_done = state.chi2 - after.chi2 < _LEAST_GAIN
            state, damping = after, damping / 10
            if is_done:
                break
        return state


def lying(place: Array) -> RigidTransform:
    """Return T_world_marker of a marker on the floor whose top points to a direction."""
    x_m, y_m, direction = place.tolist()
    return RigidTransform.from_components(
        [x_m, y_m, 0.0], Rotation.from_euler("z", direction - RIGHT_RAD)
    )

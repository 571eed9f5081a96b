"""What the camera above a simulated arena gives: markers, from pictures or from corners alone."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from tagmetry.arena import OverheadView, Robot
from tagmetry.detect import Detection, Detector, Tracker
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.markers import family
from tagmetry.markers.bodies import marker_corners_m
from tagmetry.twin.rendering import Shot
from tagmetry.twin.robots.overhead import OverheadPictures
from tagmetry.twin.robots.roof import T_robot_marker
from tagmetry.twin.scenes import Scene


class Eye(Protocol):
    """Looks down at robots."""

    def look(self, time_s: float, Ts_world_robot: RigidTransform) -> tuple[Detection, ...]:
        """Return the markers that an image of this moment shows.

        Args:
            time_s: The middle of its exposure.
            Ts_world_robot: Where the robots are, in the order of the scenario.
        """


class CornerEye:
    """Sees every marker's corners with noise, without a picture: fast."""

    def __init__(
        self,
        robots: Sequence[Robot],
        view: OverheadView,
        rng: np.random.Generator,
        noise_px: float = 0.05,
    ) -> None:
        """Look at robots.

        Args:
            robots: In the order of the scenario.
            view: Where the camera really is.
            rng: Where the noise comes from.
            noise_px: Standard deviation of every corner's coordinate.
        """
        self._robots, self._view, self._rng, self._noise_px = robots, view, rng, noise_px
        self._corners_m = np.array([_corners_m(robot) for robot in robots])

    def look(self, time_s: float, Ts_world_robot: RigidTransform) -> tuple[Detection, ...]:  # noqa: ARG002
        """Return all markers whose four corners are in the image and seen from above."""
        R_world_robot = Ts_world_robot.rotation.as_matrix()
        p_world = self._corners_m @ np.swapaxes(R_world_robot, 1, 2)
        p_world = p_world + np.asarray(Ts_world_robot.translation)[:, None]
        pixels, _ = self._view.project(p_world)
        noisy = pixels + self._noise_px * self._rng.standard_normal(pixels.shape)
        last = np.array(self._view.camera.size_px) - 1
        inside = ((noisy > 0) & (noisy < last)).all(axis=(1, 2)) & (R_world_robot[:, 2, 2] > 0.5)
        return tuple(self._detection(n, noisy[n]) for n in np.flatnonzero(inside).tolist())

    def _detection(self, number: int, corners_px: np.ndarray) -> Detection:
        robot = self._robots[number]
        covariance = self._noise_px**2 * np.eye(8)
        return Detection(robot.family, robot.marker_id, corners_px, covariance, 0, 1.0)


class PictureEye:
    """Takes pictures and finds the markers in them, as the real camera and detector do.

    Attributes:
        pixels: The last picture; None before the first.
    """

    def __init__(
        self, robots: Sequence[Robot], floor: Scene, shot: Shot, rng: np.random.Generator
    ) -> None:
        """Look at robots.

        Args:
            robots: In the order of the scenario.
            floor: All that does not move.
            shot: The camera at its place.
            rng: Where the sensor's noise comes from.
        """
        self.pixels: AnyPixels | None = None
        self._pictures = OverheadPictures(floor, robots, shot)
        self._camera, self._rng = shot.camera, rng
        names = dict.fromkeys(robot.family for robot in robots)
        self._tracker = Tracker(Detector([family(name) for name in names]))

    def look(self, time_s: float, Ts_world_robot: RigidTransform) -> tuple[Detection, ...]:
        """Return the markers that the detector finds in a picture."""
        self.pixels = self._pictures.take(Ts_world_robot, self._rng)
        return self._tracker.track(self.pixels, time_s, self._camera)


def _corners_m(robot: Robot) -> np.ndarray:
    return np.asarray(T_robot_marker(robot).apply(marker_corners_m(robot.marker_size_m)))

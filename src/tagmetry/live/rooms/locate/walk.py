"""A simulated camera that is carried round a room, and what it sees of the markers on the walls.

No picture is rendered: every corner is where the optics put it, with noise that the localizer is
told. The map is the scene's own, and is taken to be exact.
"""

from collections.abc import Generator

import numpy as np

from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.live.rooms.locate.looked import Looked
from tagmetry.localize import Localizer, MapMarker, MarkerMap
from tagmetry.twin.scenes.ready import ready_recipe
from tagmetry.twin.truth import MarkerTruth, image_truth

_SEEN, _STEEPEST_DEG = 0.95, 75.0
_LEAST_PX, _MOST_PX = 0.01, 2.0


class Walk:
    """A way round the room.

    Attributes:
        marker_map: The markers on the walls.
    """

    def __init__(self, noise_px: float, seed: int = 0) -> None:
        """Hang the markers.

        Args:
            noise_px: Standard deviation of every corner's coordinate.
            seed: Of the noise.
        """
        self._recipe, self._noise_px = ready_recipe("room"), noise_px
        self._rng = np.random.default_rng(seed)
        first = image_truth(self._recipe.scene, self._recipe.shot_of(0))
        self.marker_map = MarkerMap(
            tuple(_mounted(one, first.T_world_camera) for one in first.markers), "room"
        )

    def looks(self) -> Generator[Looked]:
        """Give what each image shows, once round the room."""
        for number in range(self._recipe.count):
            truth = image_truth(self._recipe.scene, self._recipe.shot_of(number))
            seen = tuple(self._detection(one) for one in truth.markers if _is_seen(one))
            pose = Localizer(self.marker_map, truth.camera).locate(seen)
            yield Looked(truth.camera, truth.T_world_camera, seen, pose)

    def _detection(self, one: MarkerTruth) -> Detection:
        noisy = one.corners_px + self._noise_px * self._rng.standard_normal((4, 2))
        return Detection(one.family, one.id, noisy, self._noise_px**2 * np.eye(8), 0, 1.0)


def checked_noise_px(noise_px: float) -> float:
    """Return a noise that a detector may have.

    Raises:
        InputError: No detector has such noise.
    """
    if not _LEAST_PX <= noise_px <= _MOST_PX:
        raise InputError(f"expected a noise of {_LEAST_PX} to {_MOST_PX} px, got {noise_px:g}")
    return noise_px


def _is_seen(one: MarkerTruth) -> bool:
    return one.visible_fraction >= _SEEN and one.tilt_deg <= _STEEPEST_DEG


def _mounted(one: MarkerTruth, T_world_camera: RigidTransform) -> MapMarker:
    return MapMarker(one.family, one.id, one.size_m, T_world_camera * one.T_camera_marker)

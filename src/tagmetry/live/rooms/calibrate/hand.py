"""A simulated hand that holds a board where a guided session wants it, and now and then misses.

Frames: the camera is at the world's origin. p_camera = T_camera_board @ p_board.
"""

from dataclasses import replace

import numpy as np

from tagmetry.calibrate.guidance import NextView, Session
from tagmetry.calibrate.quality.places import Place, poses_at
from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.markers import Board

_STEPS = 3  # images from one place to the next
_PATIENCE = 7  # images without a view, moving and at rest, before it tries again
_MISSES_SHARE, _MISSES_DEG = 0.03, 3.0  # standard deviations, of the distance and of the tilt
_BEGINS_AT = 2.5  # times as far away as a board that fills the picture


class Hand:
    """Where the board is, from image to image.

    Attributes:
        place: Where it is now.
    """

    def __init__(self, board: Board, camera: Camera, seed: int = 0) -> None:
        """Hold a board before a camera.

        Args:
            board: The board.
            camera: As it truly is.
            seed: Of how it misses.
        """
        self._board, self._camera = board, camera
        self._rng = np.random.default_rng(seed)
        self.place = self._begin()
        self._wanted: NextView | None = None
        self._tried = 0
        self._way: list[Place] = []

    def pose(self) -> RigidTransform:
        """Return T_camera_board as it is now."""
        return self._pose(self.place)

    def follow(self, session: Session) -> None:
        """Go on to where the session wants the board; again, where it has not taken it there.

        Args:
            session: After the newest image.
        """
        self._tried += 1
        if session.next is not self._wanted or self._tried >= _PATIENCE:
            self._wanted, self._tried = session.next, 0
            self._way = _way(self.place, self._missed(self._matched(session.next)))
        if self._way:
            self.place = self._way.pop(0)

    def _begin(self) -> Place:
        middle = (self._camera.width_px / 2, self._camera.height_px / 2)
        full_m = self._board.width_m * self._camera.focal_px[0] / self._camera.width_px
        return Place(middle, _BEGINS_AT * full_m, 0.0)

    def _matched(self, wanted: NextView) -> Place:
        """Return the place at which the board looks as large as the outline that a person sees."""
        place = wanted.place
        drawn, seen = _extent_px(wanted.outline_px), _extent_px(self._edge_px(place))
        return replace(place, distance_m=place.distance_m * seen / drawn)

    def _edge_px(self, place: Place) -> Array:
        x, y = self._board.width_m / 2, self._board.height_m / 2
        corners = np.array([[-x, y, 0], [x, y, 0], [x, -y, 0], [-x, -y, 0]])
        return np.asarray(self._camera.project(self._pose(place).apply(corners)))

    def _missed(self, place: Place) -> Place:
        """Return a place a little beside: farther rather than nearer, so that all is in sight."""
        farther, tilted = self._rng.normal(size=2)
        return replace(
            place,
            distance_m=place.distance_m * float(np.exp(_MISSES_SHARE * abs(farther))),
            tilt_deg=float(np.clip(place.tilt_deg + _MISSES_DEG * tilted, 0.0, 60.0)),
        )

    def _pose(self, place: Place) -> RigidTransform:
        return poses_at(self._camera, [place])[0]


def _way(start: Place, end: Place) -> list[Place]:
    """Return places on the way, the end with them."""
    return [_between(start, end, step / _STEPS) for step in range(1, _STEPS)] + [end]


def _between(start: Place, end: Place, share: float) -> Place:
    """Return a place that faces as the end does, part of the way there."""
    (u, v), (end_u, end_v) = start.pixel, end.pixel
    return replace(
        end,
        pixel=(u + share * (end_u - u), v + share * (end_v - v)),
        distance_m=start.distance_m + share * (end.distance_m - start.distance_m),
        tilt_deg=share * end.tilt_deg,
    )


def _extent_px(outline_px: Array) -> float:
    """Return how large an outline (n, 2) is in the picture: the diagonal of its box."""
    return float(np.hypot(*(np.nanmax(outline_px, axis=0) - np.nanmin(outline_px, axis=0))))

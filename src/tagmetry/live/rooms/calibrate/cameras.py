"""What can be calibrated: a camera of this computer, or a simulated one with a board before it."""

from collections.abc import Iterator
from itertools import count
from typing import Protocol

import numpy as np

from tagmetry.calibrate.guidance import Session
from tagmetry.camera import BrownLens, Camera, Image
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.live.rooms.calibrate.hand import Hand
from tagmetry.markers import Board
from tagmetry.pipeline import open_images
from tagmetry.sources import VideoFile
from tagmetry.twin.optics.sensor import Sensor
from tagmetry.twin.rendering import Shot, photograph
from tagmetry.twin.scenes import Scene, Still, board_thing

PRACTICE = "twin"
PRACTICE_CAMERA = Camera(
    640, 480, (520.0, 520.0), (324.6, 236.9), BrownLens((-0.21, 0.06, 0.0005, -0.0004))
)
_PERIOD_S = 0.2
_SENSOR = Sensor(bits=8, full_well_e=8000.0, read_noise_e=3.0)
_MARGIN_SHARE = 0.1  # white around the board


class Watched(Protocol):
    """A camera that a session looks through."""

    def images(self) -> Iterator[Image]:
        """Give the newest image each time."""

    def follow(self, session: Session) -> None:
        """Take where the session wants the board next."""

    def close(self) -> None:
        """Let go of the camera."""


def opened_camera(spec: str, board: Board) -> Watched:
    """Return a camera that gives images.

    Args:
        spec: `twin` for the simulated one, or what `tagmetry.pipeline.open_images` understands.
        board: That is held before it.

    Raises:
        InputError: It cannot be opened, or is a folder of pictures.
    """
    return Practice(board) if spec == PRACTICE else Real(spec)


class Real:
    """A camera of this computer, a stream, or a video of one; a person holds the board."""

    def __init__(self, spec: str) -> None:
        self._source = open_images(spec)
        if not (self._source.is_live or isinstance(self._source, VideoFile)):
            self._source.close()
            raise InputError(
                f"expected a camera, a stream or a video, like 0 or rtsp://…, got {spec[:60]}"
            )

    def images(self) -> Iterator[Image]:
        """Give the newest image each time."""
        return iter(self._source)

    def follow(self, session: Session) -> None:
        """Leave it to the person."""

    def close(self) -> None:
        """Let go of the camera."""
        self._source.close()


class Practice:
    """A small simulated camera with a bent lens, and a hand that holds the board before it.

    The board stands still while an image is taken, and nothing is out of focus: pictures are
    rendered soon enough to be watched.
    """

    def __init__(self, board: Board, seed: int = 0) -> None:
        self._board, self._hand = board, Hand(board, PRACTICE_CAMERA, seed)
        self._rng = np.random.default_rng(seed)

    def images(self) -> Iterator[Image]:
        """Give five images a simulated second."""
        shot = Shot(PRACTICE_CAMERA, Still(RigidTransform.identity()), sensor=_SENSOR)
        for number in count():
            pixels = photograph(self._scene(), shot, self._rng)
            yield Image(pixels, number * _PERIOD_S, "capture", number, "twin")

    def follow(self, session: Session) -> None:
        """Move the board on to where the session wants it."""
        self._hand.follow(session)

    def close(self) -> None:
        """Keep nothing: there is nothing to let go of."""

    def _scene(self) -> Scene:
        at, margin_m = Still(self._hand.pose()), _MARGIN_SHARE * self._board.width_m
        return Scene((board_thing(self._board, at, margin_m=margin_m),))

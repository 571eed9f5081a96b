"""What a method of localization is: known markers in, hypotheses of the camera's pose out."""

from collections.abc import Sequence
from typing import Protocol

from tagmetry.camera import Camera
from tagmetry.localize.knowledge import Knowledge
from tagmetry.localize.result import CameraHypothesis
from tagmetry.localize.seen import SeenMarker


class Method(Protocol):
    """One way to a camera pose from the markers of one image."""

    @property
    def name(self) -> str:
        """What it is called."""

    @property
    def heeds_knowledge(self) -> bool:
        """Whether it can make use of what is known beside the markers."""

    def hypotheses(
        self, seen: Sequence[SeenMarker], camera: Camera, known: Knowledge
    ) -> tuple[CameraHypothesis, ...]:
        """Return the poses that explain the markers, by falling probability; none where none does.

        Args:
            seen: At least one marker.
            camera: Intrinsics of the image.
            known: What is known beside the markers; empty unless `heeds_knowledge`.
        """

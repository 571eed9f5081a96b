"""What was measured in one image: the value that every writer takes and every reader gives."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

from tagmetry.camera.image import Image, TimeKind
from tagmetry.detect.detection import Detection
from tagmetry.errors import InputError
from tagmetry.pose.result import MarkerPose


@dataclass(frozen=True)
class MarkerResult:
    """A marker and where it is.

    Attributes:
        detection: What was seen.
        pose: `T_camera_marker` with its alternatives; without hypotheses where the corners allow
            none; None where no size or no camera was given.
    """

    detection: Detection
    pose: MarkerPose | None = None


@dataclass(frozen=True)
class ImageResult:
    """All markers of one image, and which image it was.

    Attributes:
        source: Path, address or device that the image came from.
        sequence: Its number in the source, from 0.
        time_s: When it was taken, in the source's own clock.
        time_kind: What `time_s` is, as in `Image`.
        width_px: Columns of the image.
        height_px: Rows.
        markers: In the order of the detector.
    """

    source: str
    sequence: int
    time_s: float
    time_kind: TimeKind
    width_px: int
    height_px: int
    markers: tuple[MarkerResult, ...] = ()

    @classmethod
    def from_image(
        cls,
        image: Image,
        detections: Sequence[Detection],
        poses: Sequence[MarkerPose | None] | None = None,
    ) -> Self:
        """Return the result of an image, without its pixels.

        Args:
            image: Where the markers were seen.
            detections: The markers.
            poses: One for each detection, None where there is none; omitted when none was asked.
        """
        poses = [None] * len(detections) if poses is None else poses
        if len(poses) != len(detections):
            raise InputError(f"expected {len(detections)} poses, one per marker, got {len(poses)}")
        markers = tuple(map(MarkerResult, detections, poses))
        return cls(
            image.source,
            image.sequence,
            image.time_s,
            image.time_kind,
            image.width_px,
            image.height_px,
            markers,
        )

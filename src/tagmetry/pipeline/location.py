"""One image in, the camera's pose in the world out: detect, locate, and follow over time."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from tagmetry.camera import Camera, Image
from tagmetry.camera.image import TimeKind
from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.files.text import named_errors
from tagmetry.geometry import Array, RigidTransform
from tagmetry.localize import CameraPose, Knowledge, Localizer, MarkerMap, Method, MethodName
from tagmetry.localize.filter import PoseFilter, Speeds
from tagmetry.localize.result import Rejection
from tagmetry.markers.bodies import MarkerKey


@dataclass(frozen=True, eq=False)
class Located:
    """Where the camera was when an image was taken.

    Attributes:
        source: Path, address or device that the image came from.
        sequence: Its number in the source, from 0.
        time_s: When it was taken, in the source's own clock.
        time_kind: What `time_s` is, as in `Image`.
        method: How the pose was computed.
        T_world_camera: The pose; None where there is none.
        covariance: Shape (6, 6), (translation, rotation vector) on the left in the world frame, m
            and rad; NaN where there is no pose.
        probability: Probability that the pose is not another that fits, NaN where there is none.
        used: The markers that the image gave to it.
        rejected: The markers of the image that did not help, and why.
        age_s: Time since the last image that was heeded; 0 unless a filter goes on without.
        why: Why there is no pose.
    """

    source: str
    sequence: int
    time_s: float
    time_kind: TimeKind
    method: str
    T_world_camera: RigidTransform | None
    covariance: Array
    probability: float
    used: tuple[MarkerKey, ...]
    rejected: tuple[Rejection, ...]
    age_s: float = 0.0
    why: str = ""


@dataclass
class Location:
    """What is done with every image.

    Attributes:
        detector: Finds the markers.
        marker_map: Where they stand.
        camera: Intrinsics of the images; those that come with an image where None.
        method: How one image is judged.
        known: What is always known beside the markers.
        follower: Joins the images over time; each by itself where None.
        speeds: Odometry by rising time, for the follower; taken from as the images come.
    """

    detector: Detector
    marker_map: MarkerMap
    camera: Camera | None = None
    method: MethodName | Method = "joint"
    known: Knowledge = field(default_factory=Knowledge)
    follower: PoseFilter | None = None
    speeds: Sequence[tuple[float, Speeds]] = ()
    _localizer: Localizer | None = None
    _speeds_taken: int = 0

    def locate(self, image: Image) -> Located:
        """Return where the camera was.

        Raises:
            InputError: No intrinsics, an image of another size, or with a follower no time.
        """
        with named_errors(image.source or "image"):
            localizer = self._localizer_of(image)
            detections = self.detector.detect(image.pixels, localizer.camera)
            pose = localizer.locate(detections)
            if self.follower is None:
                return _by_itself(image, pose)
            return self._followed(image, pose, self.follower)

    def _localizer_of(self, image: Image) -> Localizer:
        camera = self.camera if self.camera is not None else image.camera
        if camera is None:
            raise InputError("the camera's intrinsics are needed: give its file (--camera)")
        camera.check_image(image.width_px, image.height_px)
        if self._localizer is None or self._localizer.camera is not camera:
            self._localizer = Localizer(self.marker_map, camera, self.method, self.known)
        return self._localizer

    def _followed(self, image: Image, pose: CameraPose, follower: PoseFilter) -> Located:
        if image.time_kind == "none":
            raise InputError(
                "a filter needs images with times, this one has none; choose another method"
            )
        while self._speeds_taken < len(self.speeds):
            time_s, speeds = self.speeds[self._speeds_taken]
            if time_s > image.time_s:
                break
            follower.take(time_s, speeds)
            self._speeds_taken += 1
        found = follower.take(image.time_s, pose)
        if found is None:
            return _located(image, "filter", pose, why=pose.why)
        at = (found.T_world_camera, found.covariance, found.probability)
        return _located(image, "filter", pose, at, age_s=found.age_s)


def _by_itself(image: Image, pose: CameraPose) -> Located:
    if not pose.hypotheses:
        return _located(image, pose.method, pose, why=pose.why)
    best = pose.best
    return _located(
        image, pose.method, pose, (best.T_world_camera, best.covariance, best.probability)
    )


def _located(
    image: Image,
    method: str,
    pose: CameraPose,
    found: tuple[RigidTransform, Array, float] | None = None,
    *,
    age_s: float = 0.0,
    why: str = "",
) -> Located:
    T, covariance, probability = found or (None, np.full((6, 6), np.nan), float("nan"))
    return Located(
        image.source,
        image.sequence,
        image.time_s,
        image.time_kind,
        method,
        T,
        covariance,
        probability,
        pose.used,
        pose.rejected,
        age_s,
        why,
    )

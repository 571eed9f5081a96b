"""One image in, one result out: detect, then measure where the size and the camera are known."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from tagmetry.camera import Camera, Image
from tagmetry.detect import Detection, Detector, Findings, Tracker
from tagmetry.detect.stages import Stages, look_through
from tagmetry.errors import InputError
from tagmetry.files.text import named_errors
from tagmetry.pose import MarkerPose, estimate_poses
from tagmetry.pose.marker import check_size
from tagmetry.record import ImageResult

Sizes = float | Mapping[int, float]


@dataclass(frozen=True)
class Measurement:
    """What is done with every image.

    Attributes:
        detector: Finds the markers.
        camera: Intrinsics of the images; no poses without.
        sizes_m: Side of the black squares: one for all, or by id; no poses without.
        tracker: Follows the markers from image to image; without, every image is looked at whole.
    """

    detector: Detector
    camera: Camera | None = None
    sizes_m: Sizes | None = None
    tracker: Tracker | None = None

    def __post_init__(self) -> None:
        by_id = self.sizes_m if isinstance(self.sizes_m, Mapping) else {0: self.sizes_m}
        for size_m in by_id.values():
            if size_m is not None:
                check_size(size_m)

        _check_forgiven(self.detector)

    def measure(self, image: Image) -> ImageResult:
        """Return the markers of an image, with their poses where they can be known."""
        with named_errors(image.source or "image"):
            camera = self._camera_of(image)
            if self.tracker is not None:
                return self.result(image, _tracked(self.tracker, image, camera))
            return self.result(image, self.detector.detect(image.pixels, camera))

    def begin_source(self) -> None:
        """Forget the markers of the images before: those that come are of another source."""
        if self.tracker is not None:
            self.tracker.reset()

    def explain(self, image: Image) -> Findings:
        """Return the markers of an image, and the squares that were turned down."""
        with named_errors(image.source or "image"):
            return self.detector.explain(image.pixels, self._camera_of(image))

    def look_through(self, image: Image) -> Stages:
        """Return what the detector sees of an image at each of its steps."""
        with named_errors(image.source or "image"):
            return look_through(image.pixels, self.detector, self._camera_of(image))

    def result(self, image: Image, detections: Sequence[Detection]) -> ImageResult:
        """Return detections of an image with their poses."""
        camera = self._camera_of(image)
        if camera is None or self.sizes_m is None:
            return ImageResult.from_image(image, detections)
        return ImageResult.from_image(image, detections, self._poses(detections, camera))

    def _camera_of(self, image: Image) -> Camera | None:
        camera = self.camera if self.camera is not None else image.camera
        if camera is not None:
            camera.check_image(image.width_px, image.height_px)
        return camera

    def _poses(self, detections: Sequence[Detection], camera: Camera) -> list[MarkerPose | None]:
        """Measure those markers whose size is known, in one go."""
        sizes_m = [self._size_of(detection) for detection in detections]
        known = [i for i, size_m in enumerate(sizes_m) if size_m is not None]
        measured = estimate_poses(
            [detections[i] for i in known], camera, [sizes_m[i] or 0.0 for i in known]
        )
        poses: list[MarkerPose | None] = [None] * len(detections)
        for i, pose in zip(known, measured, strict=True):
            poses[i] = pose
        return poses

    def _size_of(self, detection: Detection) -> float | None:
        if isinstance(self.sizes_m, Mapping):
            return self.sizes_m.get(detection.id)
        return self.sizes_m


def _tracked(tracker: Tracker, image: Image, camera: Camera | None) -> tuple[Detection, ...]:
    """Return the markers of an image that has a time."""
    if image.time_kind == "none":
        raise InputError(
            "expected images with times, to follow markers through, found one without; look at "
            "pictures one by one, without tracking"
        )
    return tracker.track(image.pixels, image.time_s, camera)


def _check_forgiven(detector: Detector) -> None:
    """Refuse what would give wrong ids: a code nearer to another marker cannot be told apart."""
    forgiven = detector.rules.forgive_bits
    for one in detector.families:
        if forgiven is not None and forgiven > one.correction_bits:
            raise InputError(
                f"forgive_bits must be 0 to {one.correction_bits}, which is what {one.name} can "
                f"correct, got {forgiven}"
            )

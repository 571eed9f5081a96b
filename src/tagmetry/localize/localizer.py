"""From the markers of one image to the camera's pose in the world."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

from tagmetry.camera import Camera
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.localize.average import MeanOfMarkers, WeightedByDistance
from tagmetry.localize.fused import FusedByCovariance
from tagmetry.localize.joint.solve import JointCorners
from tagmetry.localize.knowledge import Knowledge
from tagmetry.localize.marker_map import MarkerMap
from tagmetry.localize.method import Method
from tagmetry.localize.result import CameraPose
from tagmetry.localize.seen import known_markers
from tagmetry.localize.single import SingleMarker

MethodName = Literal["single", "mean", "weighted", "covariance", "joint"]
METHODS: dict[str, Method] = {
    "single": SingleMarker(),
    "mean": MeanOfMarkers(),
    "weighted": WeightedByDistance(),
    "covariance": FusedByCovariance(),
    "joint": JointCorners(),
}
_NOTHING = Knowledge()


@dataclass(frozen=True, eq=False)
class Localizer:
    """Says where a camera is from the markers that it sees.

    Attributes:
        marker_map: Where the markers stand.
        camera: Intrinsics of the images.
        method: One of `METHODS` by its name, or another that keeps to the protocol.
        known: What is always known beside the markers, such as a planar robot's floor.
    """

    marker_map: MarkerMap
    camera: Camera
    method: MethodName | Method = "joint"
    known: Knowledge = field(default_factory=Knowledge)

    def __post_init__(self) -> None:
        if not self.known.is_empty:
            _check_heeds(self._method)

    def locate(self, detections: Sequence[Detection], known: Knowledge = _NOTHING) -> CameraPose:
        """Return the camera's pose as the markers of one image have it.

        Args:
            detections: All markers of the image; those that the map does not have are reported and
                passed over.
            known: What is known of this image beside the markers, such as gravity.
        """
        if not known.is_empty:
            _check_heeds(self._method)
        markers, name = known_markers(detections, self.marker_map), self._method.name
        if not markers.seen:
            return CameraPose(name, (), markers.passed_over, markers.why_none)
        found = self._method.hypotheses(markers.seen, self.camera, self.known + known)
        why = "" if found else "the corners are those of no marker that is seen from the front"
        return CameraPose(name, found, markers.passed_over, why)

    @property
    def _method(self) -> Method:
        return method_of(self.method) if isinstance(self.method, str) else self.method


def method_of(name: str) -> Method:
    """Return a method by its name."""
    if name not in METHODS:
        raise InputError(f"there is no method {name!r}; there are {', '.join(METHODS)}")
    return METHODS[name]


def _check_heeds(method: Method) -> None:
    if not method.heeds_knowledge:
        able = [name for name, one in METHODS.items() if one.heeds_knowledge]
        raise InputError(
            f"the method {method.name} cannot make use of gravity, a height or a floor; "
            f"{' and '.join(able)} can"
        )

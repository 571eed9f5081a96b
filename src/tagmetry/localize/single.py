"""The camera as the best marker alone has it, with both of its hypotheses."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from tagmetry.camera import Camera
from tagmetry.localize.chain import marker_views
from tagmetry.localize.knowledge import Knowledge
from tagmetry.localize.result import CameraHypothesis, Rejection
from tagmetry.localize.seen import SeenMarker


@dataclass(frozen=True)
class SingleMarker:
    """The inverse chain of the marker with the least expected error, its flip included."""

    name: str = "single"
    heeds_knowledge: bool = False

    def hypotheses(
        self,
        seen: Sequence[SeenMarker],
        camera: Camera,
        known: Knowledge,  # noqa: ARG002
    ) -> tuple[CameraHypothesis, ...]:
        """Return the two poses of the camera, or one."""
        views = marker_views(seen, camera)
        if not views:
            return ()
        best = min(views, key=lambda view: view.expected_error2_m2)
        why = "another marker is expected to be more exact"
        others = tuple(Rejection(v.marker.key, why) for v in views if v is not best)
        return tuple(replace(one, rejected=others) for one in best.hypotheses)

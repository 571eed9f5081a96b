"""The arena: from the markers of every image to the state of all robots.

detections -> sight (which robots, where) -> tracks -> world state
           -> bump check (is the camera still where it was?)
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

from tagmetry.arena.bump import BumpCheck, BumpRules, FloorCorners, check_bump
from tagmetry.arena.on_plane import OverheadView
from tagmetry.arena.sighting import Roster, Sightings, sight
from tagmetry.arena.tracks import Motion, TrackEvent, TrackRules, Tracks
from tagmetry.arena.world_state import WorldState
from tagmetry.detect import Detection
from tagmetry.localize import MarkerMap
from tagmetry.markers.bodies import MarkerKey

_BUMPS_IN_A_ROW = 3


@dataclass(frozen=True, eq=False)
class ArenaStep:
    """What one image told.

    Attributes:
        world: All robots at the image's time.
        seen: The robots that the image shows, as they were measured in it alone.
        events: What happened to tracks.
        bump: Whether the camera is where it was; None where there is nothing to compare with.
        is_bumped: Several images in a row say that the camera was moved; latched.
        strangers: Markers of the image that are no robot's and not the floor's.
    """

    world: WorldState
    seen: Sightings
    events: tuple[TrackEvent, ...]
    bump: BumpCheck | None
    is_bumped: bool
    strangers: tuple[MarkerKey, ...]


@dataclass
class Arena:
    """Follows the robots of an arena through the images of a camera that hangs still.

    Attributes:
        roster: The robots.
        view: The camera at its place over the floor.
        floor: The floor markers at their places.
        reference: The floor markers' corners at calibration; without, bumps are not looked for.
        motion: How the robots move.
        rules: Which sightings are believed.
        bump_rules: When the camera is taken to be moved.
    """

    roster: Roster
    view: OverheadView
    floor: MarkerMap | None = None
    reference: Sequence[FloorCorners] = ()
    motion: Motion = field(default_factory=Motion)
    rules: TrackRules = field(default_factory=TrackRules)
    bump_rules: BumpRules = field(default_factory=BumpRules)

    def __post_init__(self) -> None:
        self._tracks = Tracks(self.roster, self.motion, self.rules)
        self._bumps = 0
        self._is_bumped = False

    def take(self, detections: Sequence[Detection], time_s: float) -> ArenaStep:
        """Return what the markers of an image tell.

        Args:
            detections: All markers of the image.
            time_s: When it was taken; later than the one before.
        """
        seen = sight(detections, self.roster, self.view)
        events = self._tracks.take(seen, time_s)
        bump = self._bump(detections)
        strangers = self._strangers(detections)
        return ArenaStep(self._tracks.world(), seen, events, bump, self._is_bumped, strangers)

    def world_at(self, time_s: float) -> WorldState:
        """Return the state at a moment after the last image, such as that of sending."""
        return self._tracks.world(time_s)

    def _strangers(self, detections: Sequence[Detection]) -> tuple[MarkerKey, ...]:
        known = self.roster.row_by_marker
        of_floor = self.floor.by_key if self.floor is not None else {}
        keys = (MarkerKey(one.family, one.id) for one in detections)
        return tuple(key for key in keys if key not in known and key not in of_floor)

    def _bump(self, detections: Sequence[Detection]) -> BumpCheck | None:
        if self.floor is None or not self.reference:
            return None
        found = check_bump(detections, self.reference, self.floor, self.view, self.bump_rules)
        self._bumps = self._bumps + 1 if found.is_moved else 0
        self._is_bumped = self._is_bumped or self._bumps >= _BUMPS_IN_A_ROW
        return found
